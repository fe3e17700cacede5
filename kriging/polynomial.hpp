// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Polynomial regression, the plainest surrogate: `Polynomial p = fit_polynomial(X, y);`
///
///   ŷ(x) = f(x)ᵀβ,  β from F = Q T (Q: n x q orthonormal),  s² = |y − Fβ|²/(n − q)
///   variance of the mean s² |T⁻ᵀf|², of one more run s² (1 + |T⁻ᵀf|²)
///   leave-one-out error eᵢ/(1 − hᵢ), h = diagonal of Q Qᵀ; its variance s²/(1 − hᵢ)
/// in inputs scaled to [-1, 1]. Terms that the runs cannot tell from earlier ones are left out. With
/// Selection::leave_one_out the term that lowers the leave-one-out error most is added while it lowers its
/// square by 1 % and the terms are at most half the runs; candidates are kept orthogonal to the chosen, so
/// that each costs n. The variance then does not know of the choice and is somewhat low. Where terms are as
/// many as runs or more, the degree is lowered. Cost n q². Source: Myers, Montgomery, Anderson-Cook 2009,
/// "Response Surface Methodology", chapter 2; Allen 1974, Technometrics 16 (leave-one-out).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/least_squares.hpp>
#include <drawpoint/kriging/detail/left_out.hpp>
#include <drawpoint/kriging/detail/monomials.hpp>
#include <drawpoint/kriging/detail/runs_of_surrogate.hpp>
#include <drawpoint/kriging/surrogate.hpp>
#include <drawpoint/kriging/validate.hpp>

namespace drawpoint::kriging {

enum class Selection { all, leave_one_out };

struct PolynomialOptions {
  int degree = 2;       ///< of a term, >= 0
  int interaction = 2;  ///< inputs in a term, >= 1; 1: no products
  Selection selection = Selection::all;
  /// The box that is scaled to [-1, 1], natural units, one entry per variable. Empty: the range of the data.
  Eigen::VectorXd lower = {}, upper = {};
};

namespace detail {

/// A site of several runs and its block of the hat matrix H = QQᵀ, m x m.
struct RepeatedSite {
  std::vector<Eigen::Index> runs;
  Eigen::MatrixXd hat;

  /// Adds v, orthogonal to the terms before it and of length 1.
  void add_term(const Eigen::VectorXd& v) {
    for (Index i = 0; i < hat.rows(); ++i)
      for (Index j = 0; j < hat.cols(); ++j)
        hat(i, j) += v[runs[static_cast<std::size_t>(i)]] * v[runs[static_cast<std::size_t>(j)]];
  }

  /// How the site is missed without it, (I − H)⁻¹r, and the diagonal of (I − H)⁻¹.
  LeftOut left_out(const Eigen::VectorXd& residual) const {
    Eigen::MatrixXd A = -hat;
    add_to_diagonal(A, 1.0);
    return solve_site(std::move(A), entries_of(residual, runs));
  }
};

/// Those of X, without a term.
inline std::vector<RepeatedSite> repeated_sites(const Eigen::MatrixXd& X) {
  std::vector<RepeatedSite> repeated;
  for (const std::vector<Eigen::Index>& site : sites_of(X)) {
    const auto m = static_cast<Index>(site.size());
    if (m > 1) repeated.push_back({site, Eigen::MatrixXd::Zero(m, m)});
  }
  return repeated;
}

struct PolynomialState {
  InputScale input;
  double y_centre = 0, y_scale = 0;  ///< y = y_centre + y_scale · standardised
  std::vector<Monomial> terms;
  Eigen::VectorXd beta;                ///< q, of the standardised response
  Eigen::MatrixXd T;                   ///< q x q, upper triangular; empty: a constant of `variance`
  double variance = 0;                 ///< s², unit of y squared
  Eigen::VectorXd observed, residual;  ///< n, unit of y
  Eigen::VectorXd leverage;            ///< h, n
  std::vector<RepeatedSite> repeated;  ///< with their blocks of the hat matrix
  Status status = Status::converged;
  std::string message;
};

}  // namespace detail

class Polynomial {
 public:
  /// Made by fit_polynomial().
  explicit Polynomial(detail::PolynomialState state) : s_(std::move(state)) {}

  /// X: m x d, natural units. Throws std::invalid_argument for another number of columns and for numbers that
  /// are not finite.
  Prediction predict(const Eigen::MatrixXd& X, Target target = Target::latent) const {
    const Eigen::MatrixXd F = terms_at(X);
    Prediction p{means(F), Eigen::VectorXd::Constant(X.rows(), s_.variance)};
    if (s_.T.size() > 0) {
      const Eigen::MatrixXd lower = s_.T.transpose();
      Eigen::MatrixXd v = F;
      detail::solve_right(detail::block_of(lower), detail::block_of(v));
      p.variance = detail::affine(detail::row_squares(v), s_.variance);
    }
    if (target == Target::observation) p.variance = detail::affine(p.variance, 1.0, s_.variance);
    return p;
  }

  /// Throws as predict.
  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const { return means(terms_at(X)); }

  double operator()(const Eigen::VectorXd& x) const { return mean(x.transpose())[0]; }
  static constexpr bool predicts = true;  ///< for doe::Predictor

  /// Derivatives of the mean at one point x of d entries. Throws as predict.
  Eigen::VectorXd mean_gradient(const Eigen::VectorXd& x) const {
    detail::check_points("kriging::Polynomial", x.transpose(), variables());
    const Eigen::VectorXd z = s_.input.apply(x.transpose()).row(0);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      for (std::size_t j = 0; j < s_.terms.size(); ++j)
        gradient[k] += s_.beta[static_cast<Eigen::Index>(j)] * detail::monomial_slope(s_.terms[j], z, k);
      gradient[k] *= s_.y_scale * s_.input.factor[k];
    }
    return gradient;
  }

  Eigen::Index variables() const { return s_.input.centre.size(); }
  Eigen::Index runs() const { return s_.observed.size(); }
  const std::vector<Monomial>& terms() const { return s_.terms; }
  /// One entry a term, in scaled inputs; unit of y. The constant lacks the mean of the runs.
  Eigen::VectorXd coefficients() const { return detail::affine(s_.beta, s_.y_scale); }
  double noise_variance() const { return s_.variance; }  ///< s², unit of y squared
  Status status() const { return s_.status; }
  const std::string& message() const { return s_.message; }
  const detail::PolynomialState& state() const { return s_; }

 private:
  Eigen::MatrixXd terms_at(const Eigen::MatrixXd& X) const {
    detail::check_points("kriging::Polynomial", X, variables());
    return detail::monomial_matrix(s_.terms, s_.input.apply(X));
  }

  Eigen::VectorXd means(const Eigen::MatrixXd& F) const {
    return detail::affine(detail::product(F, s_.beta), s_.y_scale, s_.y_centre);
  }

  detail::PolynomialState s_;
};

static_assert(SmoothSurrogate<Polynomial>);

/// Closed form: the terms as chosen, β estimated anew without each run and its repeats.
inline Validation leave_one_out(const Polynomial& model) {
  const detail::PolynomialState& s = model.state();
  Validation v;
  v.observed = v.predicted = v.variance = v.observation_variance = s.observed;
  for (Eigen::Index i = 0; i < s.observed.size(); ++i) {
    const double left = 1.0 - s.leverage[i];
    v.predicted[i] = s.observed[i] - s.residual[i] / left;
    v.observation_variance[i] = s.variance / left;
    v.variance[i] = v.observation_variance[i] - s.variance;
  }
  for (const detail::RepeatedSite& site : s.repeated) {
    const detail::LeftOut out = site.left_out(s.residual);
    for (std::size_t k = 0; k < site.runs.size(); ++k) {
      const Eigen::Index i = site.runs[k];
      v.predicted[i] = s.observed[i] - out.error[static_cast<Eigen::Index>(k)];
      v.observation_variance[i] = s.variance * out.variance[static_cast<Eigen::Index>(k)];
      v.variance[i] = v.observation_variance[i] - s.variance;
    }
  }
  if (s.T.size() == 0)
    v.variance = v.observation_variance = Eigen::VectorXd::Constant(model.runs(), s.variance);
  return detail::scored(std::move(v));
}

namespace detail {

// A run of leverage 1 decides a coefficient alone: without it there is no prediction.
inline constexpr double largest_leverage = 1.0 - 1e-10;

/// Σ (eᵢ/(1 − hᵢ))², sites of several runs as a whole; +∞ where a site decides alone.
inline double press(const Eigen::VectorXd& residual, const Eigen::VectorXd& leverage,
                    const std::vector<RepeatedSite>& repeated) {
  if (largest_entry(leverage) > largest_leverage) return std::numeric_limits<double>::infinity();
  Eigen::VectorXd error = entry_quotients(residual, affine(leverage, -1.0, 1.0));
  for (const RepeatedSite& site : repeated) {
    const LeftOut out = site.left_out(residual);
    for (std::size_t k = 0; k < site.runs.size(); ++k)
      error[site.runs[k]] = out.error[static_cast<Eigen::Index>(k)];
  }
  const double sum = square(error);
  return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
}

/// Adds v, orthogonal to the terms before it and of length 1, to a regression of y.
inline void add_term(const Eigen::VectorXd& v, Eigen::VectorXd& residual, Eigen::VectorXd& leverage,
                     std::vector<RepeatedSite>& repeated) {
  add_scaled(residual.data(), -dot(v, residual), v.data(), v.size());
  for (RepeatedSite& site : repeated) site.add_term(v);
  for (Index i = 0; i < v.size(); ++i) leverage[i] += v[i] * v[i];
}

/// v of column j of F, scaled by 1/size.
inline Eigen::VectorXd scaled_column(const Eigen::MatrixXd& F, Index j, double size) {
  return affine(F.col(j), 1.0 / size);
}

/// Which columns of F lower the leave-one-out error of y, in the order of their choice; column 0 first.
inline std::vector<Eigen::Index> forward_selection(Eigen::MatrixXd F, Eigen::VectorXd y,
                                                   std::vector<RepeatedSite> repeated) {
  constexpr double worth = 0.99, independent = 1e-8;
  const auto norm = [&](Index j) { return std::sqrt(dot(column(F, j), column(F, j), F.rows())); };
  std::vector<double> size;
  for (Index j = 0; j < F.cols(); ++j) size.push_back(norm(j));
  Eigen::VectorXd leverage = Eigen::VectorXd::Zero(F.rows());
  std::vector<Eigen::Index> chosen;
  Eigen::Index best = 0;
  for (double error = std::numeric_limits<double>::infinity();;) {
    chosen.push_back(best);
    const Eigen::VectorXd q = scaled_column(F, best, norm(best));
    add_term(q, y, leverage, repeated);
    for (int pass = 0; pass < 2; ++pass) add_outer(F, -1.0, q, transposed_product(F, q));
    error = chosen.size() == 1 ? press(y, leverage, repeated) : error;
    if (2 * (chosen.size() + 1) > static_cast<std::size_t>(F.rows())) return chosen;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < F.cols(); ++j) {
      if (!(norm(j) > independent * size[j])) continue;
      Eigen::VectorXd residual = y, higher = leverage;
      std::vector<RepeatedSite> sites = repeated;
      add_term(scaled_column(F, j, norm(j)), residual, higher, sites);
      const double with = press(residual, higher, sites);
      if (with < least) least = with, best = j;
    }
    if (!(least < worth * error)) return chosen;
    error = least;
  }
}

/// The highest degree up to the one asked for with fewer terms than runs.
inline int affordable_degree(Eigen::Index runs, Eigen::Index d, const PolynomialOptions& options) {
  int degree = 0;
  while (degree < options.degree &&
         static_cast<Eigen::Index>(monomials(d, degree + 1, options.interaction).size()) < runs)
    ++degree;
  return degree;
}

inline Polynomial constant_polynomial(const TrainingData& data) {
  PolynomialState s;
  const Eigen::Index n = data.observed.size();
  s.input = data.input;
  s.y_centre = data.y_centre;
  s.terms = monomials(data.X.cols(), 0, 1);
  s.beta = Eigen::VectorXd::Zero(1);
  s.observed = data.observed;
  s.residual = s.leverage = Eigen::VectorXd::Zero(n);
  s.variance = n == 1 ? std::numeric_limits<double>::infinity() : 0.0;
  s.status = n == 1 ? Status::too_few_runs : Status::constant_response;
  s.message = n == 1 ? "one run: the model is that constant with infinite variance"
                     : "all responses equal " + text(data.y_centre) + ": the model is that constant";
  return Polynomial(std::move(s));
}

/// β, s² and what leave-one-out needs, for independent columns F.
inline void regress(PolynomialState& s, const Eigen::MatrixXd& F, const Eigen::VectorXd& y) {
  Eigen::MatrixXd Q = F;
  s.T.setZero(F.cols(), F.cols());
  orthonormalize(Q, s.T);
  s.beta = solve_upper(s.T, transposed_product(Q, y));
  s.residual = affine(difference(y, product(F, s.beta)), s.y_scale);
  s.leverage = row_squares(Q);
  for (RepeatedSite& site : s.repeated)
    for (Index j = 0; j < Q.cols(); ++j) site.add_term(Q.col(j));
  for (double& h : s.leverage) h = std::min(h, largest_leverage);
  s.variance = square(s.residual) / static_cast<double>(F.rows() - F.cols());
}

}  // namespace detail

/// X: n x d, one run per row, natural units; y: n, any unit. Throws std::invalid_argument for no run, unequal
/// lengths, numbers that are not finite, and options out of their range. Deterministic.
inline Polynomial fit_polynomial(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                                 const PolynomialOptions& options = {}) {
  const std::string place = "kriging::fit_polynomial";
  if (options.degree < 0 || options.degree > 20)
    throw std::invalid_argument(place + ": degree is " + std::to_string(options.degree) +
                                "; allowed is 0 to 20; use 2");
  if (options.interaction < 1)
    throw std::invalid_argument(place + ": interaction is " + std::to_string(options.interaction) +
                                "; allowed is 1 or more; use 1 for no products");
  FitOptions box;
  box.lower = options.lower;
  box.upper = options.upper;
  const detail::TrainingData data = detail::runs_of_surrogate(place, X, y, box);
  if (data.y.size() == 0) return detail::constant_polynomial(data);
  detail::PolynomialState s;
  s.input = data.input;
  s.y_centre = data.y_centre;
  s.y_scale = data.y_scale;
  s.observed = data.observed;
  const int degree = options.selection == Selection::all
                         ? detail::affordable_degree(X.rows(), X.cols(), options)
                         : options.degree;
  const std::vector<Monomial> asked = detail::monomials(X.cols(), degree, options.interaction);
  const Eigen::MatrixXd F = detail::monomial_matrix(asked, data.X);
  const std::vector<Eigen::Index> kept =
      options.selection == Selection::all
          ? detail::independent_columns(F)
          : detail::forward_selection(F, data.y, detail::repeated_sites(data.X));
  s.repeated = detail::repeated_sites(data.X);
  for (const Eigen::Index j : kept) s.terms.push_back(asked[static_cast<std::size_t>(j)]);
  detail::regress(s, detail::columns_of(F, kept), data.y);
  s.message = std::to_string(kept.size()) + " of " + std::to_string(asked.size()) + " terms";
  if (degree < options.degree) {
    s.status = Status::too_few_runs;
    s.message += "; degree " + std::to_string(options.degree) +
                 " has as many terms as there are runs or more: it is " + std::to_string(degree) + " instead";
  } else if (options.selection == Selection::all && kept.size() < asked.size()) {
    s.status = Status::ill_conditioned;
    s.message += ", the others of which the runs cannot tell from these";
  }
  return Polynomial(std::move(s));
}

}  // namespace drawpoint::kriging
