// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/statistics/polynomial_terms.h>

#include <cmath>
#include <vector>

namespace drawpoint::studies {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

void add_degrees(std::vector<Eigen::RowVectorXi>& terms, Eigen::RowVectorXi& degrees, Index v, int size) {
  if (v == degrees.size()) {
    terms.push_back(degrees);
    return;
  }
  for (int d = 0; size * (1 + d) <= largest_term; ++d) {
    degrees[v] = d;
    add_degrees(terms, degrees, v + 1, size * (1 + d));
  }
}

/// √(2d + 1) P_d of each degree, one per column.
MatrixXd legendre(const Eigen::VectorXd& u) {
  MatrixXd P(u.size(), largest_term);
  P.col(0).setOnes();
  P.col(1) = u;
  for (int d = 1; d + 1 < largest_term; ++d)
    P.col(d + 1) = ((2 * d + 1) * u.cwiseProduct(P.col(d)) - d * P.col(d - 1)) / (d + 1);
  for (int d = 0; d < largest_term; ++d) P.col(d) *= std::sqrt(2 * d + 1);
  return P;
}

}  // namespace

Eigen::MatrixXi term_degrees(Index variables) {
  std::vector<Eigen::RowVectorXi> terms;
  Eigen::RowVectorXi degrees = Eigen::RowVectorXi::Zero(variables);
  add_degrees(terms, degrees, 0, 1);
  Eigen::MatrixXi all(static_cast<Index>(terms.size()), variables);
  for (Index t = 0; t < all.rows(); ++t) all.row(t) = terms[static_cast<std::size_t>(t)];
  return all;
}

MatrixXd term_values(const doe::Problem& problem, const Eigen::MatrixXi& degrees, const MatrixXd& X) {
  MatrixXd B = MatrixXd::Ones(X.rows(), degrees.rows());
  for (Index v = 0; v < X.cols(); ++v) {
    const doe::Variable& variable = problem.variables[static_cast<std::size_t>(v)];
    const double middle = 0.5 * (variable.lower + variable.upper), half = variable.upper - middle;
    const MatrixXd P = legendre((X.col(v).array() - middle) / half);
    for (Index t = 0; t < degrees.rows(); ++t) B.col(t).array() *= P.col(degrees(t, v)).array();
  }
  return B;
}

}  // namespace drawpoint::studies
