// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Functions of two numbers on [0, 1] and one of four levels (the beam: six) without an order, and runs of
/// them.

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/options.hpp>
#include <utility>

namespace drawpoint::kriging::categories {

using Function = double (*)(double u, double v, int level);

/// Curves of one kind with offsets and slopes that follow no order of the levels.
inline double scrambled(double u, double v, int level) {
  constexpr double offset[] = {0.0, 2.0, -1.5, 1.0}, slope[] = {1.0, -1.0, 1.5, 0.0};
  return std::sin(5.0 * u) + v * v + offset[level] + slope[level] * u;
}

/// Levels that have nothing in common but their scale.
inline double unrelated(double u, double v, int level) {
  constexpr double rate[] = {7.0, 4.0, 6.0, 5.0}, phase[] = {0.0, 2.0, 4.0, 1.0};
  return std::sin(rate[level] * u + phase[level]) + std::cos((3.0 + level % 2) * v + 2.0 * phase[level]);
}

/// Two pairs of levels that are alike: 0 with 2, and 1 with 3.
inline double paired(double u, double v, int level) {
  const double sign = level % 2 == 0 ? 1.0 : -1.0;
  return sign * (std::sin(5.0 * u) + v) + 0.1 * level * v;
}

/// Levels in order, alike when they are neighbours: what an index as a number fits.
inline double ordered(double u, double v, int level) {
  return std::sin(4.0 * u + 0.5 * level) + v * v + 0.5 * level;
}

/// The same with the levels dealt anew: their order is there, but the index does not say it.
inline double shuffled(double u, double v, int level) {
  constexpr int place[] = {2, 0, 3, 1};
  return ordered(u, v, place[level]);
}

/// Levels that do nothing.
inline double idle(double u, double v, int) { return std::sin(5.0 * u) + v * v; }

/// Deflection of a beam with one of six cross sections, by its length and height: Zhang, Tao, Chen, Apley
/// 2020, Technometrics 62(3), "A latent variable approach to Gaussian process modeling with qualitative and
/// quantitative factors", section 4.1.
inline double beam(double u, double v, int level) {
  constexpr double inertia[] = {0.0833, 0.139, 0.380, 0.0796, 0.133, 0.363};
  const double length = 10.0 + 10.0 * u, height = 1.0 + v;
  return length * length * length / (3e9 * std::pow(height, 4) * inertia[level]);
}

/// n points: a Latin hypercube of the numbers, the levels in turn.
inline Eigen::MatrixXd points(Eigen::Index n, int levels, doe::Seed seed) {
  doe::RandomStream random(seed);
  Eigen::MatrixXd X(n, 3);
  for (Eigen::Index k = 0; k < 2; ++k) {
    for (Eigen::Index i = 0; i < n; ++i)
      X(i, k) = (static_cast<double>(i) + random.uniform()) / static_cast<double>(n);
    for (Eigen::Index i = n - 1; i > 0; --i) {
      const auto j = static_cast<Eigen::Index>(random.uniform() * static_cast<double>(i + 1));
      std::swap(X(i, k), X(j, k));
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) X(i, 2) = static_cast<double>(i % levels);
  return X;
}

inline Eigen::VectorXd values(Function f, const Eigen::MatrixXd& X) {
  Eigen::VectorXd y(X.rows());
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] = f(X(i, 0), X(i, 1), static_cast<int>(X(i, 2)));
  return y;
}

struct Runs {
  Eigen::MatrixXd X;
  Eigen::VectorXd y;
};

inline Runs runs(Function f, Eigen::Index n, doe::Seed seed) {
  Eigen::MatrixXd X = points(n, 4, seed);
  Eigen::VectorXd y = values(f, X);
  return {std::move(X), std::move(y)};
}

/// The first two levels, 0 and 1.
inline Runs two_level_runs() {
  Eigen::MatrixXd X = points(24, 2, 11);
  Eigen::VectorXd y = values(scrambled, X);
  return {std::move(X), std::move(y)};
}

/// The levels dealt anew: 0 1 2 3 become 2 0 3 1.
inline Eigen::MatrixXd renamed(Eigen::MatrixXd X) {
  constexpr double name[] = {2, 0, 3, 1};
  for (Eigen::Index i = 0; i < X.rows(); ++i) X(i, 2) = name[static_cast<int>(X(i, 2))];
  return X;
}

/// The box [0, 1]^d.
inline FitOptions unit_options(Eigen::Index d) {
  FitOptions options;
  options.lower = Eigen::VectorXd::Zero(d);
  options.upper = Eigen::VectorXd::Ones(d);
  return options;
}

/// The box [-1, 1]² and a category of four levels.
inline FitOptions box_options() {
  FitOptions options;
  options.lower = Eigen::Vector3d(-1, -1, 0);
  options.upper = Eigen::Vector3d(1, 1, 3);
  options.levels = {0, 0, 4};
  return options;
}

}  // namespace drawpoint::kriging::categories
