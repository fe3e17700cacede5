// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A dense reference of isotropic and additive correlations, written from their equations: runs of two
/// numbers on [-1, 1] and a category of four levels.
///
/// p is (ln θ, exponents, v, ln λ): isotropic two θ, of the numbers and of the category; additive three, and
/// three v.

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/categories.hpp>
#include <drawpoint/tests/kriging/correlations.hpp>

namespace drawpoint::kriging::structures {

inline constexpr Structure others[] = {Structure::isotropic, Structure::additive};

struct Reference {
  Structure structure;
  Correlation family;
  Eigen::MatrixXd X;
  Eigen::VectorXd y;

  int thetas() const { return structure == Structure::isotropic ? 2 : 3; }
  bool exponents() const { return family == Correlation::power_exponential; }

  double correlation(const Eigen::VectorXd& p, const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    double product = 1, sum = 0, weights = 0;
    for (int k = 0; k < 3; ++k) {
      const int place = structure == Structure::isotropic && k < 2 ? 0 : k - (3 - thetas());
      const double distance = k == 2 ? (a[k] == b[k] ? 0.0 : 2.0) : std::abs(a[k] - b[k]);
      const double c = reference::one_correlation(family, std::exp(p[place]),
                                                  exponents() ? p[thetas() + place] : 2.0, distance);
      product *= c;
      if (structure != Structure::additive) continue;
      const double weight = std::exp(p[3 + (exponents() ? 3 : 0) + k]);
      sum += weight * c;
      weights += weight;
    }
    return structure == Structure::additive ? sum / weights : product;
  }

  Eigen::MatrixXd matrix(const Eigen::VectorXd& p) const {
    Eigen::MatrixXd R(X.rows(), X.rows());
    for (Eigen::Index i = 0; i < R.rows(); ++i)
      for (Eigen::Index j = 0; j < R.cols(); ++j)
        R(i, j) = correlation(p, X.row(i), X.row(j)) + (i == j ? std::exp(p[p.size() - 1]) : 0.0);
    return R;
  }

  double log_likelihood(const Eigen::VectorXd& p) const {
    const Eigen::MatrixXd R = matrix(p), inverse = R.inverse();
    const double n = static_cast<double>(X.rows()), beta = inverse.colwise().sum().dot(y) / inverse.sum();
    const Eigen::VectorXd r = y.array() - beta;
    return -0.5 * n * std::log(2 * 3.14159265358979323846 * r.dot(inverse * r) / n) -
           0.5 * std::log(R.determinant()) - 0.5 * n;
  }

  /// With Σv = 0, where what holds the weights in place is 0.
  Eigen::VectorXd somewhere() const {
    Eigen::VectorXd p(thetas() * (exponents() ? 2 : 1) + (structure == Structure::additive ? 3 : 0) + 1);
    p.head(thetas()) = Eigen::Vector3d(0.3, -0.4, -1.6).tail(thetas());
    if (exponents()) p.segment(thetas(), thetas()) = Eigen::Vector3d(1.7, 1.9, 1.4).tail(thetas());
    if (structure == Structure::additive) p.segment(p.size() - 4, 3) << 0.5, -0.7, 0.2;
    p[p.size() - 1] = std::log(0.05);
    return p;
  }

  /// The parameters of a model, Σv = 0.
  Eigen::VectorXd parameters(const Model& model) const {
    Eigen::VectorXd p = somewhere();
    p.head(thetas()) = model.theta().tail(thetas()).array().log();
    if (exponents()) p.segment(thetas(), thetas()) = model.correlation().exponent.tail(thetas());
    if (structure == Structure::additive) {
      const Eigen::Vector3d v = model.correlation().weight.array().log();
      p.segment(p.size() - 4, 3) = v.array() - v.mean();
    }
    p[p.size() - 1] = std::log(model.nugget());
    return p;
  }
};

inline Reference some_runs(Structure structure, Correlation family, Eigen::Index n = 16) {
  Reference r{structure, family, Eigen::MatrixXd(n, 3), Eigen::VectorXd(n)};
  doe::RandomStream random(3);
  for (Eigen::Index i = 0; i < n; ++i) {
    r.X.row(i) << 2 * random.uniform() - 1, 2 * random.uniform() - 1, static_cast<double>(i % 4);
    r.y[i] = std::sin(3 * r.X(i, 0)) + r.X(i, 1) * r.X(i, 1) + 0.3 * r.X(i, 2) + 0.1 * random.normal();
  }
  return r;
}

inline FitOptions options_of(const Reference& r) {
  FitOptions options = categories::box_options();
  options.correlation = r.family;
  options.structure = r.structure;
  return options;
}

}  // namespace drawpoint::kriging::structures
