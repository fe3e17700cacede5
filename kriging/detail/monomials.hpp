// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The terms of a polynomial in d scaled inputs: products Π xₖ^aₖ, ordered by degree.
///
/// degree bounds Σ aₖ, `interaction` how many inputs a term may have: 1 for no products. All of degree 2 are
/// 1, xₐ, xₐx_b. Number of terms for interaction >= degree: (d + degree choose degree).

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace drawpoint::kriging {

/// aₖ, d entries.
using Monomial = std::vector<int>;

namespace detail {

inline int degree_of(const Monomial& term) {
  int sum = 0;
  for (const int a : term) sum += a;
  return sum;
}

/// Appends the terms that raise `term` in the inputs from `first` on by `left` in all.
inline void raise(Monomial& term, std::size_t first, int left, int inputs_left, std::vector<Monomial>& out) {
  if (left == 0) return out.push_back(term);
  if (inputs_left == 0) return;
  for (std::size_t k = first; k < term.size(); ++k)
    for (int a = left; a >= 1; --a) {
      term[k] = a;
      raise(term, k + 1, left - a, inputs_left - 1, out);
      term[k] = 0;
    }
}

inline std::vector<Monomial> monomials(Eigen::Index d, int degree, int interaction) {
  std::vector<Monomial> terms;
  Monomial term(static_cast<std::size_t>(d), 0);
  for (int total = 0; total <= degree; ++total) raise(term, 0, total, interaction, terms);
  return terms;
}

/// n x terms, at the rows of the scaled X: n x d.
inline Eigen::MatrixXd monomial_matrix(const std::vector<Monomial>& terms, const Eigen::MatrixXd& X) {
  Eigen::MatrixXd F = Eigen::MatrixXd::Ones(X.rows(), static_cast<Eigen::Index>(terms.size()));
  for (Eigen::Index j = 0; j < F.cols(); ++j)
    for (Eigen::Index k = 0; k < X.cols(); ++k)
      for (int a = 0; a < terms[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)]; ++a)
        for (Eigen::Index i = 0; i < X.rows(); ++i) F(i, j) *= X(i, k);
  return F;
}

/// ∂/∂x_k of one term at a scaled point x of d entries.
inline double monomial_slope(const Monomial& term, const Eigen::VectorXd& x, Eigen::Index k) {
  double slope = term[static_cast<std::size_t>(k)];
  for (Eigen::Index j = 0; j < x.size() && slope != 0.0; ++j)
    for (int a = j == k ? 1 : 0; a < term[static_cast<std::size_t>(j)]; ++a) slope *= x[j];
  return slope;
}

}  // namespace detail
}  // namespace drawpoint::kriging
