// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Draws of a mean response over a box, as likely as noisy runs leave them: what is claimed of the response is
/// read off each draw, and scatters over the draws as far as the runs leave it unknown.
///
///   y_i = Σ_t c_t φ_t(x_i) + ε_i,  ε_i ~ N(0, w_i τ²),  c_t ~ N(0, ι^(m_t − 1) ∏_v b_v² δ^(d_v − 1))
/// The terms are those of polynomial_terms.h, the product goes over the m_t variables of a term and their degrees
/// d_v; the constant is free. y is standardised. b_v is how much a variable does alone, δ how fast higher degrees
/// vanish, ι how much variables do together. Priors: b_v half Cauchy of scale 1/2, by which a variable may do
/// nothing and another much; δ uniform on [0, 1]; ln ι normal, deviation 3/2; τ² as `degrees` squares of
/// known mean leave it (inverse χ²), or τ uniform where nothing is known. All of these are drawn along with the
/// coefficients, by slice sampling of the likelihood without c: fixed at their likeliest values, as a Kriging
/// model has them, they would hide how little noisy runs know of them. Deterministic in the seed. Cost: some 40
/// factorings of the matrix of terms per draw, whatever the number of runs.
/// Source: Neal 2003, Annals of Statistics 31, "Slice sampling"; Rasmussen, Williams 2006, "Gaussian processes for
/// machine learning", section 2.7, for explicit terms.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/seed.hpp>

#include <Eigen/Core>

namespace drawpoint::studies {

/// What is known of the noise of runs beforehand.
struct KnownNoise {
  double variance = 0;      ///< mean over the runs, unit of the response squared
  double degrees = 0;       ///< of freedom that stand behind it; 0: nothing is known
  Eigen::VectorXd weights;  ///< w, n entries of mean 1; empty: all 1
};

struct NoisyRuns {
  Eigen::MatrixXd X;  ///< n x d, natural units
  Eigen::VectorXd y;  ///< n
  KnownNoise noise;
};

/// At the points (m x d): m x count, unit of y. Where all y are equal, so are all draws.
Eigen::MatrixXd draw_means(const doe::Problem& problem, const NoisyRuns& runs, const Eigen::MatrixXd& points,
                           int count, doe::Seed seed);

}  // namespace drawpoint::studies
