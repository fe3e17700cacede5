// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Where a surrogate wants the next run: criteria for doe::propose and doe::refine, higher is better.
///
/// With mean μ and deviation σ at x, f* the best value so far, z = (f* − μ)/σ (signs turned to maximise):
///   maximum_variance           σ²
///   expected_improvement       E[(f* − Y)⁺] = σ [φ(z) + zΦ(z)]
///   log_expected_improvement   its logarithm: the same order, also where the number underflows
///   predicted_value            −μ: where the model expects the best
///   cross_validation_error     |leave-one-out error| of the nearest run: constant in its cell
/// For a Kriging model the improvement is that of its re-interpolation: of a noisy response the mean at the
/// runs counts as known, so that no run is asked for again, and f* is the best of these means, not the
/// luckiest observation. Much noise: acquisition_gradient.hpp; whole batches: acquisition_joint.hpp. Limits
/// are in acquisition_constraints.hpp, several objectives in acquisition_hypervolume.hpp.
/// Sources: Jones, Schonlau, Welch 1998, J. Global Optimization 13 (EI); Forrester, Keane, Bressloff 2006,
/// AIAA J. 44(10) (re-interpolation); Ament et al. 2023 (logarithm).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <drawpoint/doe/criterion.hpp>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/kriging/detail/left_out.hpp>
#include <drawpoint/kriging/detail/nearest_rows.hpp>
#include <drawpoint/kriging/detail/normal.hpp>
#include <drawpoint/kriging/reinterpolation.hpp>
#include <drawpoint/kriging/surrogate.hpp>

namespace drawpoint::kriging {

namespace detail {

/// The sign of an objective's goal: +1 to minimise, −1 to maximise.
inline double sign_of(const char* place, doe::Goal goal) {
  if (!doe::is_objective(goal))
    throw std::invalid_argument(
        std::string(place) + ": goal is " + std::string(doe::to_string(goal)) +
        "; allowed are minimize and maximize; use probability_of_feasibility for limits");
  return doe::sign_of(goal);
}

inline void check_finite(const char* place, const char* name, double value) {
  if (!std::isfinite(value))
    throw std::invalid_argument(std::string(place) + ": " + name + " is " + doe::detail::number_text(value) +
                                "; allowed are finite numbers; leave failed runs out");
}

/// Variances up to this are round-off of the factor of an interpolating model: at a run the variance is at
/// most λs²(1 + 1/4), with the small λ of reinterpolation.hpp.
inline double variance_floor(const Model& interpolating) { return 2.0 * interpolating.noise_variance(); }

/// The Kriging model that a surrogate is or holds, else nullptr.
template <class S>
const Model* kriging_model(const S& surrogate) {
  if constexpr (std::is_same_v<S, Model>)
    return &surrogate;
  else if constexpr (requires { surrogate.template as<Model>(); })
    return surrogate.template as<Model>();
  else
    return nullptr;
}

/// The surrogate that a search for improvement asks: one that can be is re-interpolated, also behind
/// AnySurrogate, and the round-off of a Kriging model at the runs is no variance.
template <class S>
class SearchModel {
 public:
  explicit SearchModel(const S& model) : model_(searched(model)) {}

  /// Mean and variance of the latent function at the rows of X: m x d.
  Prediction predict(const Eigen::MatrixXd& X) const {
    Prediction p = model_.predict(X);
    if (const Model* model = kriging_model(model_))
      for (double& v : p.variance) v = v <= variance_floor(*model) ? 0.0 : v;
    return p;
  }

 private:
  static S searched(const S& model) {
    if constexpr (requires { reinterpolated(model); })
      return reinterpolated(model);
    else
      return model;
  }

  S model_;
};

}  // namespace detail

/// The model's means at its own runs, without their noise: n entries, unit of y.
inline Eigen::VectorXd fitted_values(const Model& model) {
  const detail::ModelState& s = model.state();
  if (s.X.rows() == 0) return Eigen::VectorXd::Constant(s.observed.size(), s.y_centre);
  const Eigen::VectorXd share = detail::entry_products(detail::added_noise(s), s.gls.alpha);
  return detail::difference(s.observed, detail::affine(share, s.y_scale));
}

/// Surrogates of noisy runs that tell what they hold these to be without noise: fitted_values(s), n entries,
/// and reinterpolated(s), the surrogate that interpolates those.
template <class S>
concept Regression = Surrogate<S> && requires(const S& s) {
  { fitted_values(s) } -> std::convertible_to<Eigen::VectorXd>;
  { reinterpolated(s) } -> std::convertible_to<S>;
  { s.runs() } -> std::convertible_to<Eigen::Index>;
};

static_assert(Regression<Model>);

/// σ² of the latent function, unit of y squared.
template <class S>
doe::Criterion maximum_variance(S model) {
  detail::require_surrogate<S>();
  return [model = std::move(model)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    return model.predict(X).variance;
  };
}

/// Where the surrogate expects the best: −μ to minimise, μ to maximise. Not to be used alone: it asks beside
/// the best run. Every third run by it finishes what improvement begins (docs/explanation/doe.md, "Searches for an
/// optimum"). Throws std::invalid_argument for a goal of another kind.
template <class S>
doe::Criterion predicted_value(S model, doe::Goal goal) {
  detail::require_surrogate<S>();
  const double sign = detail::sign_of("kriging::predicted_value", goal);
  return [model = std::move(model), sign](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    return detail::affine(model.mean(X), -sign);
  };
}

namespace detail {

struct ImprovementOn {
  double best;     ///< unit of y
  double sign;     ///< +1 to minimise, −1 to maximise
  bool logarithm;  ///< ln E instead of E
};

/// By the model as it is; it has predict(X).
template <class S>
doe::Criterion improvement(S model, const ImprovementOn& on) {
  return [model = std::move(model), on](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    const Prediction p = model.predict(X);
    Eigen::VectorXd score(X.rows());
    for (Eigen::Index i = 0; i < score.size(); ++i) {
      const double gain = on.sign * (on.best - p.mean[i]);
      const double deviation = std::sqrt(p.variance[i]);
      if (!on.logarithm)
        score[i] = expected_shortfall(gain, 0.0, deviation);
      else if (deviation > 0)
        score[i] = std::log(deviation) + log_normal_improvement(gain / deviation);
      else
        score[i] = std::log(std::max(gain, 0.0));
    }
    return score;
  };
}

/// By the re-interpolated model, on the best fitted value of `runs`, all of them when empty.
template <Regression S>
doe::Criterion reinterpolated_improvement(const S& model, double sign, bool logarithm,
                                          const std::vector<Eigen::Index>& runs = {}) {
  Eigen::VectorXd values = affine(fitted_values(model), sign);
  if (!runs.empty()) values = entries_of(values, runs);
  return improvement(SearchModel<S>(model), {sign * smallest_entry(values), sign, logarithm});
}

}  // namespace detail

/// Improvement on a value of your own, `best` in the unit of y, with the variance of the surrogate as it is;
/// goal: minimize or maximize. Throws std::invalid_argument for another goal and a best that is not finite.
template <class S>
doe::Criterion expected_improvement(S model, doe::Goal goal, double best) {
  detail::require_surrogate<S>();
  detail::check_finite("kriging::expected_improvement", "best", best);
  const double sign = detail::sign_of("kriging::expected_improvement", goal);
  return detail::improvement(std::move(model), {best, sign, false});
}

/// Improvement on the best of the fitted values, by the re-interpolated model. Throws as above.
template <Regression S>
doe::Criterion expected_improvement(const S& model, doe::Goal goal) {
  return detail::reinterpolated_improvement(model, detail::sign_of("kriging::expected_improvement", goal),
                                            false);
}

/// ln of the first; −∞ where nothing can be won.
template <class S>
doe::Criterion log_expected_improvement(S model, doe::Goal goal, double best) {
  detail::require_surrogate<S>();
  detail::check_finite("kriging::log_expected_improvement", "best", best);
  const double sign = detail::sign_of("kriging::log_expected_improvement", goal);
  return detail::improvement(std::move(model), {best, sign, true});
}

/// ln of the second.
template <Regression S>
doe::Criterion log_expected_improvement(const S& model, doe::Goal goal) {
  return detail::reinterpolated_improvement(model, detail::sign_of("kriging::log_expected_improvement", goal),
                                            true);
}

/// |leave-one-out error| of the run nearest to each point, distances in the model's scaled inputs, any two
/// levels of a category equally far; unit of y.
/// Take it with doe::BatchRule::cells. A constant model scores 0.
inline doe::Criterion cross_validation_error(const Model& model) {
  const detail::ModelState& s = model.state();
  if (s.X.rows() == 0)
    return [](const Eigen::MatrixXd& X) -> Eigen::VectorXd { return Eigen::VectorXd::Zero(X.rows()); };
  Eigen::VectorXd error = detail::left_out(s.L, s.gls, s.X).error;
  for (double& e : error) e = s.y_scale * std::abs(e);
  return [input = s.input, runs = s.X, levels = s.correlation.levels,
          error](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    const Eigen::MatrixXd scaled = input.apply(X);
    Eigen::VectorXd score(X.rows());
    for (Eigen::Index i = 0; i < score.size(); ++i)
      score[i] = error[detail::nearest_rows(runs, scaled.row(i).transpose(), levels).front()];
    return score;
  };
}

/// What the models expect of a run at x: doe::ProposeOptions::believe for BatchRule::believer. One model a
/// response.
template <class S>
std::function<doe::Outcome(const Eigen::VectorXd& x)> believer(std::vector<S> models) {
  detail::require_surrogate<S>();
  return [models = std::move(models)](const Eigen::VectorXd& x) -> doe::Outcome {
    Eigen::VectorXd y(static_cast<Eigen::Index>(models.size()));
    for (std::size_t j = 0; j < models.size(); ++j)
      y[static_cast<Eigen::Index>(j)] = models[j].mean(x.transpose())[0];
    return y;
  };
}

}  // namespace drawpoint::kriging
