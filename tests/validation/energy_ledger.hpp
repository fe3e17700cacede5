// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <drawpoint/engine/world/world.hpp>
#include <drawpoint/tests/validation/record.hpp>
#include <vector>

/// Follows the energy of a world's rocks through a run and finds its largest rise.
///
/// The total is kinetic + potential energy less the work that moving surfaces did; rocks bring theirs when
/// they come and take it when they are removed. In free fall the semi-implicit step v⁺ = v + h g, q⁺ = q + h
/// v⁺ keeps ½ m v² − m g·(q − h v/2) to round-off, h the substep, so potential energy is taken there. What is
/// left is ½ λ·(u⁻ + u⁺) of the contact impulses λ and the relative velocities u before and after them:
/// friction, damping and impacts without restitution take energy, only overlap gives some back, as a contact
/// of overlap δ does work of at most F δ until it is open. So the total may rise above the lowest value that
/// it had by at most Σ F δ over all contacts at once, F and δ at their worst step; if contacts pumped energy
/// again and again, or another part of the step made some (the turning of a tumbling rock errs by (h ω)² of
/// its spin energy), the rise would not stop there. Cost: one pass over rocks and points per step.
namespace drawpoint::validation {

class EnergyLedger {
 public:
  explicit EnergyLedger(const engine::World& world) : world_(&world) {
    for (const auto& rock : world.rocks()) energies_.push_back(energy(rock));
  }

  /// To be called after every step; `work` [J] is what moving surfaces have done since the start.
  void note(double work = 0) {
    double change = work_ - work;
    work_ = work;
    for (std::size_t k = 0; k < world_->rocks().size(); ++k) {
      const double now = energy(world_->rocks()[k]);
      if (k >= energies_.size()) energies_.push_back(now);
      if (world_->rocks()[k].present) change += now - energies_[k];
      energies_[k] = now;
    }
    total_ += change;
    lowest_ = std::min(lowest_, total_);
    largest_rise_ = std::max(largest_rise_, total_ - lowest_);
    recoverable_ = std::max(recoverable_, force_times_overlap());
  }

  double largest_rise() const { return largest_rise_; }  ///< [J]
  double recoverable() const { return recoverable_; }    ///< Σ F δ at its worst step [J]
  double lost() const { return -lowest_; }               ///< [J]

 private:
  double energy(const engine::Rock& rock) const {
    const auto& options = world_->options();
    const double substep = options.step / options.solver.substeps;
    const Eigen::Vector3d w = rock.pose.linear().transpose() * rock.angular_velocity;
    const Eigen::Vector3d middle = rock.pose.translation() - 0.5 * substep * rock.velocity;
    return rock.body.mass * (0.5 * rock.velocity.squaredNorm() - options.gravity.dot(middle)) +
           0.5 * w.dot(rock.body.inertia.cwiseProduct(w));
  }

  double force_times_overlap() const {
    double sum = 0;
    for (const auto& p : world_->problem().points)
      sum += p.impulse.dot(p.normal) / world_->options().step * std::max(0.0, -p.gap);
    return sum;
  }

  const engine::World* world_;
  std::vector<double> energies_;
  double work_ = 0, total_ = 0, lowest_ = 0, largest_rise_ = 0, recoverable_ = 0;
};

/// The ledger's line in the table; `bound` [J] and its reason where the scene knows a tighter one.
inline void record_energy(const Problem& problem, const std::string& run, double largest_rise, double bound,
                          const std::string& reason =
                              "Only overlap gives energy back: at most force times "
                              "overlap, summed over the contacts at their worst step.") {
  record(problem, {.quantity = "largest rise of energy, " + run,
                   .unit = "J",
                   .expected = 0,
                   .source = "no energy from nothing",
                   .measured = largest_rise,
                   .budget = bound,
                   .budget_reason = reason});
}

}  // namespace drawpoint::validation
