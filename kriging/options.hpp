// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What a fit can be told, and what it reports.
///
/// θ lives on inputs scaled to [-1, 1]; θ = 1/(8 l²) for a length scale l on [0, 1]. The nugget λ is a share
/// of the process variance: the noise variance is λ s². The default bounds are l in [0.01, 100] and λ in
/// [1e-10, 10].

#include <Eigen/Core>
#include <drawpoint/doe/seed.hpp>
#include <string>
#include <string_view>

namespace drawpoint::kriging {

struct FitOptions {
  /// The box that is scaled to [-1, 1], natural units, one entry a variable. Empty: the range of the data.
  /// Give the box of the problem when θ is to be compared between fits to different runs.
  Eigen::VectorXd lower, upper;

  double theta_lower = 1.25e-5, theta_upper = 1250.0;  ///< > 0; equal bounds fix θ
  /// > 0; equal bounds fix λ. Far below 1e-10 the matrix of some hundred smooth runs is singular to
  /// round-off.
  double nugget_lower = 1e-10, nugget_upper = 10.0;

  /// Local searches, >= 1. The likelihood of a smooth response has several maxima: on three published cases
  /// of 100 runs between one in eight and all of the searches find the best one.
  int starts = 8;
  int candidates = 128;      ///< points from which the starts are chosen by their likelihood, >= starts
  int max_iterations = 200;  ///< of one local search, >= 1
  doe::Seed seed = 1;        ///< of the candidates
};

enum class Status {
  converged,          ///< the best local search met its stopping rule
  not_converged,      ///< the best search ended before its stopping rule: valid, maybe not the likeliest
  constant_response,  ///< all y are equal: the model is that constant with variance 0
  ill_conditioned     ///< a valid model, but R is so close to singular that few digits can be trusted
};

inline std::string_view to_string(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::not_converged:
      return "not_converged";
    case Status::constant_response:
      return "constant_response";
    case Status::ill_conditioned:
      return "ill_conditioned";
  }
  return "unknown";
}

struct FitReport {
  Status status = Status::converged;
  std::string message;    ///< for people; names also the inputs that never vary
  int starts_tried = 0;   ///< local searches that were run
  int starts_agreed = 0;  ///< of these, how many came within 0.1 of the best log likelihood
  int evaluations = 0;    ///< correlation matrices factored, the screening of the candidates included
  double condition = 1;   ///< estimate of the 1-norm condition number of R
};

}  // namespace drawpoint::kriging
