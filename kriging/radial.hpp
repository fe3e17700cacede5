// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Radial basis functions with a polynomial tail: `Radial r = fit_radial(X, y);`
///
///   ŷ(x) = Σ wᵢ φ(|x − xᵢ|) + p(x)ᵀc,  (Φ + λI) w + P c = y,  Pᵀw = 0
/// in inputs scaled to [-1, 1], with r = |x − xᵢ| and the shape ε:
///   thin_plate    r² ln r         tail 1, x      multiquadric  −√(1 + (εr)²)   tail 1
///   cubic         r³              tail 1, x      gaussian      exp(−(εr)²)     tail 1
/// These signs make Qᵀ(Φ + λI)Q positive definite, Q a basis of {w : Pᵀw = 0}; with its eigenvectors, U = QV
/// and values Λ, B = U(Λ + λ)⁻¹Uᵀ, w = B y and the run i is missed by wᵢ/Bᵢᵢ without it (Rippa's formula,
/// with the tail refitted too). ε and λ minimise Σ (wᵢ/Bᵢᵢ)²: a grid of ε, each with a search of λ that costs
/// n² a value, then golden sections. Error bars are those of Kriging with the covariance s²φ (intrinsic
/// random functions), s² = mean wᵢ²/Bᵢᵢ, which makes the leave-one-out errors have unit variance on the mean.
/// Cost 10 n³ an ε; beyond 250 runs ε is found on 250 of them. Sources: Rippa 1999, Adv. Computational
/// Mathematics 11; Wahba 1990, "Spline Models for Observational Data".

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <drawpoint/kriging/detail/left_out.hpp>
#include <drawpoint/kriging/detail/matrix_product.hpp>
#include <drawpoint/kriging/detail/runs_of_surrogate.hpp>
#include <drawpoint/kriging/surrogate.hpp>
#include <drawpoint/kriging/validate.hpp>

namespace drawpoint::kriging {

enum class RadialFunction { thin_plate, cubic, multiquadric, gaussian };

inline std::string_view to_string(RadialFunction f) {
  switch (f) {
    case RadialFunction::thin_plate:
      return "thin_plate";
    case RadialFunction::cubic:
      return "cubic";
    case RadialFunction::multiquadric:
      return "multiquadric";
    case RadialFunction::gaussian:
      return "gaussian";
  }
  return "unknown";
}

struct RadialOptions {
  RadialFunction function = RadialFunction::cubic;
  std::optional<double> shape = {};  ///< ε > 0, of multiquadric and gaussian; empty: estimated, 0.05 to 20
  /// λ as a share of the largest eigenvalue, 0 or more, 0: interpolate; empty: estimated, up to 10.
  std::optional<double> ridge = {};
  /// The box that is scaled to [-1, 1], natural units, one entry per variable. Empty: the range of the data.
  Eigen::VectorXd lower = {}, upper = {};
};

namespace detail {

struct RadialState {
  InputScale input;
  double y_centre = 0, y_scale = 0;  ///< y = y_centre + y_scale · standardised
  RadialFunction function = RadialFunction::cubic;
  double shape = 0, ridge = 0;  ///< ε, λ
  Eigen::MatrixXd X;            ///< n x d, scaled; no rows: a constant of variance `constant_variance`
  Eigen::MatrixXd P, G;         ///< n x q tail at the runs, and P(PᵀP)⁻¹
  Eigen::MatrixXd U;            ///< n x (n − q)
  Eigen::VectorXd values;       ///< Λ + λ
  Eigen::VectorXd w, c;         ///< of the standardised response
  Eigen::MatrixXd H, M;         ///< (Φ + λI)G and Gᵀ(Φ + λI)G
  double process_variance = 0;  ///< s², standardised
  double constant_variance = 0;
  Eigen::VectorXd observed, diagonal;  ///< y in its unit; Bᵢᵢ
  Status status = Status::converged;
  std::string message;
};

inline bool has_shape(RadialFunction f) {
  return f == RadialFunction::multiquadric || f == RadialFunction::gaussian;
}

/// φ from the squared distance.
inline double radial(RadialFunction f, double shape, double squared) {
  switch (f) {
    case RadialFunction::thin_plate:
      return squared > 0 ? 0.5 * squared * std::log(squared) : 0.0;
    case RadialFunction::cubic:
      return squared * std::sqrt(squared);
    case RadialFunction::multiquadric:
      return -std::sqrt(1.0 + shape * shape * squared);
    case RadialFunction::gaussian:
      return std::exp(-shape * shape * squared);
  }
  return 0.0;
}

/// dφ/d(squared distance); 0 at a run for the thin plate, whose gradient vanishes there.
inline double radial_slope(RadialFunction f, double shape, double squared) {
  switch (f) {
    case RadialFunction::thin_plate:
      return squared > 0 ? 0.5 * (std::log(squared) + 1.0) : 0.0;
    case RadialFunction::cubic:
      return 1.5 * std::sqrt(squared);
    case RadialFunction::multiquadric:
      return -0.5 * shape * shape / std::sqrt(1.0 + shape * shape * squared);
    case RadialFunction::gaussian:
      return -shape * shape * std::exp(-shape * shape * squared);
  }
  return 0.0;
}

/// m x n: φ between the rows of Z and of X.
inline Eigen::MatrixXd radial_matrix(const RadialState& s, const Eigen::MatrixXd& Z,
                                     const Eigen::MatrixXd& X) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(Z.rows(), X.rows());
  for (Eigen::Index j = 0; j < K.cols(); ++j) {
    for (Eigen::Index k = 0; k < X.cols(); ++k)
      for (Eigen::Index i = 0; i < Z.rows(); ++i) K(i, j) += (Z(i, k) - X(j, k)) * (Z(i, k) - X(j, k));
    for (Eigen::Index i = 0; i < Z.rows(); ++i) K(i, j) = radial(s.function, s.shape, K(i, j));
  }
  return K;
}

/// 1, and the inputs that vary for the functions that need them.
inline Eigen::MatrixXd radial_tail(const RadialState& s, const Eigen::MatrixXd& Z) {
  std::vector<Index> inputs;
  for (Index k = 0; k < Z.cols(); ++k)
    if (!has_shape(s.function) && s.input.factor[k] != 0.0) inputs.push_back(k);
  Eigen::MatrixXd P = Eigen::MatrixXd::Ones(Z.rows(), 1 + static_cast<Index>(inputs.size()));
  for (Index j = 1; j < P.cols(); ++j)
    std::copy_n(column(Z, inputs[static_cast<std::size_t>(j - 1)]), Z.rows(), column(P, j));
  return P;
}

}  // namespace detail

class Radial {
 public:
  /// Made by fit_radial().
  explicit Radial(detail::RadialState state) : s_(std::move(state)), across_(s_.U.transpose()) {}

  /// X: m x d, natural units. Cost a point: n² for the variance. Throws std::invalid_argument for another
  /// number of columns and for numbers that are not finite.
  Prediction predict(const Eigen::MatrixXd& X, Target target = Target::latent) const {
    detail::check_points("kriging::Radial", X, variables());
    Prediction p{Eigen::VectorXd::Constant(X.rows(), s_.y_centre),
                 Eigen::VectorXd::Constant(X.rows(), s_.constant_variance)};
    if (s_.X.rows() == 0) return p;
    const Eigen::MatrixXd Z = s_.input.apply(X);
    Eigen::MatrixXd K = detail::radial_matrix(s_, Z, s_.X), P = detail::radial_tail(s_, Z);
    p.mean = means(K, P);
    const Eigen::MatrixXd KG = detail::product(K, s_.G), PM = detail::product(P, s_.M);
    detail::add_product(detail::block_of(P), detail::block_of(s_.H), -1.0, detail::block_of(K));
    Eigen::MatrixXd g = Eigen::MatrixXd::Zero(X.rows(), s_.U.cols());
    detail::add_product(detail::block_of(K), detail::block_of(across_), 1.0, detail::block_of(g));
    const double unit = s_.y_scale * s_.y_scale * s_.process_variance;
    const double noise = target == Target::observation ? noise_variance() : 0.0;
    for (Eigen::Index i = 0; i < X.rows(); ++i) {
      double left = detail::radial(s_.function, s_.shape, 0.0);
      for (Eigen::Index j = 0; j < P.cols(); ++j) left += P(i, j) * (PM(i, j) - 2.0 * KG(i, j));
      for (Eigen::Index j = 0; j < g.cols(); ++j) left -= g(i, j) * g(i, j) / s_.values[j];
      p.variance[i] = unit * std::max(left, 0.0) + noise;
    }
    return p;
  }

  /// Cost a point: n d. Throws as predict.
  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const {
    detail::check_points("kriging::Radial", X, variables());
    if (s_.X.rows() == 0) return Eigen::VectorXd::Constant(X.rows(), s_.y_centre);
    const Eigen::MatrixXd Z = s_.input.apply(X);
    return means(detail::radial_matrix(s_, Z, s_.X), detail::radial_tail(s_, Z));
  }

  double operator()(const Eigen::VectorXd& x) const { return mean(x.transpose())[0]; }
  static constexpr bool predicts = true;  ///< for doe::Predictor

  /// Derivatives of the mean at one point x of d entries. Cost n d. Throws as predict.
  Eigen::VectorXd mean_gradient(const Eigen::VectorXd& x) const {
    detail::check_points("kriging::Radial", x.transpose(), variables());
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size());
    if (s_.X.rows() == 0) return gradient;
    const Eigen::VectorXd z = s_.input.apply(x.transpose()).row(0);
    for (Eigen::Index i = 0; i < s_.X.rows(); ++i) {
      double squared = 0;
      for (Eigen::Index k = 0; k < z.size(); ++k) squared += (z[k] - s_.X(i, k)) * (z[k] - s_.X(i, k));
      const double slope = 2.0 * s_.w[i] * detail::radial_slope(s_.function, s_.shape, squared);
      for (Eigen::Index k = 0; k < z.size(); ++k) gradient[k] += slope * (z[k] - s_.X(i, k));
    }
    for (Eigen::Index k = 0, j = 1; k < z.size() && j < s_.c.size(); ++k)
      if (s_.input.factor[k] != 0.0) gradient[k] += s_.c[j++];
    for (Eigen::Index k = 0; k < z.size(); ++k) gradient[k] *= s_.y_scale * s_.input.factor[k];
    return gradient;
  }

  Eigen::Index variables() const { return s_.input.centre.size(); }
  Eigen::Index runs() const { return s_.observed.size(); }
  double shape() const { return s_.shape; }  ///< ε, on scaled inputs
  double ridge() const { return s_.ridge; }  ///< λ
  /// λ s², unit of y squared.
  double noise_variance() const { return s_.y_scale * s_.y_scale * s_.ridge * s_.process_variance; }
  Status status() const { return s_.status; }
  const std::string& message() const { return s_.message; }
  const detail::RadialState& state() const { return s_; }

 private:
  Eigen::VectorXd means(const Eigen::MatrixXd& K, const Eigen::MatrixXd& P) const {
    Eigen::VectorXd mean = detail::product(K, s_.w);
    detail::add_product(mean.data(), 1.0, P, s_.c.data());
    return detail::affine(mean, s_.y_scale, s_.y_centre);
  }

  detail::RadialState s_;
  Eigen::MatrixXd across_;  // Uᵀ
};

static_assert(SmoothSurrogate<Radial>);

namespace detail {

/// The block of B = U diag(inverse) Uᵀ that belongs to these runs, which is what leaving them out takes.
inline Eigen::MatrixXd block_of_B(const Eigen::MatrixXd& U, const Eigen::VectorXd& inverse,
                                  const std::vector<Eigen::Index>& runs) {
  const auto m = static_cast<Index>(runs.size());
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(m, m);
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < m; ++j)
      for (Index k = 0; k < U.cols(); ++k)
        B(i, j) +=
            U(runs[static_cast<std::size_t>(i)], k) * inverse[k] * U(runs[static_cast<std::size_t>(j)], k);
  return B;
}

}  // namespace detail

/// Closed form: ε and λ as found, weights and tail anew without each run and its repeats.
inline Validation leave_one_out(const Radial& model) {
  const detail::RadialState& s = model.state();
  Validation v;
  v.observed = s.observed;
  if (s.X.rows() == 0) {
    v.predicted = Eigen::VectorXd::Constant(model.runs(), s.y_centre);
    v.variance = v.observation_variance = Eigen::VectorXd::Constant(model.runs(), s.constant_variance);
    return detail::scored(std::move(v));
  }
  const double unit = s.y_scale * s.y_scale * s.process_variance;
  v.predicted = v.variance = v.observation_variance = s.observed;
  for (Eigen::Index i = 0; i < s.observed.size(); ++i) {
    v.predicted[i] = s.observed[i] - s.y_scale * s.w[i] / s.diagonal[i];
    v.observation_variance[i] = unit / s.diagonal[i];
  }
  const Eigen::VectorXd inverse = detail::entry_quotients(Eigen::VectorXd::Ones(s.values.size()), s.values);
  for (const std::vector<Eigen::Index>& site : detail::sites_of(s.X)) {
    if (site.size() < 2) continue;
    const detail::LeftOut out =
        detail::solve_site(detail::block_of_B(s.U, inverse, site), detail::entries_of(s.w, site));
    for (std::size_t k = 0; k < site.size(); ++k) {
      v.predicted[site[k]] = s.observed[site[k]] - s.y_scale * out.error[static_cast<Eigen::Index>(k)];
      v.observation_variance[site[k]] = unit * out.variance[static_cast<Eigen::Index>(k)];
    }
  }
  for (Eigen::Index i = 0; i < s.observed.size(); ++i)
    v.variance[i] = std::max(v.observation_variance[i] - model.noise_variance(), 0.0);
  return detail::scored(std::move(v));
}

}  // namespace drawpoint::kriging
