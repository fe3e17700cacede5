// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Several ways to fit the same runs, scored alike, and the best of them.
///
/// Each fitter is assessed by the same (estimator, error function, target) with the same folds; the best
/// score wins, of equal ones the earlier, and a score that is NaN never does. The winner is then fitted to
/// all runs. Choosing among k of them makes the winner's own score somewhat optimistic: the more, the noisier
/// the estimate and the larger k. Cost: the sum of the estimates. Deterministic.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/kriging/any_surrogate.hpp>
#include <drawpoint/kriging/cross_validation.hpp>

namespace drawpoint::kriging {

/// A way to fit. `S` is what all fitters of a comparison give; AnySurrogate lets kinds mix.
template <class S = AnySurrogate>
struct NamedFitter {
  std::string name;
  std::function<S(const Eigen::MatrixXd& X, const Eigen::VectorXd& y)> fitter;
};

struct Standing {
  std::string name;
  Assessment assessment;
};

template <class S = AnySurrogate>
struct Comparison {
  std::vector<Standing> table;  ///< in the order of the fitters
  std::size_t best = 0;         ///< of the table
  S model;                      ///< the best way, fitted to all runs
  bool met = false;             ///< whether the target is

  const std::string& name() const { return table[best].name; }
};

namespace detail {

/// The first of the best scores; 0 when all are NaN.
inline std::size_t best_standing(const std::vector<Standing>& table, bool higher) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < table.size(); ++k) {
    const double now = table[best].assessment.value, value = table[k].assessment.value;
    if (std::isnan(now) ? !std::isnan(value) : (higher ? value > now : value < now)) best = k;
  }
  return best;
}

}  // namespace detail

/// X: n x d, y: n, natural units. Throws std::invalid_argument without fitters, for one without a function,
/// and as assess and the fitters do.
template <class S = AnySurrogate>
Comparison<S> compare(const Measure& measure, const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                      const std::vector<NamedFitter<S>>& fitters) {
  if (fitters.empty())
    throw std::invalid_argument("kriging::compare: 0 fitters; allowed is 1 or more; name at least one");
  std::vector<Standing> table;
  for (const NamedFitter<S>& way : fitters) {
    if (!way.fitter)
      throw std::invalid_argument("kriging::compare: fitter \"" + way.name +
                                  "\" has no function; give one of (X, y) that returns a surrogate");
    table.push_back({way.name, assess(measure, X, y, way.fitter)});
  }
  const std::size_t best = detail::best_standing(table, higher_is_better(measure.error));
  const bool met = table[best].assessment.met;
  return {std::move(table), best, fitters[best].fitter(X, y), met};
}

/// The model of the best fitter alone.
template <class S = AnySurrogate>
S best_of(const Measure& measure, const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
          const std::vector<NamedFitter<S>>& fitters) {
  return compare(measure, X, y, fitters).model;
}

}  // namespace drawpoint::kriging
