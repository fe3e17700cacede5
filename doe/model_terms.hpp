// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The terms of a polynomial in the variables of a problem, as a row of numbers per run: what a regression
/// fits and an optimal design is chosen for.
///
///   linear        1, z_j
///   interactions  those, and z_j z_k for j < k
///   quadratic     those, and z_j² of every variable with an order
/// z is on [-1, 1], the bounds. A categorical variable of L levels has L − 1 columns in the place of z_j, of
/// which level l is row l of an orthogonal basis of the contrasts, each of length sqrt(L) over the levels; of
/// two levels these are −1 and 1. Which basis does not matter to the determinant of a design.

#include <Eigen/Core>
#include <cmath>
#include <string_view>
#include <vector>

#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/problem.hpp>

namespace drawpoint::doe {

enum class ModelTerms { linear, interactions, quadratic };

inline std::string_view to_string(ModelTerms terms) {
  switch (terms) {
    case ModelTerms::linear:
      return "linear";
    case ModelTerms::interactions:
      return "interactions";
    case ModelTerms::quadratic:
      return "quadratic";
  }
  return "unknown";
}

namespace detail {

/// Row `level` of Helmert's contrasts: column k compares level k + 1 with the mean of those before it.
inline Eigen::VectorXd contrasts(int level, int levels) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(levels - 1);
  for (int k = 0; k + 1 < levels; ++k) {
    const double unit = std::sqrt(levels / ((k + 1.0) * (k + 2.0)));
    if (level <= k) row[k] = -unit;
    if (level == k + 1) row[k] = (k + 1) * unit;
  }
  return row;
}

/// What stands for variable v at x.
inline Eigen::VectorXd coded(double x, const Variable& v) {
  if (v.kind == VariableKind::categorical)
    return contrasts(static_cast<int>(x), static_cast<int>(v.levels.size()));
  return Eigen::VectorXd::Constant(1, (x - v.lower) / (v.upper - v.lower) * 2.0 - 1.0);
}

inline Eigen::Index term_count(const Problem& problem, ModelTerms terms) {
  Eigen::Index linear = 0, pairs = 0, squares = 0;
  for (const Variable& v : problem.variables) {
    const bool ordered = v.kind != VariableKind::categorical;
    const Eigen::Index columns = ordered ? 1 : static_cast<Eigen::Index>(v.levels.size()) - 1;
    pairs += linear * columns;
    linear += columns;
    squares += ordered;
  }
  return 1 + linear + (terms == ModelTerms::linear ? 0 : pairs) +
         (terms == ModelTerms::quadratic ? squares : 0);
}

inline Eigen::VectorXd terms_at(const Eigen::VectorXd& x, const Problem& problem, ModelTerms terms) {
  Eigen::VectorXd row(term_count(problem, terms));
  std::vector<Eigen::VectorXd> z;
  Eigen::Index at = 0;
  row[at++] = 1.0;
  for (std::size_t j = 0; j < problem.variables.size(); ++j) {
    z.push_back(coded(x[static_cast<Eigen::Index>(j)], problem.variables[j]));
    for (const double entry : z.back()) row[at++] = entry;
  }
  if (terms == ModelTerms::linear) return row;
  for (std::size_t j = 0; j < z.size(); ++j)
    for (std::size_t k = 0; k < j; ++k)
      for (const double a : z[k])
        for (const double b : z[j]) row[at++] = a * b;
  if (terms == ModelTerms::interactions) return row;
  for (std::size_t j = 0; j < z.size(); ++j)
    if (problem.variables[j].kind != VariableKind::categorical) row[at++] = z[j][0] * z[j][0];
  return row;
}

}  // namespace detail

/// X: n x d inside the box; n x p, columns in the order above. Throws std::invalid_argument for points
/// outside of the box.
inline Eigen::MatrixXd model_matrix(const Problem& problem, const Eigen::MatrixXd& X, ModelTerms terms) {
  detail::check_inside(X, problem, "doe::model_matrix");
  Eigen::MatrixXd F(X.rows(), detail::term_count(problem, terms));
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    F.row(i) = detail::terms_at(X.row(i).transpose(), problem, terms).transpose();
  return F;
}

}  // namespace drawpoint::doe
