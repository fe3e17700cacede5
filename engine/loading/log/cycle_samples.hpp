// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <functional>
#include <optional>
#include <string>
#include <utility>

/// How the signals of a run log belong to its cycles, and a low-pass over them.
///
/// A sample stands for the time since the one before it in the same cycle, a cycle's first sample for the
/// time to the next; a cycle's only one for none. Low-pass of a vector: y += (1 − exp(−2π f Δt)) (x − y) on
/// each component, started anew with each cycle.
namespace drawpoint::engine::loading {

class CycleSamples {
 public:
  /// Throws std::invalid_argument if there is no column "time". Without a column "cycle" all is one.
  explicit CycleSamples(const LoadingLog& log);

  std::size_t rows() const { return log_.signals.rows(); }
  double time(std::size_t row) const { return log_.signals.at(row, time_); }
  /// Whether a row begins a cycle's samples.
  bool begins(std::size_t row) const;
  /// The time that a sample stands for [s].
  double weight(std::size_t row) const;
  /// Index of the cycle that a sample counts for; none between cycles. A sample at the start of a cycle
  /// stands for the time before it, unless it is the first of its samples.
  std::optional<std::size_t> cycle(std::size_t row) const;

 private:
  const LoadingLog& log_;
  std::size_t time_, cycle_;
  bool has_cycle_;
};

/// A vector of every row, low-passed.
class LowPassedVector {
 public:
  /// corner [Hz]; 0: no filter.
  LowPassedVector(std::function<Eigen::Vector3d(std::size_t row)> vector, double corner)
      : vector_(std::move(vector)), corner_(corner) {}
  /// The vector is three signals, NAME_x, NAME_y, NAME_z. Throws std::invalid_argument if a column is missing.
  LowPassedVector(const LoadingLog& log, const std::string& name, double corner);
  /// The next row's value; rows are taken in order, from the first.
  const Eigen::Vector3d& next(const CycleSamples& samples);

 private:
  std::function<Eigen::Vector3d(std::size_t row)> vector_;
  double corner_;
  std::size_t row_ = 0;
  Eigen::Vector3d value_ = Eigen::Vector3d::Zero();
};

}  // namespace drawpoint::engine::loading
