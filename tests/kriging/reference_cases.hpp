// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The three functions of four inputs on [0, 1]⁴ by which Kriging programs are compared, with their designs.
///
///   branin4(x)   = B(15x₁ − 5, 15x₂) + ½ B(15x₃ − 5, 15x₄), B Branin's function with the slope 5/π
///   ishigami4(x) = sin z₁ + 7 sin²z₂ + 0.1 z₃⁴ sin z₁, zᵢ = π(2xᵢ − 1); x₄ is inert
///   noisy4(x)    = 10 sin(π x₁x₂) + 20 (x₃ − ½)² + 10 x₄, standard normal noise on the training runs
/// Training designs are Latin hypercubes with the seed 1000 + n, the test design has 2000 points and the seed
/// 999. Everything comes from splitmix64, so any language can repeat it to the last bit of the design.

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/doe/seed.hpp>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging::reference {

inline constexpr double pi = std::numbers::pi;

inline Eigen::MatrixXd design(int n, int d, doe::Seed seed) {
  doe::RandomStream random(seed);
  Eigen::MatrixXd X(n, d);
  for (int j = 0; j < d; ++j) {
    const std::vector<int> order = doe::detail::permutation(n, random);
    for (int i = 0; i < n; ++i) X(i, j) = (order[i] + random.uniform()) / n;
  }
  return X;
}

inline double branin(double u, double v) {
  const double w = v - 5.1 / (4 * pi * pi) * u * u + 5 / pi * u - 6;
  return w * w + 10 * (1 - 1 / (8 * pi)) * std::cos(u) + 10;
}

inline double branin4(const Eigen::VectorXd& x) {
  return branin(15 * x[0] - 5, 15 * x[1]) + 0.5 * branin(15 * x[2] - 5, 15 * x[3]);
}

inline double ishigami4(const Eigen::VectorXd& x) {
  const Eigen::VectorXd z = pi * (2 * x.array() - 1);
  return std::sin(z[0]) + 7 * std::pow(std::sin(z[1]), 2) + 0.1 * std::pow(z[2], 4) * std::sin(z[0]);
}

inline double noisy4(const Eigen::VectorXd& x) {
  return 10 * std::sin(pi * x[0] * x[1]) + 20 * (x[2] - 0.5) * (x[2] - 0.5) + 10 * x[3];
}

using Function = std::function<double(const Eigen::VectorXd&)>;

inline Eigen::VectorXd values(const Function& f, const Eigen::MatrixXd& X) {
  Eigen::VectorXd y(X.rows());
  for (Eigen::Index i = 0; i < X.rows(); ++i) y[i] = f(X.row(i).transpose());
  return y;
}

struct Data {
  Eigen::MatrixXd X;
  Eigen::VectorXd y;
};

/// Training runs of "branin4", "ishigami4" or "noisy4".
inline Data training(const std::string& name, int n) {
  Data data{design(n, 4, 1000 + n), {}};
  data.y = values(name == "branin4" ? branin4 : name == "ishigami4" ? ishigami4 : noisy4, data.X);
  if (name != "noisy4") return data;
  doe::RandomStream random(77);
  for (double& value : data.y) {
    const double u1 = random.uniform(), u2 = random.uniform();
    value += std::sqrt(-2 * std::log(1 - u1)) * std::cos(2 * pi * u2);
  }
  return data;
}

/// 2000 points without noise.
inline Data testing(const std::string& name) {
  Data data{design(2000, 4, 999), {}};
  data.y = values(name == "branin4" ? branin4 : name == "ishigami4" ? ishigami4 : noisy4, data.X);
  return data;
}

inline double mean(const Eigen::VectorXd& y) { return y.mean(); }
inline double deviation(const Eigen::VectorXd& y) {
  return std::sqrt((y.array() - y.mean()).square().sum() / static_cast<double>(y.size() - 1));
}
inline Eigen::VectorXd standardized(const Eigen::VectorXd& y) {
  return (y.array() - y.mean()) / deviation(y);
}

}  // namespace drawpoint::kriging::reference
