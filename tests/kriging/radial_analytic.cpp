// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <drawpoint/kriging/fit_radial.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <drawpoint/tests/kriging/without.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr RadialFunction functions[] = {RadialFunction::thin_plate, RadialFunction::cubic,
                                        RadialFunction::multiquadric, RadialFunction::gaussian};

double wave(const VectorXd& x) { return std::sin(4 * x[0]) + x[1] * x[1]; }

RadialOptions with(RadialFunction f, double ridge) {
  return {.function = f,
          .shape = detail::has_shape(f) ? std::optional(1.5) : std::nullopt,
          .ridge = ridge,
          .lower = VectorXd::Zero(2),
          .upper = VectorXd::Ones(2)};
}

}  // namespace

// The largest condition here is that of the Gaussian with ε = 1.5: below 1e9 (asserted), and weights of as
// many digits less; 1e-16·1e9 leaves 1e-6 ample.
TEST(RadialFit, InterpolatesWithoutARidge) {
  const MatrixXd X = reference::design(30, 2, 3);
  const VectorXd y = reference::values(wave, X);
  for (const RadialFunction f : functions) {
    const Radial model = fit_radial(X, y, with(f, 0.0));
    const VectorXd& values = model.state().values;
    ASSERT_LT(values.maxCoeff() / values.minCoeff(), 1e9) << to_string(f);
    EXPECT_EQ(model.status(), Status::converged) << model.message();
    EXPECT_LE((model.mean(X) - y).cwiseAbs().maxCoeff(), 1e-6) << to_string(f);
    const Prediction p = model.predict(X);
    EXPECT_LE((p.mean - model.mean(X)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LE(p.variance.maxCoeff(), 1e-6 * model.predict(reference::design(50, 2, 9)).variance.maxCoeff());
  }
}

// A plane is the tail's; the constant that of the others. 1e-12 for sums of 30 numbers of size 1 by weights
// near 0.
TEST(RadialFit, ReproducesItsTail) {
  const MatrixXd X = reference::design(30, 2, 3), points = 3.0 * reference::design(20, 2, 4);
  const auto plane = [](const VectorXd& x) { return 2 * x[0] - x[1] + 5; };
  for (const RadialFunction f : {RadialFunction::thin_plate, RadialFunction::cubic}) {
    const Radial model = fit_radial(X, reference::values(plane, X), with(f, 1e-3));
    EXPECT_LE((model.mean(points) - reference::values(plane, points)).cwiseAbs().maxCoeff(), 1e-12)
        << to_string(f);
  }
}

// The saddle system [K P; Pᵀ 0] solved as a whole gives the same mean and, by its inverse, the variance
// s² (φ(0) − [k; p]ᵀ[K P; Pᵀ 0]⁻¹[k; p]). The ridge of 1e-4 keeps conditions below 1e6.
TEST(RadialFit, EqualsTheWholeSystem) {
  const MatrixXd X = reference::design(20, 2, 3), point = reference::design(1, 2, 7);
  const VectorXd y = reference::values(wave, X);
  for (const RadialFunction f : functions) {
    const Radial model = fit_radial(X, y, with(f, 1e-4));
    const detail::RadialState& s = model.state();
    const Eigen::Index n = 20, q = s.P.cols();
    MatrixXd K = MatrixXd::Zero(n + q, n + q);
    K.topLeftCorner(n, n) = detail::radial_matrix(s, s.X, s.X) + s.ridge * MatrixXd::Identity(n, n);
    K.topRightCorner(n, q) = s.P;
    K.bottomLeftCorner(q, n) = s.P.transpose();
    VectorXd right = VectorXd::Zero(n + q), at(n + q);
    right.head(n) = y;
    const MatrixXd z = s.input.apply(point);
    at << detail::radial_matrix(s, z, s.X).transpose(), detail::radial_tail(s, z).transpose();
    const Eigen::FullPivLU<MatrixXd> whole(K);
    const Prediction p = model.predict(point);
    EXPECT_NEAR(p.mean[0], at.dot(whole.solve(right)), 1e-9) << to_string(f);
    const double share = detail::radial(f, s.shape, 0.0) - at.dot(whole.solve(at));
    EXPECT_NEAR(p.variance[0] / (s.y_scale * s.y_scale * s.process_variance), share, 1e-9) << to_string(f);
    EXPECT_GT(share, 0.0);
  }
}

// Brute force with ε and λ held; λ is a share of the largest eigenvalue, which leaving a run out moves, so
// the refits are given their own share.
TEST(RadialLeaveOneOut, EqualsTheRefits) {
  const MatrixXd X = reference::design(20, 2, 3);
  const VectorXd y = reference::values(wave, X);
  for (const RadialFunction f : functions) {
    const Radial model = fit_radial(X, y, with(f, 1e-4));
    const Validation v = leave_one_out(model);
    for (Eigen::Index i = 0; i < 20; ++i) {
      const MatrixXd rest = reference::without(X, i);
      detail::RadialState s = model.state();
      const double largest = detail::radial_spectrum(s, s.input.apply(rest), VectorXd::Zero(19)).largest();
      const Radial other = fit_radial(rest, reference::without(y, i), with(f, model.ridge() / largest));
      ASSERT_NEAR(other.ridge(), model.ridge(), 1e-12 * model.ridge());
      EXPECT_NEAR(v.predicted[i], other.mean(X.row(i))[0], 1e-9) << to_string(f) << " " << i;
      const double unit = other.state().y_scale * other.state().y_scale * other.state().process_variance;
      const double own = model.state().y_scale * model.state().y_scale * model.state().process_variance;
      EXPECT_NEAR(v.variance[i] / own, other.predict(X.row(i)).variance[0] / unit, 1e-9) << to_string(f);
    }
  }
}

// A site leaves with all of its runs. ε and λ are given; λ is a share of the largest eigenvalue, which the repeats
// change, so that the refits get what keeps it the same.
TEST(RadialLeaveOneOut, OfRepeatsEqualsTheRefitsWithoutTheirPoint) {
  MatrixXd X(26, 2);
  X << reference::design(20, 2, 3), reference::design(20, 2, 3).topRows(3),
      reference::design(20, 2, 3).topRows(3);
  VectorXd y = reference::values(wave, X);
  doe::RandomStream random(1);
  for (double& value : y) value += 0.2 * random.normal();
  const Radial all = fit_radial(X, y, with(RadialFunction::multiquadric, 0.1));
  const Validation v = leave_one_out(all);
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    std::vector<Eigen::Index> rest;
    for (Eigen::Index j = 0; j < X.rows(); ++j)
      if (X.row(j) != X.row(i)) rest.push_back(j);
    const MatrixXd others = detail::rows_of(X, rest);
    const VectorXd of_others = detail::entries_of(y, rest);
    const double share =
        0.1 * all.ridge() / fit_radial(others, of_others, with(RadialFunction::multiquadric, 0.1)).ridge();
    const Radial without = fit_radial(others, of_others, with(RadialFunction::multiquadric, share));
    ASSERT_NEAR(without.ridge(), all.ridge(), 1e-12 * all.ridge());
    EXPECT_NEAR(v.predicted[i], without.mean(X.row(i))[0], 1e-8) << i;
  }
}

// The chosen ε and λ are no worse than any of a grid that the search does not use.
TEST(RadialFit, FindsShapeAndRidgeByLeaveOneOut) {
  const MatrixXd X = reference::design(40, 2, 3);
  VectorXd y = reference::values(wave, X);
  doe::RandomStream random(2);
  for (double& value : y) value += 0.1 * random.normal();
  for (const RadialFunction f : {RadialFunction::multiquadric, RadialFunction::gaussian}) {
    const double chosen = leave_one_out(fit_radial(X, y, {.function = f})).rmse;
    for (const double shape : {0.07, 0.3, 0.9, 2.7, 7.0})
      for (const double ridge : {1e-9, 1e-5, 1e-2, 0.3})
        EXPECT_LE(
            chosen,
            1.02 * leave_one_out(fit_radial(X, y, {.function = f, .shape = shape, .ridge = ridge})).rmse)
            << to_string(f) << " " << shape << " " << ridge
            << ": beyond a percent or two the grid is too coarse";
  }
}

// Central differences with h = 1e-5 of a mean of size 1 whose third derivatives are below 1e3: 1e3 h²/6 = 2e-8,
// and the round-off of the mean (RadialFit.InterpolatesWithoutARidge: 1e-10 and less) over h: 1e-5.
TEST(RadialGradient, IsThatOfTheMean) {
  const MatrixXd X = reference::design(30, 2, 3), points = reference::design(20, 2, 4);
  const VectorXd y = reference::values(wave, X);
  constexpr double h = 1e-5;
  for (const RadialFunction f : functions) {
    const Radial model = fit_radial(X, y, with(f, 1e-6));
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const VectorXd x = points.row(i).transpose(), gradient = model.mean_gradient(x);
      for (Eigen::Index k = 0; k < 2; ++k) {
        const VectorXd step = h * VectorXd::Unit(2, k);
        EXPECT_NEAR(gradient[k], (model(x + step) - model(x - step)) / (2 * h), 1e-5) << to_string(f);
      }
    }
    EXPECT_EQ(fit_radial(X, VectorXd::Ones(30), with(f, 0.0)).mean_gradient(X.row(0).transpose()),
              VectorXd::Zero(2));
  }
}

TEST(RadialStatus, TellsWhatTheRunsAllow) {
  const MatrixXd X = reference::design(6, 2, 3);
  const VectorXd y = reference::values(wave, X);
  EXPECT_EQ(fit_radial(X.topRows(3), y.head(3)).status(), Status::too_few_runs);
  EXPECT_EQ(fit_radial(X.topRows(1), y.head(1)).status(), Status::too_few_runs);
  EXPECT_TRUE(std::isinf(fit_radial(X.topRows(1), y.head(1)).predict(X).variance[0]));
  EXPECT_EQ(fit_radial(X, VectorXd::Ones(6)).status(), Status::constant_response);
  EXPECT_EQ(leave_one_out(fit_radial(X, VectorXd::Ones(6))).rmse, 0.0);
  EXPECT_TRUE(fit_radial(X.topRows(2), y.head(2)).mean(X).allFinite());
  MatrixXd diagonal(8, 2);
  diagonal.col(0) = diagonal.col(1) = VectorXd::LinSpaced(8, 0, 1);
  const Radial flat = fit_radial(diagonal, VectorXd::LinSpaced(8, 0, 1).array().exp().matrix());
  EXPECT_EQ(flat.status(), Status::ill_conditioned) << flat.message();
  EXPECT_TRUE(flat.predict(X).variance.allFinite());
  MatrixXd repeated(12, 2);
  repeated << X, X;
  VectorXd twice(12);
  twice << y, y.array() + 0.1;
  const Radial model = fit_radial(repeated, twice, {.ridge = 0.0});
  EXPECT_EQ(model.status(), Status::ill_conditioned);
  EXPECT_TRUE(model.mean(X).allFinite());
}

TEST(RadialStatus, RefusesBadInput) {
  const auto refusal = [](const RadialOptions& options) -> std::string {
    try {
      fit_radial(reference::design(6, 2, 3), VectorXd::LinSpaced(6, 0, 1), options);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal({.shape = 2.0}), "kriging::fit_radial: shape is 2 but cubic has none; leave it out");
  EXPECT_EQ(
      refusal({.function = RadialFunction::gaussian, .shape = -2.0}),
      "kriging::fit_radial: shape is -2; allowed are finite numbers above 0; leave it out to estimate it");
  EXPECT_EQ(
      refusal({.ridge = std::nan("")}),
      "kriging::fit_radial: ridge is nan; allowed are finite numbers from 0 on; leave it out to estimate it");
  EXPECT_EQ(
      refusal({.ridge = -1.0}),
      "kriging::fit_radial: ridge is -1; allowed are finite numbers from 0 on; leave it out to estimate it");
  EXPECT_EQ(refusal({.lower = VectorXd::Zero(2)}).substr(0, 38), "kriging::fit_radial: the box has 2 low");
}
