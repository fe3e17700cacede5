// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// When a search stops (the rules are in search.hpp): keeps the hypervolumes and asks the caller.

#include <Eigen/Core>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto::detail {

class Course {
 public:
  /// Throws std::invalid_argument on a faulty rule; m: number of objectives.
  Course(const std::string& place, const Stopping& stopping, ProgressFunction progress, std::size_t m)
      : stopping_(stopping), progress_(std::move(progress)) {
    check(place, stopping);
    if (stopping.stall_generations > 0 && m > static_cast<std::size_t>(most_volume_objectives))
      throw std::invalid_argument(place + "stall_generations needs the hypervolume, which is limited to " +
                                  std::to_string(most_volume_objectives) + " objectives, not " +
                                  std::to_string(m) + "; set stall_generations = 0");
  }

  /// front: the best points so far, n x m; worst(): by objective, over the feasible points of this
  /// population, asked for once, when there is a first front.
  template <class Worst>
  bool done(Progress now, const Eigen::MatrixXd& front, const Worst& worst, int next_evaluations) {
    now.front = static_cast<int>(front.rows());
    if (stopping_.stall_generations > 0) now.hypervolume = volume(front, worst);
    if (progress_ && !progress_(now)) return stop(StopReason::progress);
    if (stalled()) return stop(StopReason::stall);
    if (now.generation >= stopping_.generations) return stop(StopReason::generations);
    if (stopping_.evaluations > 0 && now.evaluations + next_evaluations > stopping_.evaluations)
      return stop(StopReason::evaluations);
    return false;
  }

  StopReason reason() const { return reason_; }

 private:
  bool stop(StopReason reason) {
    reason_ = reason;
    return true;
  }

  template <class Worst>
  double volume(const Eigen::MatrixXd& front, const Worst& worst) {
    if (front.rows() == 0) return 0.0;
    if (reference_.size() == 0) {
      const Eigen::RowVectorXd highest = worst();
      reference_ = (highest + 0.1 * (highest - front.colwise().minCoeff())).transpose();
    }
    volumes_.push_back(hypervolume(front, reference_));
    return volumes_.back();
  }

  bool stalled() const {
    const auto window = static_cast<std::size_t>(stopping_.stall_generations);
    if (window == 0 || volumes_.size() <= window) return false;
    const double now = volumes_.back(), then = volumes_[volumes_.size() - 1 - window];
    return now - then <= stopping_.stall_gain * now;
  }

  Stopping stopping_;
  ProgressFunction progress_;
  Eigen::VectorXd reference_;
  std::vector<double> volumes_;
  StopReason reason_ = StopReason::generations;
};

}  // namespace drawpoint::pareto::detail
