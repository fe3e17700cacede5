// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Fits regression Kriging to runs: `Model model = fit(X, y);`
///
/// θ and λ maximise the concentrated log likelihood (likelihood.hpp). Candidates are ranked by their
/// likelihood, the best that lie apart start local searches by Ipopt (maximize.hpp), the best search wins. Up
/// to 250 runs all searches are made, by the secant curvature, and the winner is finished by the exact
/// Hessian. Beyond, where an evaluation is dear and maxima are fewer, the searches end as soon as three have
/// come within 0.1 of the best.
///
/// Deterministic: equal input gives equal bits. Safe to call concurrently; the searches then wait for each
/// other. Cost: about 20 to 40 evaluations of n³ operations a search; O(n²) memory. A model is always valid:
/// see Status for what was met on the way.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/likelihood.hpp>
#include <drawpoint/kriging/maximize.hpp>
#include <drawpoint/kriging/model.hpp>
#include <drawpoint/kriging/options.hpp>
#include <drawpoint/kriging/starting_points.hpp>
#include <drawpoint/kriging/training_data.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::kriging {

namespace detail {

inline constexpr double agreement = 0.1;         // log likelihood
inline constexpr int enough_agreeing = 3;        // of many runs
inline constexpr double condition_limit = 1e14;  // leaves two of the 16 digits

/// Bounds of (ln θ, ln λ). An input that never varies has no θ to estimate: it is fixed.
inline Box parameter_box(const TrainingData& data, const FitOptions& options) {
  const Eigen::Index d = data.X.cols();
  Box box{Eigen::VectorXd::Constant(d + 1, std::log(options.theta_lower)),
          Eigen::VectorXd::Constant(d + 1, std::log(options.theta_upper))};
  for (Eigen::Index k = 0; k < d; ++k)
    if (data.input.factor[k] == 0.0) box.upper[k] = box.lower[k];
  box.lower[d] = std::log(options.nugget_lower);
  box.upper[d] = std::log(options.nugget_upper);
  return box;
}

inline std::string inputs_that_never_vary(const TrainingData& data) {
  std::string text;
  for (Eigen::Index k = 0; k < data.X.cols(); ++k)
    if (data.input.factor[k] == 0.0)
      text += "; input " + std::to_string(k) + " never varies, so predictions ignore it";
  return text;
}

struct Search {
  Maximum best;
  int tried = 0, agreed = 0;
};

inline Search search_from(Likelihood& likelihood, const Box& box, const std::vector<Eigen::VectorXd>& starts,
                          int max_iterations) {
  const bool many_runs = likelihood.runs() > many;
  std::vector<double> values;
  Search search;
  for (const Eigen::VectorXd& start : starts) {
    const Maximum found = maximize(likelihood, box, start, Curvature::secant, max_iterations);
    values.push_back(found.value);
    if (found.value > search.best.value) search.best = found;
    search.agreed = static_cast<int>(std::count_if(
        values.begin(), values.end(), [&](double v) { return v >= search.best.value - agreement; }));
    if (many_runs && search.agreed >= enough_agreeing) break;
  }
  search.tried = static_cast<int>(values.size());
  return search;
}

/// Searches the box; the best point has the value −∞ when R is singular wherever it was tried.
inline Search search(Likelihood& likelihood, const TrainingData& data, const Box& box,
                     const FitOptions& options, int& evaluations) {
  Likelihood screen(thinned(data.X, many), thinned(data.y, many));
  const auto starts = starting_points(screen, box, options);
  evaluations += screen.factorizations();
  if (box.lower == box.upper) return {{starts.front(), likelihood.value(starts.front()), true}, 1, 1};
  Search found = search_from(likelihood, box, starts, options.max_iterations);
  if (!std::isfinite(found.best.value) || likelihood.runs() > many) return found;
  const Maximum finished = maximize(likelihood, box, found.best.p, Curvature::exact, options.max_iterations);
  if (finished.value >= found.best.value) {
    const bool converged = found.best.converged || finished.converged;
    found.best = finished;
    found.best.converged = converged;
  }
  return found;
}

/// The status and the message of a search whose best point `likelihood` stands at.
inline void judge(const Search& search, const Likelihood& likelihood, FitReport& report) {
  report.starts_tried = search.tried;
  report.starts_agreed = search.agreed;
  report.condition = likelihood.condition();
  report.status = search.best.converged ? Status::converged : Status::not_converged;
  report.message = std::to_string(search.agreed) + " of " + std::to_string(search.tried) +
                   " local searches agreed on the best likelihood";
  if (!search.best.converged)
    report.message += "; the best of them ended before its stopping rule: raise max_iterations or starts";
  if (!(report.condition < condition_limit)) {
    report.status = Status::ill_conditioned;
    report.message += "; the correlation matrix has condition " + text(report.condition) +
                      ": raise nugget_lower or remove runs that nearly repeat others";
  }
}

inline Model constant_model(const TrainingData& data, const FitOptions& options) {
  FitReport report;
  report.status = Status::constant_response;
  report.message = "all responses equal " + text(data.y_centre) + ": the model is that constant";
  return Model(data, options, report);
}

}  // namespace detail

/// X: n x d, one run a row, natural units; y: n, any unit. Throws std::invalid_argument for fewer than two
/// runs, unequal lengths, numbers that are not finite, and options out of their range.
inline Model fit(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const FitOptions& options = {}) {
  const detail::TrainingData data = detail::prepare(X, y, options);
  if (data.y.size() == 0) return detail::constant_model(data, options);
  Likelihood likelihood(data.X, data.y);
  Box box = detail::parameter_box(data, options);
  FitReport report;
  detail::Search found = detail::search(likelihood, data, box, options, report.evaluations);
  const bool singular = !std::isfinite(found.best.value);
  // λ of some n times the round-off makes any correlation matrix positive definite, so this ends.
  while (!std::isfinite(found.best.value)) {
    box.lower.tail<1>().array() += std::log(100.0);
    box.upper = box.upper.cwiseMax(box.lower);
    found = detail::search(likelihood, data, box, options, report.evaluations);
  }
  likelihood.value(found.best.p);
  report.evaluations += likelihood.factorizations();
  detail::judge(found, likelihood, report);
  if (singular) {
    report.status = Status::ill_conditioned;
    report.message += "; the matrix was singular within nugget_upper, so the nugget was raised to " +
                      detail::text(likelihood.nugget());
  }
  report.message += detail::inputs_that_never_vary(data);
  return Model(data, likelihood, report);
}

}  // namespace drawpoint::kriging
