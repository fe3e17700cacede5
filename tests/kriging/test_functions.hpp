// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Functions on [0, 1]^d by which fits are judged, beyond the three of reference_cases.hpp.
///
/// friedman5, borehole8, piston7, circuit6, hartmann3 and hartmann6 with their usual constants (Surjanovic, Bingham,
/// "Virtual Library of Simulation Experiments"); franke2: Franke 1979. waves5, rational5, saturating4 and
/// step3 are ours: smooth waves, a ratio, a production that saturates, and a jump. process4 is a draw of the
/// Gaussian process that a fit takes for granted: rates 4, 2, 1 and 0.5 on [0, 1]⁴, by 500 random cosines
/// (Rahimi, Recht 2007), whose covariance misses the Gaussian's by 1/√500 at most. nothing4 is 0. hilly2, with
/// several minima, is for searches. Where `noise` is above 0, runs are observed with normal noise of that
/// deviation.

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <functional>
#include <string>
#include <vector>

namespace drawpoint::kriging::reference {

struct TestFunction {
  std::string name;
  int variables;
  double noise;
  std::function<double(const Eigen::VectorXd& x, doe::Seed draw)> value;  ///< `draw`: of process4 alone
};

inline double friedman5(const Eigen::VectorXd& x) { return noisy4(x) + 5 * x[4]; }

inline double hilly2(const Eigen::VectorXd& x) {
  return std::sin(6 * x[0]) + std::cos(5 * x[1]) + x[0] * x[1];
}

inline double waves5(const Eigen::VectorXd& x) {
  return std::sin(3 * x[0] + 2 * x[1]) + std::cos(4 * x[2] * x[3]) + 0.5 * std::sin(5 * x[4]);
}

inline double rational5(const Eigen::VectorXd& x) {
  return (1 + x[0] * x[1]) / (1 + x[2] + 0.5 * x[3] * x[3]) + x[4] / (1 + x[0]);
}

inline double saturating4(const Eigen::VectorXd& x) {
  return 700 * (1 - std::exp(-3 * x[0])) * (1 - 0.3 * x[1]) + 60 * std::sin(3 * x[2]) * x[3];
}

inline double step3(const Eigen::VectorXd& x) { return (x[0] + 0.3 * x[1] > 0.65 ? 1.0 : 0.0) + 0.3 * x[2]; }

/// Flow of water through a borehole [m³/year].
inline double borehole8(const Eigen::VectorXd& u) {
  const auto at = [&](int k, double low, double high) { return low + (high - low) * u[k]; };
  const double rw = at(0, 0.05, 0.15), r = at(1, 100, 50000), Tu = at(2, 63070, 115600),
               Hu = at(3, 990, 1110), Tl = at(4, 63.1, 116), Hl = at(5, 700, 820), L = at(6, 1120, 1680),
               Kw = at(7, 9855, 12045);
  const double log_ratio = std::log(r / rw);
  return 2 * pi * Tu * (Hu - Hl) / (log_ratio * (1 + 2 * L * Tu / (log_ratio * rw * rw * Kw) + Tu / Tl));
}

/// Cycle time of a piston in a cylinder [s].
inline double piston7(const Eigen::VectorXd& u) {
  const auto at = [&](int k, double low, double high) { return low + (high - low) * u[k]; };
  const double M = at(0, 30, 60), S = at(1, 0.005, 0.02), V0 = at(2, 0.002, 0.01), k = at(3, 1000, 5000),
               P0 = at(4, 90000, 110000), Ta = at(5, 290, 296), T0 = at(6, 340, 360);
  const double A = P0 * S + 19.62 * M - k * V0 / S, gas = P0 * V0 / T0 * Ta;
  const double V = S / (2 * k) * (std::sqrt(A * A + 4 * k * gas) - A);
  return 2 * pi * std::sqrt(M / (k + S * S * gas / (V * V)));
}

/// −Σᵢ αᵢ exp(−Σⱼ Aᵢⱼ (xⱼ − Pᵢⱼ)²).
inline double hartmann(const Eigen::VectorXd& x, const Eigen::MatrixXd& A, const Eigen::MatrixXd& P) {
  const Eigen::Vector4d alpha(1.0, 1.2, 3.0, 3.2);
  double sum = 0;
  for (Eigen::Index i = 0; i < 4; ++i) {
    double exponent = 0;
    for (Eigen::Index j = 0; j < x.size(); ++j) exponent += A(i, j) * std::pow(x[j] - P(i, j), 2);
    sum -= alpha[i] * std::exp(-exponent);
  }
  return sum;
}

inline double hartmann3(const Eigen::VectorXd& x) {
  const Eigen::MatrixXd A =
      (Eigen::MatrixXd(4, 3) << 3, 10, 30, 0.1, 10, 35, 3, 10, 30, 0.1, 10, 35).finished();
  const Eigen::MatrixXd P =
      (Eigen::MatrixXd(4, 3) << 3689, 1170, 2673, 4699, 4387, 7470, 1091, 8732, 5547, 381, 5743, 8828)
          .finished();
  return hartmann(x, A, 1e-4 * P);
}

inline double hartmann6(const Eigen::VectorXd& x) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(4, 6) << 10, 3, 17, 3.5, 1.7, 8, 0.05, 10, 17, 0.1, 8, 14, 3,
                             3.5, 1.7, 10, 17, 8, 17, 8, 0.05, 10, 0.1, 14)
                                .finished();
  const Eigen::MatrixXd P =
      (Eigen::MatrixXd(4, 6) << 1312, 1696, 5569, 124, 8283, 5886, 2329, 4135, 8307, 3736, 1004, 9991, 2348,
       1451, 3522, 2883, 3047, 6650, 4047, 8828, 8732, 5743, 1091, 381)
          .finished();
  return hartmann(x, A, 1e-4 * P);
}

/// Midpoint voltage of a push-pull circuit [V]; not among test_functions().
inline double circuit6(const Eigen::VectorXd& u) {
  const auto at = [&](int k, double low, double high) { return low + (high - low) * u[k]; };
  const double b1 = at(0, 50, 150), b2 = at(1, 25, 70), f = at(2, 0.5, 3), c1 = at(3, 1.2, 2.5),
               c2 = at(4, 0.25, 1.2), gain = at(5, 50, 300) * (c2 + 9);
  return ((12 * b2 / (b1 + b2) + 0.74) * gain + 11.35 * f + 0.74 * f * gain / c1) / (gain + f);
}

inline double franke2(const Eigen::VectorXd& u) {
  const double x = 9 * u[0], y = 9 * u[1];
  return 0.75 * std::exp(-((x - 2) * (x - 2) + (y - 2) * (y - 2)) / 4) +
         0.75 * std::exp(-((x + 1) * (x + 1) / 49 + (y + 1) / 10)) +
         0.5 * std::exp(-((x - 7) * (x - 7) + (y - 3) * (y - 3)) / 4) -
         0.2 * std::exp(-((x - 4) * (x - 4) + (y - 7) * (y - 7)));
}

inline double process4(const Eigen::VectorXd& x, doe::Seed draw) {
  constexpr int cosines = 500;
  const Eigen::Vector4d rate(4, 2, 1, 0.5);
  doe::RandomStream random(draw);
  double sum = 0;
  for (int i = 0; i < cosines; ++i) {
    double phase = 2 * pi * random.uniform();
    for (int k = 0; k < 4; ++k) phase += std::sqrt(2 * rate[k]) * random.normal() * x[k];
    sum += std::cos(phase);
  }
  return std::sqrt(2.0 / cosines) * sum;
}

inline std::vector<TestFunction> test_functions() {
  const auto plain = [](double (*f)(const Eigen::VectorXd&)) {
    return [f](const Eigen::VectorXd& x, doe::Seed) { return f(x); };
  };
  return {{"branin4", 4, 0, plain(branin4)},
          {"ishigami4", 4, 0, plain(ishigami4)},
          {"noisy4", 4, 1, plain(noisy4)},
          {"process4", 4, 0, process4},
          {"friedman5", 5, 0, plain(friedman5)},
          {"waves5", 5, 0, plain(waves5)},
          {"rational5", 5, 0, plain(rational5)},
          {"borehole8", 8, 0, plain(borehole8)},
          {"piston7", 7, 0, plain(piston7)},
          {"hartmann3", 3, 0, plain(hartmann3)},
          {"hartmann6", 6, 0, plain(hartmann6)},
          {"franke2", 2, 0, plain(franke2)},
          {"saturating4", 4, 60, plain(saturating4)},
          {"step3", 3, 0, plain(step3)},
          {"nothing4", 4, 1, [](const Eigen::VectorXd&, doe::Seed) { return 0.0; }}};
}

}  // namespace drawpoint::kriging::reference
