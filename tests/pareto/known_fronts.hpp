// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Test problems with their fronts, by the formulas of their authors, and what the fronts dominate.
///
/// Objectives of a front run from its ideal point to its nadir; the reference point lies a tenth of that
/// range beyond the nadir. Fronts of two objectives are dense samples (20 001 parameters): their hypervolume
/// is short by some 1e-4 of itself. Of three objectives the volume is a formula, but for C2-DTLZ2, whose
/// sample is short by a share that falls with its spacing and is taken out by two spacings (Richardson).

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/tests/pareto/constrained_functions.hpp>
#include <drawpoint/tests/pareto/test_functions.hpp>
#include <drawpoint/tests/pareto/wfg_functions.hpp>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace drawpoint::support {

struct KnownFront {
  std::string name;
  doe::Outcome (*f)(const Eigen::VectorXd&);
  doe::Problem problem;
  Eigen::VectorXd reference;
  double volume;  ///< that the front dominates
};

using Curve = std::function<Eigen::Vector2d(double)>;

/// n x 2: the non-dominated points of the curve over [0, 1].
inline Eigen::MatrixXd sampled_front(const Curve& curve, int parameters = 20001) {
  Eigen::MatrixXd Y(parameters, 2);
  for (int i = 0; i < parameters; ++i)
    Y.row(i) = curve(static_cast<double>(i) / (parameters - 1)).transpose();
  return Y(pareto::non_dominated(Y), Eigen::all);
}

inline Eigen::VectorXd tenth_beyond(const Eigen::VectorXd& ideal, const Eigen::VectorXd& nadir) {
  return nadir + 0.1 * (nadir - ideal);
}

inline Eigen::Vector2d on_zdt1(double t) { return {t, 1.0 - std::sqrt(t)}; }
inline Eigen::Vector2d on_zdt2(double t) { return {t, 1.0 - t * t}; }
inline Eigen::Vector2d on_zdt3(double t) {
  return {t, 1.0 - std::sqrt(t) - t * std::sin(10.0 * std::numbers::pi * t)};
}
/// f_1 is never below 0.2807753191.
inline Eigen::Vector2d on_zdt6(double t) { return on_zdt2(0.2807753191 + (1.0 - 0.2807753191) * t); }
inline Eigen::Vector2d on_wfg1(double t) { return {2.0 * wfg::convex(t), 4.0 * wfg::wavy(t)}; }
inline Eigen::Vector2d on_wfg2(double t) { return {2.0 * wfg::convex(t), 4.0 * wfg::in_pieces(t)}; }
inline Eigen::Vector2d on_wfg4(double t) {
  return {2.0 * std::sin(0.5 * std::numbers::pi * t), 4.0 * std::cos(0.5 * std::numbers::pi * t)};
}

/// Of its optimal points x_1 = x_2 up to 3, then x_2 stays (Deb 2001).
inline Eigen::Vector2d on_bnh(double t) {
  const double a = 5.0 * t, b = std::min(a, 3.0);
  return {4.0 * (a * a + b * b), (a - 5.0) * (a - 5.0) + (b - 5.0) * (b - 5.0)};
}

/// The five pieces of its optimal points, a fifth of [0, 1] each; x_4 = x_6 = 0 (Deb 2001, "Multi-objective
/// optimization using evolutionary algorithms", section 8.3).
inline Eigen::VectorXd osy_optimum(double t) {
  const int piece = std::min(static_cast<int>(5.0 * t), 4);
  const double s = 5.0 * t - piece;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(6);
  x[2] = x[4] = 1.0;
  if (piece <= 1) {
    x.head(2) << 5.0, 1.0;
    x[2] = 1.0 + 4.0 * s;
    x[4] = piece == 0 ? 5.0 : 1.0;
  } else if (piece == 2) {
    x[0] = 4.056 + (5.0 - 4.056) * s;
    x[1] = (x[0] - 2.0) / 3.0;
  } else if (piece == 3) {
    x[1] = 2.0;
    x[2] = 1.0 + (3.732 - 1.0) * s;
  } else {
    x.head(2) << s, 2.0 - s;
  }
  return x;
}

inline Eigen::Vector2d on_osy(double t) { return osy(osy_optimum(t)).values().head(2); }

/// Where the limit forbids the line a point is left out, at f_1 = f_2 = 9.
inline Eigen::Vector2d on_mw1(double t) {
  const double f2 = 1.0 - 0.85 * t;
  const bool allowed = t + f2 <= 1.0 + mw::wave(0.5, 2.0 * mw::along(t, f2), 8);
  return allowed ? Eigen::Vector2d(t, f2) : Eigen::Vector2d(9.0, 9.0);
}

/// The line f_1 + f_2 = 1, or the limit where that lies beyond: both are known by f_2 - f_1.
inline Eigen::Vector2d on_mw3(double t) {
  const double way = -1.2 + 2.4 * t, sum = std::max(1.0, mw::least_sum(0.0, way));
  const Eigen::Vector2d f(0.5 * (sum - way), 0.5 * (sum + way));
  return f.minCoeff() < 0.0 || f[0] > 1.0 ? Eigen::Vector2d(9.0, 9.0) : f;
}

/// The unit circle, or the limit where that lies beyond.
inline Eigen::Vector2d on_mw7(double t) {
  const double angle = 0.5 * std::numbers::pi * t, radius = std::max(1.0, mw::least_radius(angle));
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

inline KnownFront two_objectives(const std::string& name, doe::Outcome (*f)(const Eigen::VectorXd&),
                                 doe::Problem problem, const Curve& curve) {
  const Eigen::MatrixXd Y = sampled_front(curve);
  const Eigen::VectorXd reference = tenth_beyond(Y.colwise().minCoeff(), Y.colwise().maxCoeff());
  return {name, f, std::move(problem), reference, pareto::hypervolume(Y, reference)};
}

/// h of DTLZ7's front f_3 = 6 - h(f_1) - h(f_2).
inline double dtlz7_gain(double t) { return t * (1.0 + std::sin(3.0 * std::numbers::pi * t)); }

/// The front dominates f_3 >= 6 - H(f_1) - H(f_2), H the largest h so far: r²(r_3 - 6) + 2 r ∫_0^r H, and its
/// ideal and nadir follow from where h is largest, f_1 = 0.8594.
inline KnownFront dtlz7_front() {
  const int steps = 1000000;
  double largest = 0.0, at = 0.0;
  for (int i = 0; i <= steps; ++i)
    if (const double t = static_cast<double>(i) / steps; dtlz7_gain(t) > largest) {
      largest = dtlz7_gain(t);
      at = t;
    }
  const Eigen::VectorXd reference =
      tenth_beyond(Eigen::Vector3d(0.0, 0.0, 6.0 - 2.0 * largest), Eigen::Vector3d(at, at, 6.0));
  double highest = 0.0, integral = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps * reference[0];
    if (t <= 1.0) highest = std::max(highest, dtlz7_gain(t));
    integral += highest * reference[0] / steps;
  }
  const double volume = reference[0] * reference[0] * (reference[2] - 6.0) + 2.0 * reference[0] * integral;
  return {"DTLZ7", dtlz7, unit_problem(22, 3), reference, volume};
}

/// Of the points of the sphere within the balls, `across` by `across` angles.
inline Eigen::MatrixXd c2_dtlz2_sample(int across) {
  std::vector<Eigen::Vector3d> kept;
  for (int i = 0; i <= across; ++i)
    for (int k = 0; k <= across; ++k) {
      const double a = 0.5 * std::numbers::pi * i / across, b = 0.5 * std::numbers::pi * k / across;
      const Eigen::Vector3d f(std::cos(a) * std::cos(b), std::cos(a) * std::sin(b), std::sin(a));
      if (c2_limit(f) <= 0.0) kept.push_back(f);
    }
  Eigen::MatrixXd Y(static_cast<Eigen::Index>(kept.size()), 3);
  for (Eigen::Index i = 0; i < Y.rows(); ++i) Y.row(i) = kept[static_cast<std::size_t>(i)].transpose();
  return Y;
}

inline KnownFront c2_dtlz2_front() {
  const Eigen::Vector3d reference = Eigen::Vector3d::Constant(1.1);
  const auto volume = [&](int across) { return pareto::hypervolume(c2_dtlz2_sample(across), reference); };
  return {"C2-DTLZ2", c2_dtlz2, limited_problem(12, 3, 1), reference, 2.0 * volume(600) - volume(300)};
}

/// Without limits first. The cube less the simplex of side 1/2, the cube less an eighth of the unit ball.
inline std::vector<KnownFront> known_fronts() {
  const auto cube = [](double side) { return side * side * side; };
  return {two_objectives("ZDT1", zdt1, unit_problem(30, 2), on_zdt1),
          two_objectives("ZDT2", zdt2, unit_problem(30, 2), on_zdt2),
          two_objectives("ZDT3", zdt3, unit_problem(30, 2), on_zdt3),
          two_objectives("ZDT4", zdt4, unit_problem(10, 2), on_zdt1),
          two_objectives("ZDT6", zdt6, unit_problem(10, 2), on_zdt6),
          two_objectives("WFG1", wfg1, wfg_problem(), on_wfg1),
          two_objectives("WFG2", wfg2, wfg_problem(), on_wfg2),
          two_objectives("WFG4", wfg4, wfg_problem(), on_wfg4),
          two_objectives("WFG9", wfg9, wfg_problem(), on_wfg4),
          {"DTLZ1", dtlz1, unit_problem(7, 3), Eigen::Vector3d::Constant(0.55), cube(0.55) - cube(0.5) / 6.0},
          {"DTLZ2", dtlz2, unit_problem(12, 3), Eigen::Vector3d::Constant(1.1),
           cube(1.1) - std::numbers::pi / 6.0},
          dtlz7_front(),
          two_objectives("BNH", bnh, bnh_problem(), on_bnh),
          two_objectives("OSY", osy, osy_problem(), on_osy),
          two_objectives("MW1", mw1, limited_problem(15, 2, 1), on_mw1),
          two_objectives("MW3", mw3, limited_problem(15, 2, 2), on_mw3),
          two_objectives("MW7", mw7, limited_problem(15, 2, 2), on_mw7),
          c2_dtlz2_front()};
}

}  // namespace drawpoint::support
