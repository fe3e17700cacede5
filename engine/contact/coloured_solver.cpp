// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <drawpoint/engine/contact/coloured_solver.hpp>
#include <drawpoint/engine/contact/machine_pairs.hpp>
#include <drawpoint/engine/contact/pair_batches.hpp>
#include <drawpoint/engine/contact/stage_team.hpp>

namespace drawpoint::engine::contact {
namespace {

using detail::BatchRange;
using detail::BodyRow;

constexpr int block_size = 6;  // batches that a thread claims at a time, some microseconds of work

class ColouredSolver {
 public:
  ColouredSolver(ContactProblem& problem, const SolverOptions& options)
      : problem_(problem),
        options_(options),
        batches_(problem, detail::colour(problem), options.substeps),
        machine_(problem, options.substeps),
        team_(options.threads),
        travel_(problem.bodies.size()) {
    everywhere([this](BatchRange range) { prepare_batches(batches_.arrays(), range); });
  }

  SolverReport solve() {
    for (int s = 0; s < options_.substeps; ++s) {
      begin_substep(s == 0);
      for (int k = 0; k < most_sweeps(options_, problem_.points.size()); ++k) {
        if (k >= options_.sweeps && change() <= options_.tolerance * normal_load()) break;
        sweep(k % 2 == 0);
      }
      machine_.finish();
      travel();
    }
    return store();
  }

 private:
  double change() const { return batches_.change() + machine_change_; }
  double normal_load() const { return batches_.normal_load() + machine_.normal_load(); }
  float h() const { return static_cast<float>(problem_.step / options_.substeps); }

  template <class Kernel>
  void over(BatchRange range, const Kernel& kernel) {
    const int blocks = (range.end - range.begin + block_size - 1) / block_size;
    if (options_.threads == 1 || blocks < 2) return kernel(range);
    team_.run(blocks, [&](int block) {
      const int begin = range.begin + block * block_size;
      kernel(BatchRange{begin, std::min(begin + block_size, range.end)});
    });
  }
  template <class Kernel>
  void everywhere(const Kernel& kernel) {  // for kernels that do not write bodies
    over({0, batches_.count()}, kernel);
  }

  void begin_substep(bool first) {
    batches_.end = batches_.bodies;
    const detail::Substep substep{h(), first};
    everywhere([&](BatchRange range) { refresh_batches(batches_.arrays(), range, substep); });
    machine_.refresh(batches_.end);
    if (first)
      start();
    else
      extrapolate();
    batches_.begin.swap(batches_.end);
  }

  void start() {
    for (std::size_t k = 0; k < problem_.bodies.size(); ++k)
      for (int i = 0; i < 3; ++i)
        batches_.bodies[k].velocity[i] += static_cast<float>(problem_.bodies[k].push[i] / options_.substeps);
    machine_.start(batches_.bodies);
    for (const BatchRange& colour : batches_.colours())
      over(colour, [this](BatchRange range) { start_batches(batches_.arrays(), range); });
  }

  // What changed a body in the last substep acts again: outer forces and contact impulses.
  void extrapolate() {
    machine_.extrapolate();
    for (std::size_t k = 0; k < batches_.bodies.size(); ++k) {
      BodyRow &now = batches_.bodies[k], &begin = batches_.begin[k];
      for (int i = 0; i < 3; ++i) {
        now.velocity[i] = 2 * now.velocity[i] - begin.velocity[i];
        now.angular_velocity[i] = 2 * now.angular_velocity[i] - begin.angular_velocity[i];
      }
    }
  }

  void sweep(bool forward) {
    machine_change_ = machine_.sweep(batches_.bodies, forward);
    const std::vector<BatchRange>& colours = batches_.colours();
    for (std::size_t c = 0; c < colours.size(); ++c)
      over(colours[forward ? c : colours.size() - 1 - c],
           [this](BatchRange range) { sweep_batches(batches_.arrays(), range); });
  }

  void travel() {
    for (std::size_t k = 0; k < travel_.size(); ++k)
      for (int i = 0; i < 3; ++i) {
        travel_[k].velocity[i] += h() * batches_.bodies[k].velocity[i];
        travel_[k].angular_velocity[i] += h() * batches_.bodies[k].angular_velocity[i];
      }
  }

  SolverReport store() {
    const auto vector = [](const float(&v)[4]) { return Eigen::Vector3d(v[0], v[1], v[2]); };
    for (std::size_t k = 0; k < problem_.bodies.size(); ++k) {
      SolverBody& body = problem_.bodies[k];
      body.velocity = vector(batches_.bodies[k].velocity);
      body.angular_velocity = vector(batches_.bodies[k].angular_velocity);
      body.travel = vector(travel_[k].velocity);
      body.turn = vector(travel_[k].angular_velocity);
    }
    batches_.store(problem_, options_.substeps);
    SolverReport report;
    report.machine = machine_.store(problem_);
    const double load = normal_load();
    report.last_change = load > 0 ? change() / load : 0;
    return report;
  }

  ContactProblem& problem_;
  SolverOptions options_;
  detail::PairBatches batches_;
  detail::MachinePairs machine_;
  detail::StageTeam team_;
  std::vector<BodyRow> travel_;  // ∫ v dt, ∫ ω dt
  double machine_change_ = 0;
};

}  // namespace

SolverReport solve_coloured(ContactProblem& problem, const SolverOptions& options) {
  return ColouredSolver(problem, options).solve();
}

}  // namespace drawpoint::engine::contact
