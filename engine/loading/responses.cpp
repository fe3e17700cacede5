// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/engine/loading/responses.hpp>
#include <numbers>
#include <stdexcept>

namespace drawpoint::engine::loading {
namespace {

using Eigen::Vector3d;

void require_cycles(const LoadingLog& log, const char* response) {
  if (log.cycles.empty())
    throw std::invalid_argument("loading::" + std::string(response) +
                                ": the log has no cycle; give the log of a run that loaded at least once");
}

void require_positive(const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw std::invalid_argument("loading::" + std::string(name) + " is " + std::to_string(value) +
                                "; give a finite value above 0");
}

double duration(const CycleRecord& cycle) {
  const double seconds = cycle.t_end - cycle.t_start;
  if (!(seconds > 0))
    throw std::invalid_argument("loading::production: a cycle lasts " + std::to_string(seconds) +
                                " s; a cycle's t_end [s] must be after its t_start [s]");
  return seconds;
}

// The torque signal, row by row.
class TorqueSignal {
 public:
  explicit TorqueSignal(const record::Table& signals)
      : signals_(signals),
        time_(signals.index("time")),
        torque_{signals.index("hinge_G_torque_x"), signals.index("hinge_G_torque_y"),
                signals.index("hinge_G_torque_z")},
        cycle_(signals.has("cycle") ? signals.index("cycle") : time_),
        has_cycle_(signals.has("cycle")) {}

  std::size_t rows() const { return signals_.rows(); }
  double time(std::size_t row) const { return signals_.at(row, time_); }
  Vector3d torque(std::size_t row) const {
    return {signals_.at(row, torque_[0]), signals_.at(row, torque_[1]), signals_.at(row, torque_[2])};
  }
  /// Whether a row begins a cycle's samples.
  bool begins(std::size_t row) const {
    return row == 0 || (has_cycle_ && signals_.at(row, cycle_) != signals_.at(row - 1, cycle_));
  }
  /// The time that a sample stands for [s].
  double weight(std::size_t row) const {
    if (!begins(row)) return time(row) - time(row - 1);
    const bool alone = row + 1 >= rows() || begins(row + 1);
    return alone ? 0.0 : time(row + 1) - time(row);
  }

 private:
  const record::Table& signals_;
  std::size_t time_;
  std::array<std::size_t, 3> torque_;
  std::size_t cycle_;
  bool has_cycle_;
};

// A sample at the start of a cycle stands for the time before it, unless it is the first of its samples.
bool within_a_cycle(const LoadingLog& log, double time, bool begins) {
  for (const CycleRecord& cycle : log.cycles)
    if ((begins ? time >= cycle.t_start : time > cycle.t_start) && time <= cycle.t_end) return true;
  return false;
}

double magnitude(const Vector3d& torque, TorqueComponent component) {
  return component == TorqueComponent::all ? torque.norm() : std::hypot(torque.x(), torque.z());
}

}  // namespace

double production(const LoadingLog& log, const ProductionOptions& options) {
  require_cycles(log, "production");
  double ratios = 0, mass = 0, time = 0;
  for (const CycleRecord& cycle : log.cycles) {
    ratios += cycle.loaded_mass / duration(cycle);
    mass += cycle.loaded_mass;
    time += duration(cycle);
  }
  if (options.mean == ProductionMean::ratio_of_sums) return mass / time;
  return ratios / static_cast<double>(log.cycles.size());
}

double joint_damage(const LoadingLog& log, const DamageOptions& options) {
  require_cycles(log, "joint_damage");
  require_positive("DamageOptions: tau_y [N m]", options.tau_y);
  if (!(options.lowpass_hz >= 0))
    throw std::invalid_argument("loading::DamageOptions: lowpass_hz [Hz] is " +
                                std::to_string(options.lowpass_hz) + "; give 0 (none) or more");
  const TorqueSignal signal(log.signals);
  double excess = 0;
  Vector3d filtered = Vector3d::Zero();
  for (std::size_t row = 0; row < signal.rows(); ++row) {
    const double dt = signal.weight(row);
    const bool direct = signal.begins(row) || options.lowpass_hz == 0;
    const double share = direct ? 1.0 : -std::expm1(-2 * std::numbers::pi * options.lowpass_hz * dt);
    filtered += share * (signal.torque(row) - filtered);
    if (within_a_cycle(log, signal.time(row), signal.begins(row)))
      excess += std::max(magnitude(filtered, options.component) - options.tau_y, 0.0) * dt;
  }
  const double run = excess / options.tau_y;
  return options.sum == DamageSum::whole_run ? run : run / static_cast<double>(log.cycles.size());
}

double rock_spill(const LoadingLog& log, const SpillOptions& options) {
  require_cycles(log, "rock_spill");
  require_positive("SpillOptions: m_max [kg]", options.m_max);
  double mass = 0;
  for (const CycleRecord& cycle : log.cycles) mass += cycle.spilled_mass;
  return mass / options.m_max / static_cast<double>(log.cycles.size());
}

}  // namespace drawpoint::engine::loading
