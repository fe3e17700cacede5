// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Evenly spread directions for decomposition: points of the unit simplex, w_j >= 0, Σ w_j = 1.
///
/// A lattice of p divisions has the C(p+m-1, m-1) points of multiples of 1/p (Das, Dennis 1998). It has inner
/// points only when p >= m, which is too many points for many objectives; there an outer lattice and an inner
/// one, halved towards the centre, make two layers (Deb, Jain 2014).

#include <Eigen/Core>
#include <stdexcept>
#include <string>
#include <vector>

#include <drawpoint/doe/problem.hpp>

namespace drawpoint::pareto {

/// m >= 1 objectives, divisions p >= 1; C(p+m-1, m-1) x m, in lexicographic order from the last objective.
inline Eigen::MatrixXd simplex_lattice(int m, int divisions) {
  if (m < 1 || divisions < 1)
    throw std::invalid_argument("pareto::simplex_lattice: " + std::to_string(m) + " objectives and " +
                                std::to_string(divisions) + " divisions; allowed is 1 or more of both");
  std::vector<Eigen::RowVectorXd> points;
  Eigen::RowVectorXd count = Eigen::RowVectorXd::Zero(m);
  count[m - 1] = divisions;
  while (true) {
    points.push_back(count / divisions);
    int j = m - 1;  // the last objective with a share moves one unit forward, what is left goes to the end
    while (j > 0 && count[j] == 0.0) --j;
    if (j == 0) break;
    const double rest = count[j] - 1.0;
    count[j] = 0.0;
    count[j - 1] += 1.0;
    count[m - 1] = rest;
  }
  Eigen::MatrixXd W(static_cast<Eigen::Index>(points.size()), m);
  for (std::size_t i = 0; i < points.size(); ++i) W.row(static_cast<Eigen::Index>(i)) = points[i];
  return W;
}

namespace detail {

/// C(p+m-1, m-1), cut at `limit` + 1.
inline int lattice_size(int m, int divisions, int limit) {
  double count = 1.0;
  for (int k = 1; k < m; ++k) count = count * (divisions + k) / k;
  return count > limit ? limit + 1 : static_cast<int>(count + 0.5);
}

/// The most divisions whose lattice has at most `limit` points; 0 when there is none.
inline int most_divisions(int m, int limit) {
  int divisions = 0;
  while (m > 1 && lattice_size(m, divisions + 1, limit) <= limit) ++divisions;
  return m == 1 ? 1 : divisions;
}

}  // namespace detail

/// As many directions as `at_most` allows, k x m: one lattice when it has inner points, else two layers.
/// Throws std::invalid_argument when at_most is below m, which one direction an objective needs.
inline Eigen::MatrixXd reference_directions(int m, int at_most) {
  if (m < 1 || at_most < m)
    throw std::invalid_argument("pareto::reference_directions: at_most is " + std::to_string(at_most) +
                                " for " + std::to_string(m) +
                                " objectives; allowed is one per objective or more");
  const int outer = detail::most_divisions(m, at_most);
  const Eigen::MatrixXd lattice = simplex_lattice(m, outer);
  if (outer >= m) return lattice;
  const int inner = detail::most_divisions(m, at_most - static_cast<int>(lattice.rows()));
  if (inner == 0) return lattice;
  const Eigen::MatrixXd small = simplex_lattice(m, inner);
  Eigen::MatrixXd both(lattice.rows() + small.rows(), m);
  both << lattice, (0.5 * small.array() + 0.5 / m).matrix();
  return both;
}

}  // namespace drawpoint::pareto
