// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The setting of a search along directions: those of the caller, checked, or evenly spread ones.

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <drawpoint/pareto/detail/checkpoint.hpp>
#include <drawpoint/pareto/detail/roles.hpp>
#include <drawpoint/pareto/detail/setting.hpp>
#include <drawpoint/pareto/reference_directions.hpp>

namespace drawpoint::pareto::detail {

inline Eigen::MatrixXd directions_for(const std::string& place, const std::optional<Eigen::MatrixXd>& given,
                                      const doe::Problem& problem, int population) {
  const auto m = static_cast<Eigen::Index>(roles(problem).objectives.size());
  if (!given) {
    check_range(place, "population", population, population >= std::max<Eigen::Index>(2, m),
                "2 or more, and one per objective or more");
    return reference_directions(static_cast<int>(m), population);
  }
  if (given->cols() != m)
    throw std::invalid_argument(place + "directions has " + std::to_string(given->cols()) +
                                " columns; the problem has " + std::to_string(m) + " objectives");
  if (given->rows() == 0)
    throw std::invalid_argument(place + "directions has no rows; give one at least, or leave it out");
  if (!given->allFinite() || given->minCoeff() < 0.0 || (given->rowwise().sum().array() <= 0.0).any())
    throw std::invalid_argument(place +
                                "directions holds a row that points nowhere; allowed are numbers from 0 up, "
                                "with at least one above 0 in each row");
  return *given;
}

struct Directed {
  Setting setting;
  Eigen::MatrixXd directions;
};

inline Directed directed(Setting setting, const std::optional<Eigen::MatrixXd>& given,
                         const doe::Problem& problem) {
  Eigen::MatrixXd directions = directions_for(setting.place, given, problem, setting.population);
  setting.own.emplace_back("directions", text_of(directions));
  return {std::move(setting), std::move(directions)};
}

}  // namespace drawpoint::pareto::detail
