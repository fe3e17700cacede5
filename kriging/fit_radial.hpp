// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Fits radial basis functions (radial.hpp) to runs, with shape and ridge by closed-form leave-one-out.

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <drawpoint/kriging/detail/least_squares.hpp>
#include <drawpoint/kriging/radial.hpp>

namespace drawpoint::kriging {

namespace detail {

/// The best of `steps` + 1 even places of [low, high] and then of 30 golden sections about it.
template <class F>
double line_search(const F& f, double low, double high, int steps) {
  double best = low, least = std::numeric_limits<double>::infinity();
  const double step = (high - low) / steps;
  for (int k = 0; k <= steps; ++k) {
    const double value = f(low + k * step);
    if (value < least) least = value, best = low + k * step;
  }
  double a = std::max(low, best - step), b = std::min(high, best + step);
  constexpr double golden = 0.6180339887498949;
  for (int k = 0; k < 30 && b - a > 1e-3; ++k) {
    const double left = b - golden * (b - a), right = a + golden * (b - a);
    const double at_left = f(left), at_right = f(right);
    if (at_left < least) least = at_left, best = left;
    if (at_right < least) least = at_right, best = right;
    (at_left < at_right ? b : a) = at_left < at_right ? right : left;
  }
  return best;
}

/// Λ and U of one ε; the leave-one-out error is then cheap for any λ.
struct RadialSpectrum {
  Eigen::MatrixXd U, squares;                            ///< n x (n − q), and its squares
  Eigen::VectorXd values, z;                             ///< Λ clipped to 0, Uᵀy
  std::vector<std::vector<Eigen::Index>> repeated = {};  ///< sites of several runs

  double largest() const { return largest_entry(values); }

  /// λ is never below n times the round-off of the eigenvalues.
  double floor() const {
    return 4.0 * static_cast<double>(U.rows()) * std::numeric_limits<double>::epsilon() * largest();
  }

  double error(double ridge) const {
    Eigen::VectorXd inverse = values;
    for (double& value : inverse) value = 1.0 / (value + ridge);
    const Eigen::VectorXd w = product(U, entry_products(z, inverse));
    Eigen::VectorXd left_out = entry_quotients(w, product(squares, inverse));
    for (const std::vector<Eigen::Index>& site : repeated) {
      const LeftOut out = solve_site(block_of_B(U, inverse, site), entries_of(w, site));
      for (std::size_t k = 0; k < site.size(); ++k)
        left_out[site[k]] = out.error[static_cast<Eigen::Index>(k)];
    }
    const double sum = square(left_out);
    return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
  }
};

/// Householder's reflections I − 2vvᵀ that make P triangular, one v a column.
inline Eigen::MatrixXd reflections(Eigen::MatrixXd P) {
  const Index n = P.rows();
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(n, P.cols());
  for (Index k = 0; k < P.cols(); ++k) {
    double* v = column(V, k);
    std::copy_n(column(P, k) + k, n - k, v + k);
    v[k] += std::copysign(std::sqrt(dot(v, v, n)), v[k]);
    const double size = std::sqrt(dot(v, v, n));
    for (Index i = k; i < n; ++i) v[i] /= size;
    for (Index j = k; j < P.cols(); ++j) add_scaled(column(P, j), -2.0 * dot(v, column(P, j), n), v, n);
  }
  return V;
}

/// X = Qᵀ X, or Q X, with Q the product of the reflections.
inline void reflect(const Eigen::MatrixXd& V, bool transposed, Eigen::MatrixXd& X) {
  for (Index j = 0; j < X.cols(); ++j)
    for (Index i = 0; i < V.cols(); ++i) {
      const double* v = column(V, transposed ? i : V.cols() - 1 - i);
      add_scaled(column(X, j), -2.0 * dot(v, column(X, j), X.rows()), v, X.rows());
    }
}

inline RadialSpectrum radial_spectrum(const RadialState& s, const Eigen::MatrixXd& X,
                                      const Eigen::VectorXd& y) {
  const Eigen::MatrixXd V = reflections(radial_tail(s, X));
  const Index n = X.rows(), q = V.cols();
  Eigen::MatrixXd K = radial_matrix(s, X, X);
  reflect(V, true, K);
  K.transposeInPlace();
  reflect(V, true, K);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K.bottomRightCorner(n - q, n - q));
  RadialSpectrum r{Eigen::MatrixXd::Zero(n, n - q), {}, eigen.eigenvalues(), {}};
  r.U.bottomRows(n - q) = eigen.eigenvectors();
  reflect(V, false, r.U);
  r.squares = r.U;
  std::for_each(r.squares.data(), r.squares.data() + r.squares.size(), [](double& u) { u *= u; });
  for (double& value : r.values) value = std::max(value, 0.0);
  r.z = transposed_product(r.U, y);
  for (std::vector<Eigen::Index>& site : sites_of(X))
    if (site.size() > 1) r.repeated.push_back(std::move(site));
  return r;
}

inline double best_ridge(const RadialSpectrum& spectrum, std::optional<double> ridge) {
  if (ridge) return std::max(*ridge * spectrum.largest(), spectrum.floor());
  const auto error = [&](double logarithm) { return spectrum.error(std::exp(logarithm)); };
  return std::exp(line_search(error, std::log(spectrum.floor()), std::log(10.0 * spectrum.largest()), 24));
}

/// ε of the least leave-one-out error, on 250 of the runs when there are more.
inline double best_shape(RadialState s, const TrainingData& data, std::optional<double> ridge) {
  constexpr Eigen::Index most = 250;
  const Eigen::Index n = data.X.rows(), count = std::min(n, most);
  std::vector<Eigen::Index> runs;
  for (Eigen::Index i = 0; i < count; ++i) runs.push_back(i * n / count);
  const Eigen::MatrixXd X = rows_of(data.X, runs);
  const Eigen::VectorXd y = entries_of(data.y, runs);
  const auto error = [&](double logarithm) {
    s.shape = std::exp(logarithm);
    const RadialSpectrum spectrum = radial_spectrum(s, X, y);
    return spectrum.error(best_ridge(spectrum, ridge));
  };
  return std::exp(line_search(error, std::log(0.05), std::log(20.0), 12));
}

/// Weights, tail and what predictions need.
inline void solve_radial(RadialState& s, const TrainingData& data, std::optional<double> ridge) {
  const RadialSpectrum spectrum = radial_spectrum(s, data.X, data.y);
  s.ridge = best_ridge(spectrum, ridge);
  s.X = data.X;
  s.P = radial_tail(s, s.X);
  s.U = spectrum.U;
  s.values = affine(spectrum.values, 1.0, s.ridge);
  s.w = product(s.U, entry_quotients(spectrum.z, s.values));
  s.diagonal = product(spectrum.squares, entry_quotients(Eigen::VectorXd::Ones(s.values.size()), s.values));
  const Index q = s.P.cols();
  Eigen::MatrixXd Q = s.P, T = Eigen::MatrixXd::Zero(q, q), K = radial_matrix(s, s.X, s.X);
  orthonormalize(Q, T);
  add_to_diagonal(K, s.ridge);
  s.c = solve_upper(T, transposed_product(Q, difference(data.y, product(K, s.w))));
  Eigen::MatrixXd inverse = scaled_identity(q, 1.0);  // T⁻ᵀ
  solve_lower(T.transpose(), inverse);
  s.G = product(Q, inverse);
  s.H = product(K, s.G);
  s.M = transposed_product(s.G, s.H);
  s.process_variance = mean_of(entry_quotients(entry_products(s.w, s.w), s.diagonal));
  s.message = std::string(to_string(s.function)) + ", shape " + text(s.shape) + ", ridge " + text(s.ridge);
  if (ridge == 0 && smallest_entry(spectrum.values) < spectrum.floor()) {
    s.status = Status::ill_conditioned;
    s.message +=
        "; the matrix was singular to round-off, so the ridge is not 0: estimate it, or remove runs that "
        "nearly repeat others";
  }
}

inline void check_radial(const RadialOptions& options) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("kriging::fit_radial: " + what);
  };
  if (options.shape && !(std::isfinite(*options.shape) && *options.shape > 0))
    reject("shape is " + text(*options.shape) +
           "; allowed are finite numbers above 0; leave it out to estimate it");
  if (!has_shape(options.function) && options.shape)
    reject("shape is " + text(*options.shape) + " but " + std::string(to_string(options.function)) +
           " has none; leave it out");
  if (options.ridge && !(std::isfinite(*options.ridge) && *options.ridge >= 0))
    reject("ridge is " + text(*options.ridge) +
           "; allowed are finite numbers from 0 on; leave it out to estimate it");
}

inline Radial constant_radial(RadialState s, Eigen::Index n) {
  s.y_scale = 0;
  s.X.resize(0, s.input.centre.size());
  s.constant_variance = n == 1 ? std::numeric_limits<double>::infinity() : 0.0;
  s.status = n == 1 ? Status::too_few_runs : Status::constant_response;
  s.message = n == 1 ? "one run: the model is that constant with infinite variance"
                     : "all responses equal " + text(s.y_centre) + ": the model is that constant";
  return Radial(std::move(s));
}

}  // namespace detail

/// X: n x d, one run per row, natural units; y: n, any unit. With fewer than two runs more than the tail has
/// terms, or runs that lie in a plane where the tail needs more, the function is a multiquadric, whose tail
/// is 1, and the status too_few_runs or ill_conditioned. Throws std::invalid_argument for no run, unequal
/// lengths, numbers that are not finite, and options out of their range. Deterministic.
inline Radial fit_radial(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                         const RadialOptions& options = {}) {
  detail::check_radial(options);
  FitOptions box;
  box.lower = options.lower;
  box.upper = options.upper;
  const detail::TrainingData data = detail::runs_of_surrogate("kriging::fit_radial", X, y, box);
  detail::RadialState s;
  s.input = data.input;
  s.y_centre = data.y_centre;
  s.y_scale = data.y_scale;
  s.observed = data.observed;
  s.function = options.function;
  if (data.y.size() == 0) return detail::constant_radial(std::move(s), y.size());
  const Eigen::MatrixXd P = detail::radial_tail(s, data.X);
  const bool few = P.cols() + 2 > P.rows();
  const bool flat = !few && static_cast<Eigen::Index>(detail::independent_columns(P).size()) < P.cols();
  if (few || flat) s.function = RadialFunction::multiquadric;
  if (detail::has_shape(s.function))
    s.shape = options.shape ? *options.shape : detail::best_shape(s, data, options.ridge);
  detail::solve_radial(s, data, options.ridge);
  if (few || flat) {
    s.status = few ? Status::too_few_runs : Status::ill_conditioned;
    s.message += std::string("; the runs ") +
                 (few ? "are too few for" : "lie in a plane, which leaves open") + " the linear tail of " +
                 std::string(to_string(options.function)) + ": this function has none";
  }
  return Radial(std::move(s));
}

}  // namespace drawpoint::kriging
