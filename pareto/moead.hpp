// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// MOEA/D: one scalar problem for each direction, solved together with the neighbours' help.
///
/// Zhang, Li 2007, "MOEA/D: A multiobjective evolutionary algorithm based on decomposition", with the limits
/// on mating and replacement of Li, Zhang 2009. Problem k minimises, with F = (f - z*)/(nadir - z*), z* the
/// best values met and nadir the worst of the present feasible members,
/// * chebyshev: max_j F_j / w_kj, whose optimum lies on the direction w_k;
/// * pbi: d_1 + θ d_2, d_1 the length of F along w_k and d_2 its distance from that line.
/// A child of two neighbours (of anyone with probability 1 - δ) replaces at most `replacements` members in
/// whose problem it is better: less violation first, then the scalar. All children of a generation are one
/// batch and replace after it in random order, so that the black box may run them in parallel. A first
/// population with points of the caller is shared out among the directions (stable_matching.hpp).

#include <Eigen/Core>
#include <optional>
#include <string_view>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/pareto/ask_and_tell.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto {

enum class Scalarisation { chebyshev, pbi };

inline std::string_view to_string(Scalarisation form) {
  switch (form) {
    case Scalarisation::chebyshev:
      return "chebyshev";
    case Scalarisation::pbi:
      return "pbi";
  }
  return "unknown";
}

/// Every pair crosses (probability 1) where nothing else is said.
struct MoeadOptions {
  /// population: most directions, one per objective or more; the population has one point for each.
  SearchOptions search{};
  std::optional<Eigen::MatrixXd> directions{};  ///< k x m as in Nsga3Options
  Scalarisation scalarisation =
      Scalarisation::chebyshev;        ///< it reaches every shape of front; pbi is more even
  double penalty = 5.0;                ///< θ of pbi, above 0; the authors' value
  int neighbours = 20;                 ///< T, 2 or more; a fifth of the population, as the authors found best
  double neighbour_probability = 0.9;  ///< δ, 0 to 1
  int replacements = 2;                ///< per child, 1 or more; more copies good points and loses variety
};

/// Driven from outside (ask_and_tell.hpp). Throws as Nsga2 does.
class Moead : public Search {
 public:
  explicit Moead(const doe::Problem& problem, const MoeadOptions& options = {});
};

/// As nsga2: same problems, same errors, same result; at most one point per direction.
template <class F>
Front moead(const F& black_box, const doe::Problem& problem, const MoeadOptions& options = {}) {
  Moead search(problem, options);
  return finish(search, black_box);
}

}  // namespace drawpoint::pareto

#ifndef DRAWPOINT_PARETO_COMPILED
#include <drawpoint/pareto/detail/moead_definition.hpp>
#endif
