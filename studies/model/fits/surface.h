// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A surrogate as numbers: its mean, as a formula that a browser evaluates, and which variables
/// matter.
///
/// The mean is constant + Σₜ βₜ sₐ s_b + Σᵢ wᵢ c(s, cᵢ) with s = (x - centre)·factor, the terms sₐ s_b of the
/// trend and the correlation c of the model (kriging/correlation.hpp); s of a category is the index of its
/// level, and two different levels are 2 apart. Of a model on another scale
/// (kriging/transform.hpp) this is z, and the mean is h(z), a sum over the points of `noise`. All of it is
/// the model's own, so the browser sees its mean to rounding.
///
/// Influence is the total Sobol' index of doe/sensitivity.hpp, from 512 (d + 2) means.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/transformed_model.hpp>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace drawpoint::studies::detail {

struct Surface {
  Eigen::VectorXd centre, factor;  ///< d; factor 0 for a variable that never varied
  kriging::CorrelationFunction correlation;
  Eigen::MatrixXd X;                      ///< n x d, the c, scaled
  Eigen::VectorXd weights;                ///< n, unit of the response, or of z
  std::vector<kriging::TrendTerm> terms;  ///< the trend's
  Eigen::VectorXd coefficients;           ///< β, the same unit
  double constant = 0.0;                  ///< the same unit
  kriging::Transform transform = {};
  Eigen::VectorXd noise = {}, noise_weights = {};  ///< added to z, and how much each counts
};

/// Nothing for a trend of the user's own functions, which no browser knows.
std::optional<Surface> surface(const kriging::TransformedModel& model);

/// d total indices per model; all zero where the mean is constant. One model per response of the problem, or
/// none. Deterministic.
std::vector<Eigen::VectorXd> influence(const std::vector<kriging::TransformedModel>& models,
                                       const doe::Problem& problem);

}  // namespace drawpoint::studies::detail
