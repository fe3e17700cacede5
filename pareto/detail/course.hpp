// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// When a search ends by its own rules (search.hpp): keeps the hypervolumes and tells the caller of progress.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto::detail {

class Course {
 public:
  /// Throws std::invalid_argument when the rules need a hypervolume of too many objectives, m.
  Course(const std::string& place, const Stopping& stopping, std::size_t m) : stopping_(stopping) {
    if (stopping.stall_generations && m > static_cast<std::size_t>(most_volume_objectives))
      throw std::invalid_argument(place + "stall_generations needs the hypervolume, which is limited to " +
                                  std::to_string(most_volume_objectives) + " objectives, not " +
                                  std::to_string(m) + "; leave stall_generations out");
  }

  /// H of the best points so far, n x m, minimised, where the rules ask for it; worst(): by objective, over
  /// the feasible points of this population, asked for once, when there is a first front.
  template <class Worst>
  std::optional<double> measured(const Eigen::MatrixXd& front, const Worst& worst) {
    if (!stopping_.stall_generations) return std::nullopt;
    if (front.rows() == 0) return 0.0;
    if (reference_.size() == 0) {
      const Eigen::RowVectorXd highest = worst();
      reference_ = (highest + 0.1 * (highest - front.colwise().minCoeff())).transpose();
    }
    volumes_.push_back(hypervolume(front, reference_));
    return volumes_.back();
  }

  /// After a generation; evaluations: with those of the next one.
  std::optional<StopReason> end(int generation, int evaluations) const {
    if (stalled()) return StopReason::stall;
    if (generation >= stopping_.generations) return StopReason::generations;
    if (stopping_.evaluations && evaluations > *stopping_.evaluations) return StopReason::evaluations;
    return std::nullopt;
  }

  /// Hypervolumes without a rule that asks for them would have a gap when it comes back.
  void forget_unused() {
    if (stopping_.stall_generations) return;
    reference_.resize(0);
    volumes_.clear();
  }

  template <class Self, class Stream>
  static void fields(Self& self, Stream& stream) {
    stream.item("volume_reference", self.reference_);
    stream.item("volumes", self.volumes_);
  }

 private:
  bool stalled() const {
    const auto window = static_cast<std::size_t>(stopping_.stall_generations.value_or(0));
    if (window == 0 || volumes_.size() <= window) return false;
    const double now = volumes_.back(), then = volumes_[volumes_.size() - 1 - window];
    return now - then <= stopping_.stall_gain * now;
  }

  Stopping stopping_;
  Eigen::VectorXd reference_;
  std::vector<double> volumes_;
};

}  // namespace drawpoint::pareto::detail
