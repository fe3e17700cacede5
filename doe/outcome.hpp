// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What one run of a black box gives: its response values, or a failure with the reason.
///
/// A failed run is data: designs keep it, fits skip it, reports count it. The conversions are implicit on
/// purpose, so that a black box may simply `return 3.0;`, `return {a, b, c};`, `return y;` (an
/// Eigen::VectorXd) or `return doe::Failure{"bucket stuck"};`.

#include <Eigen/Core>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>

#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe {

struct Failure {
  std::string reason;
};

/// Values in the order of Problem::responses, or a reason.
class Outcome {
 public:
  Outcome() : Outcome(Failure{"no outcome was given"}) {}
  Outcome(double value) : values_(Eigen::VectorXd::Constant(1, value)) {}
  Outcome(std::initializer_list<double> values)
      : values_(Eigen::Map<const Eigen::VectorXd>(values.begin(), static_cast<Eigen::Index>(values.size()))) {
  }
  Outcome(Eigen::VectorXd values) : values_(std::move(values)) {}
  Outcome(Failure failure) : failed_(true), reason_(std::move(failure.reason)) {}

  bool failed() const { return failed_; }

  /// Empty when the run failed.
  const Eigen::VectorXd& values() const { return values_; }

  /// Empty when the run succeeded.
  const std::string& reason() const { return reason_; }

  /// A failed run: it gave so many values, which are not one per response.
  static Outcome of_wrong_count(Eigen::Index values, std::size_t responses) {
    Outcome outcome(Failure{"returned " + std::to_string(values) + " values where the problem has " +
                            std::to_string(responses) + " responses"});
    outcome.wrong_count_ = true;
    return outcome;
  }
  bool wrong_count() const { return wrong_count_; }

 private:
  bool failed_ = false, wrong_count_ = false;
  Eigen::VectorXd values_;
  std::string reason_;
};

}  // namespace drawpoint::doe
