// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Estimates of the error on runs that are not there: leave-one-out, k-fold and hold-out, and a
/// measure made of one.
///
/// leave_one_out(model): closed form (left_out.hpp), θ and λ as fitted, β estimated anew without each run.
/// Cost n³/3, no refits. The s² is that of all runs, and what is unknown of θ and λ is left out. θ and λ have
/// seen the run, so the error is estimated somewhat low. A model in doubt (Model::doubt) is left out by its own
/// explanation alone. k_fold and hold_out fit anew without the runs that they predict: honest, at the cost of the fits.
/// A fitter f(X, y, rows) is told which runs it gets, for the noise of each. Repeats are left out together, since one
/// gives the others away: what is shared out at random, by the seed, are distinct points with all their runs.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/detail/left_out.hpp>
#include <drawpoint/kriging/detail/sites.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

/// Observed and predicted run by run, in the order of the runs. A constant model predicts its constant.
inline Validation leave_one_out(const Model& model) {
  const detail::ModelState& s = model.state();
  const Eigen::Index n = model.runs();
  Validation v;
  v.observed = s.observed;
  if (s.X.rows() == 0) {
    v.predicted = Eigen::VectorXd::Constant(n, s.y_centre);
    v.variance = v.observation_variance = Eigen::VectorXd::Constant(n, s.constant_variance);
    return detail::scored(std::move(v));
  }
  const detail::LeftOut out = detail::left_out(s.L, s.gls, s.X);
  const Eigen::VectorXd noise = detail::added_noise(s);
  v.predicted = v.variance = v.observation_variance = s.observed;
  for (Eigen::Index i = 0; i < n; ++i) {
    v.predicted[i] = s.observed[i] - s.y_scale * out.error[i];
    v.observation_variance[i] = model.process_variance() * out.variance[i];
    v.variance[i] = std::max(v.observation_variance[i] - model.process_variance() * noise[i], 0.0);
  }
  return detail::scored(std::move(v));
}

namespace detail {

inline std::vector<Eigen::Index> shuffled(Eigen::Index n, doe::Seed seed) {
  doe::RandomStream random(seed);
  return doe::detail::permutation(n, random);
}

/// The rows 0..n-1 that are not in `out`, which is sorted.
inline std::vector<Eigen::Index> rows_besides(const std::vector<Eigen::Index>& out, Eigen::Index n) {
  std::vector<Eigen::Index> in;
  for (Eigen::Index i = 0; i < n; ++i)
    if (!std::binary_search(out.begin(), out.end(), i)) in.push_back(i);
  return in;
}

/// The rows of sites dealt out at random to sorted folds, those of a site to the same; at most as many as there are
/// sites.
inline std::vector<std::vector<Eigen::Index>> folds_of(const std::vector<std::vector<Eigen::Index>>& sites,
                                                       Eigen::Index folds, doe::Seed seed) {
  const auto count = static_cast<Eigen::Index>(sites.size());
  const std::vector<Eigen::Index> order = shuffled(count, seed);
  std::vector<std::vector<Eigen::Index>> all(static_cast<std::size_t>(std::min(folds, count)));
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::vector<Eigen::Index>& site = sites[static_cast<std::size_t>(order[i])];
    std::vector<Eigen::Index>& fold = all[i % all.size()];
    fold.insert(fold.end(), site.begin(), site.end());
  }
  for (std::vector<Eigen::Index>& fold : all) std::sort(fold.begin(), fold.end());
  return all;
}

/// The same of the rows of X.
inline std::vector<std::vector<Eigen::Index>> folds_of(const Eigen::MatrixXd& X, Eigen::Index folds,
                                                       doe::Seed seed) {
  return folds_of(sites_of(X), folds, seed);
}

/// Sites at random until they hold this share of n runs; sorted. One site is left at least.
inline std::vector<Eigen::Index> share_of_runs(const std::vector<std::vector<Eigen::Index>>& sites,
                                               double share, Eigen::Index n, doe::Seed seed) {
  const auto count = std::clamp<Eigen::Index>(std::llround(share * static_cast<double>(n)), 1, n - 1);
  std::vector<Eigen::Index> order = shuffled(static_cast<Eigen::Index>(sites.size()), seed), out;
  order.pop_back();
  for (const Eigen::Index k : order) {
    if (static_cast<Eigen::Index>(out.size()) >= count) break;
    const std::vector<Eigen::Index>& site = sites[static_cast<std::size_t>(k)];
    out.insert(out.end(), site.begin(), site.end());
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Fits without the runs of `out`, sorted, and writes its predictions of them into v.
template <class F>
void predict_without(const std::vector<Eigen::Index>& out, const Eigen::MatrixXd& X, const F& fitter,
                     Validation& v) {
  const std::vector<Eigen::Index> in = rows_besides(out, X.rows());
  const Eigen::MatrixXd others = rows_of(X, in);  // with names: a fitter may take `auto&`
  const Eigen::VectorXd of_others = entries_of(v.observed, in);
  const auto model = fitted(fitter, others, of_others, in);
  const Eigen::MatrixXd points = rows_of(X, out);
  const Prediction p = model.predict(points), run = model.predict(points, Target::observation);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    v.predicted[out[i]] = p.mean[row];
    v.variance[out[i]] = p.variance[row];
    v.observation_variance[out[i]] = run.variance[row];
  }
}

inline Validation blank_validation(const Eigen::VectorXd& y) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(y.size());
  return {.observed = y, .predicted = none, .variance = none, .observation_variance = none};
}

}  // namespace detail

struct SplitOptions {
  doe::Seed seed = 1;  ///< of which runs are left out together
};

/// Every run predicted by a model of the other folds. X: n x d, y: n; 2 <= folds <= number of distinct rows.
/// Throws std::invalid_argument for other folds, unequal lengths, and as the fitter.
template <class F>
Validation k_fold(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, int folds, const F& fitter,
                  const SplitOptions& options = {}) {
  detail::require_fitter<F>();
  detail::check_validation(X, y, "kriging::k_fold: ");
  const auto sites = detail::sites_of(X);
  const std::size_t points = sites.size();
  if (folds < 2 || static_cast<std::size_t>(folds) > points)
    throw std::invalid_argument(
        "kriging::k_fold: folds is " + std::to_string(folds) + "; allowed is 2 to the " +
        std::to_string(points) +
        (points == static_cast<std::size_t>(X.rows()) ? " runs" : " distinct points") + "; use 5");
  Validation v = detail::blank_validation(y);
  for (const std::vector<Eigen::Index>& out : detail::folds_of(sites, folds, options.seed))
    detail::predict_without(out, X, fitter, v);
  return detail::scored(std::move(v));
}

/// A share of the runs, at least one, and their repeats, predicted by a model of the others. X: n x d, y: n;
/// 0 < share < 1. Throws std::invalid_argument for another share, fewer than two distinct rows, unequal
/// lengths, and as the fitter.
template <class F>
Validation hold_out(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, double share, const F& fitter,
                    const SplitOptions& options = {}) {
  detail::require_fitter<F>();
  detail::check_validation(X, y, "kriging::hold_out: ");
  const auto sites = detail::sites_of(X);
  const auto points = static_cast<Eigen::Index>(sites.size());
  if (!(share > 0 && share < 1) || points < 2) {
    const std::string kind = points == X.rows() ? " runs" : " distinct points";
    throw std::invalid_argument("kriging::hold_out: share is " + detail::text(share) + " of " +
                                std::to_string(points) + kind + "; allowed are numbers between 0 and 1 of 2" +
                                kind + " or more; use 0.2");
  }
  const std::vector<Eigen::Index> out = detail::share_of_runs(sites, share, X.rows(), options.seed);
  Validation all = detail::blank_validation(y);
  detail::predict_without(out, X, fitter, all);
  return detail::scored({.observed = detail::entries_of(all.observed, out),
                         .predicted = detail::entries_of(all.predicted, out),
                         .variance = detail::entries_of(all.variance, out),
                         .observation_variance = detail::entries_of(all.observation_variance, out)});
}

/// Surrogates whose leave_one_out(s), of each run without its site, needs no refits, or says by an empty optional
/// that it would.
template <class S>
concept LeaveOneOutInClosedForm = requires(const S& s) {
  { leave_one_out(s) } -> std::convertible_to<std::optional<Validation>>;
};

namespace detail {

/// Leave-one-out in closed form where the surrogate has one, else by a fit per distinct point.
template <class F>
Validation without_each(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const F& fitter,
                        const SplitOptions& options) {
  const auto model = fitted(fitter, X, y, rows_besides({}, X.rows()));
  if constexpr (LeaveOneOutInClosedForm<std::remove_cvref_t<decltype(model)>>)
    if (const std::optional<Validation> v = leave_one_out(model)) return *v;
  const auto points = static_cast<Eigen::Index>(sites_of(X).size());
  return k_fold(X, y, static_cast<int>(points), fitter, options);
}

}  // namespace detail

enum class Estimator { leave_one_out, k_fold, hold_out };

/// Whether a surrogate is good enough: (estimator, error function, target), as in SUMO.
struct Measure {
  doe::Seed seed = 1;                       ///< of what is left out
  Estimator estimator = Estimator::k_fold;  ///< leave_one_out refits for surrogates without a closed form
  ErrorFunction error = ErrorFunction::nrmse;
  double target = 0.05;  ///< met at or below it; for q2 and coverage at or above it
  int folds = 5;         ///< of k_fold
  double share = 0.2;    ///< of hold_out
  double level = 0.95;   ///< of coverage
};

struct Assessment {
  double value = 0;
  bool met = false;
  Validation validation;
};

/// Throws std::invalid_argument as k_fold, hold_out and score.
template <class F>
Assessment assess(const Measure& measure, const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                  const F& fitter) {
  detail::require_fitter<F>();
  Assessment a;
  if (measure.estimator == Estimator::k_fold)
    a.validation = k_fold(X, y, measure.folds, fitter, {.seed = measure.seed});
  else if (measure.estimator == Estimator::hold_out)
    a.validation = hold_out(X, y, measure.share, fitter, {.seed = measure.seed});
  else
    a.validation = detail::without_each(X, y, fitter, {.seed = measure.seed});
  a.value = score(a.validation, measure.error, measure.level);
  a.met = higher_is_better(measure.error) ? a.value >= measure.target : a.value <= measure.target;
  return a;
}

}  // namespace drawpoint::kriging
