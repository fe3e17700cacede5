// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What all surrogates have in common, so that validation, comparison and searches take any of them.
///
/// A surrogate predicts means and variances of the latent function or of one more run (model.hpp says which
/// is which) at the rows of X: m x d, natural units. A fitter makes one from runs.

#include <Eigen/Core>
#include <concepts>
#include <drawpoint/kriging/model.hpp>
#include <type_traits>
#include <vector>

namespace drawpoint::kriging {

template <class S>
concept Surrogate = requires(const S& s, const Eigen::MatrixXd& X) {
  { s.predict(X) } -> std::convertible_to<Prediction>;
  { s.predict(X, Target::observation) } -> std::convertible_to<Prediction>;
  { s.mean(X) } -> std::convertible_to<Eigen::VectorXd>;
};

/// Surrogates whose mean has derivatives: mean_gradient(x) at one point x of d entries.
template <class S>
concept SmoothSurrogate = Surrogate<S> && requires(const S& s, const Eigen::VectorXd& x) {
  { s.mean_gradient(x) } -> std::convertible_to<Eigen::VectorXd>;
};

template <class F>
concept Fitter = requires(const F& f, const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  { f(X, y) } -> Surrogate;
};

/// Takes the numbers of the rows, too, for what else belongs to a run: its noise.
template <class F>
concept FitterOfRows = requires(const F& f, const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                                const std::vector<Eigen::Index>& rows) {
  { f(X, y, rows) } -> Surrogate;
};

static_assert(SmoothSurrogate<Model>);

namespace detail {

template <class S>
constexpr void require_surrogate() {
  static_assert(
      Surrogate<S>,
      "drawpoint: not a surrogate. Expected predict(X), predict(X, Target) giving a Prediction and mean(X) "
      "giving an Eigen::VectorXd, X an Eigen::MatrixXd with one point per row");
}

template <class F>
constexpr void require_fitter() {
  static_assert(
      Fitter<F> || FitterOfRows<F>,
      "drawpoint: not a fitter. Expected f(X, y) giving a surrogate, X an Eigen::MatrixXd with one run a "
      "row, y an Eigen::VectorXd; or f(X, y, rows), rows the std::vector<Eigen::Index> of their numbers");
}

template <class F>
auto fitted(const F& fitter, const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
            const std::vector<Eigen::Index>& rows) {
  if constexpr (FitterOfRows<F>)
    return fitter(X, y, rows);
  else
    return fitter(X, y);
}

}  // namespace detail

}  // namespace drawpoint::kriging
