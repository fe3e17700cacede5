// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Objectives in the form that dominance, indicators and most of the literature take: all minimised.
///
/// Values of fronts are in natural units and signs. Functions that measure or sort them come in two forms:
/// one takes the problem and values in natural signs, and turns the signs of what is maximised itself; the
/// other takes a bare matrix and minimises every column. `minimised` leads from the one to the other, and
/// back: it is its own inverse.

#include <Eigen/Core>
#include <stdexcept>
#include <string>

#include <drawpoint/pareto/detail/roles.hpp>

namespace drawpoint::pareto {

/// Y: n x m, the objectives in the order of the problem's responses. Throws std::invalid_argument for another
/// number of columns.
inline Eigen::MatrixXd minimised(const doe::Problem& problem, const Eigen::MatrixXd& Y) {
  const detail::Roles role = detail::roles(problem);
  if (Y.cols() != static_cast<Eigen::Index>(role.signs.size()))
    throw std::invalid_argument("pareto::minimised: Y has " + std::to_string(Y.cols()) +
                                " columns, the problem has " + std::to_string(role.signs.size()) +
                                " objectives; give one column per objective");
  return Y * detail::signs_of(role).asDiagonal();
}

}  // namespace drawpoint::pareto
