// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What one run of a black box gives: its response values, or a failure with the reason.
///
/// A failed run is data: designs keep it, fits skip it, reports count it. The conversions are implicit on
/// purpose, so that a black box may simply `return 3.0;`, `return {a, b, c};`, `return y;` (an
/// Eigen::VectorXd) or `return doe::Failure{"bucket stuck"};`.

#include <Eigen/Core>
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

  /// What a failed run gave: no values, one per response of which one was refused, or another number.
  enum class Given { nothing, one_per_response, wrong_count };
  static Outcome refused(Given given, std::string reason) {
    Outcome outcome(Failure{std::move(reason)});
    outcome.given_ = given;
    return outcome;
  }
  Given given() const { return given_; }

 private:
  bool failed_ = false;
  Given given_ = Given::nothing;
  Eigen::VectorXd values_;
  std::string reason_;
};

}  // namespace drawpoint::doe
