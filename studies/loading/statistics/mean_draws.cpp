// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/statistics/mean_draws.h>
#include <drawpoint/studies/loading/statistics/polynomial_terms.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace drawpoint::studies {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int discarded = 100;  // draws before the first that counts
constexpr int apart = 1;        // iterations per draw

/// Terms at the runs, weighted by their noise, and what the likelihood takes of them.
struct TermsOfRuns {
  Eigen::MatrixXi degrees;
  MatrixXd G;         // ΦᵀΦ
  VectorXd h;         // Φᵀy
  double squares, n;  // yᵀy

  TermsOfRuns(const doe::Problem& problem, const NoisyRuns& runs, const VectorXd& y)
      : degrees(term_degrees(runs.X.cols())), n(static_cast<double>(y.size())) {
    const VectorXd weights = runs.noise.weights.size() ? runs.noise.weights : VectorXd::Ones(y.size());
    const VectorXd root = weights.cwiseSqrt().cwiseInverse();
    const MatrixXd Phi = root.asDiagonal() * term_values(problem, degrees, runs.X);
    const VectorXd scaled = root.cwiseProduct(y);
    G = Phi.transpose() * Phi;
    h = Phi.transpose() * scaled;
    squares = scaled.squaredNorm();
  }
};

/// The probability density of the parameters p = (ln b of each variable, logit δ, ln ι, ln τ²).
class Posterior {
 public:
  Posterior(TermsOfRuns terms, double variance, double degrees)
      : terms_(std::move(terms)), variance_(variance), degrees_(degrees) {}

  Index variables() const { return terms_.degrees.cols(); }
  Index parameters() const { return variables() + 3; }

  VectorXd start() const {
    VectorXd p = VectorXd::Zero(parameters());
    p.head(variables()).setConstant(std::log(0.3));
    p[parameters() - 1] = std::log(degrees_ > 0 ? std::clamp(variance_, 1e-4, 1.0) : 0.1);
    return p;
  }

  /// Its logarithm, but for a constant.
  double operator()(const VectorXd& p) {
    if (p.cwiseAbs().maxCoeff() > 15) return -std::numeric_limits<double>::infinity();
    factor(p);
    const double tau2 = std::exp(p[parameters() - 1]);
    const VectorXd u = deviations_.cwiseProduct(terms_.h);
    const double explained = lower().solve(u).squaredNorm() / tau2;
    const double determinant =
        terms_.n * std::log(tau2) + 2 * llt_.matrixLLT().diagonal().array().log().sum();
    return -0.5 * (determinant + (terms_.squares - explained) / tau2) + prior(p);
  }

  /// A draw of the coefficients c, given the parameters p and the runs.
  VectorXd coefficients(const VectorXd& p, doe::RandomStream& random) {
    factor(p);
    const double tau2 = std::exp(p[parameters() - 1]);
    VectorXd z(deviations_.size());
    for (double& entry : z) entry = random.normal();
    const VectorXd c = llt_.solve(deviations_.cwiseProduct(terms_.h)) / tau2 + llt_.matrixU().solve(z);
    return deviations_.cwiseProduct(c);
  }

 private:
  Eigen::TriangularView<const MatrixXd, Eigen::Lower> lower() const {
    return llt_.matrixLLT().triangularView<Eigen::Lower>();
  }

  /// Deviations √D of the coefficients, and the factor of I + √D G √D/τ².
  void factor(const VectorXd& p) {
    const double tau2 = std::exp(p[parameters() - 1]);
    deviations_ = deviations(p);
    MatrixXd A = deviations_.asDiagonal() * terms_.G * deviations_.asDiagonal();
    A /= tau2;
    A.diagonal().array() += 1;
    llt_.compute(A);
  }

  VectorXd deviations(const VectorXd& p) const {
    const Index d = variables();
    const double decline = -0.5 * std::log1p(std::exp(-p[d])), together = 0.5 * p[d + 1];
    VectorXd logarithm = VectorXd::Zero(terms_.degrees.rows());
    logarithm[0] = std::log(10.0);
    for (Index t = 1; t < logarithm.size(); ++t) {
      Index others = -1;
      for (Index v = 0; v < d; ++v)
        if (const int degree = terms_.degrees(t, v); degree > 0) {
          logarithm[t] += p[v] + (degree - 1) * decline;
          ++others;
        }
      logarithm[t] += static_cast<double>(others) * together;
    }
    return logarithm.array().exp();
  }

  double prior(const VectorXd& p) const {
    const Index d = variables();
    double value = -p[d] - 2 * std::log1p(std::exp(-p[d])) - 0.5 * std::pow(p[d + 1] / 1.5, 2);
    for (Index v = 0; v < d; ++v) value += p[v] - std::log1p(4 * std::exp(2 * p[v]));
    const double noise = p[d + 2];
    return value + (degrees_ > 0 ? -0.5 * degrees_ * (noise + variance_ * std::exp(-noise)) : 0.5 * noise);
  }

  TermsOfRuns terms_;
  double variance_, degrees_;
  VectorXd deviations_;
  Eigen::LLT<MatrixXd> llt_;
};

/// One entry of p drawn anew by its density given the others.
void draw_entry(Posterior& density, VectorXd& p, Index k, double& now, doe::RandomStream& random) {
  constexpr double width = 2;
  const double level = now + std::log1p(-random.uniform()), at = p[k];
  const auto density_at = [&](double value) {
    p[k] = value;
    return density(p);
  };
  double lower = at - width * random.uniform(), upper = lower + width;
  while (density_at(lower) > level) lower -= width;
  while (density_at(upper) > level) upper += width;
  for (;;) {
    const double value = lower + (upper - lower) * random.uniform();
    now = density_at(value);
    if (now > level) return;
    (value < at ? lower : upper) = value;
  }
}

MatrixXd draw_coefficients(Posterior& density, int count, doe::RandomStream random) {
  VectorXd p = density.start();
  MatrixXd C;
  double now = density(p);
  for (int k = -discarded * apart; k < count * apart; ++k) {
    for (Index entry = 0; entry < p.size(); ++entry) draw_entry(density, p, entry, now, random);
    if (k < 0 || k % apart != 0) continue;
    const VectorXd c = density.coefficients(p, random);
    if (C.size() == 0) C.resize(c.size(), count);
    C.col(k / apart) = c;
  }
  return C;
}

}  // namespace

MatrixXd draw_means(const doe::Problem& problem, const NoisyRuns& runs, const MatrixXd& points, int count,
                    doe::Seed seed) {
  const double centre = runs.y.mean();
  const double scale = std::sqrt((runs.y.array() - centre).square().mean());
  if (!(scale > 0)) return MatrixXd::Constant(points.rows(), count, centre);
  const TermsOfRuns terms(problem, runs, (runs.y.array() - centre) / scale);
  const MatrixXd at_points = term_values(problem, terms.degrees, points);
  Posterior density(terms, runs.noise.variance / (scale * scale), runs.noise.degrees);
  const MatrixXd C = draw_coefficients(density, count, doe::RandomStream(seed));
  return ((scale * (at_points * C)).array() + centre).matrix();
}

}  // namespace drawpoint::studies
