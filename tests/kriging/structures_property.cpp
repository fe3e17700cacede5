// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <drawpoint/kriging/acquisition.hpp>
#include <drawpoint/kriging/acquisition_gradient.hpp>
#include <drawpoint/kriging/append.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/nonstationarity.hpp>
#include <drawpoint/kriging/reinterpolation.hpp>
#include <drawpoint/kriging/sample_paths.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <drawpoint/tests/kriging/structures.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using structures::Reference;

namespace {

// One smooth and one rough family of each structure, 32 runs with a category.
std::vector<Reference> some_kinds() {
  std::vector<Reference> all;
  for (const Structure structure : structures::others)
    for (const Correlation family : {Correlation::gaussian, Correlation::matern32})
      all.push_back(structures::some_runs(structure, family, 32));
  return all;
}

MatrixXd points(Eigen::Index n) {
  MatrixXd Z = categories::points(n, 4, 5);
  Z.leftCols(2) = 2.0 * Z.leftCols(2).array() - 1.0;
  return Z;
}

// θ and λ given; the weights of a sum are estimated.
FitOptions fixed(const Reference& r) {
  FitOptions options = structures::options_of(r);
  options.theta_lower = options.theta_upper = 0.6;
  options.nugget_lower = options.nugget_upper = 1e-3;
  options.parameter_uncertainty = false;
  return options;
}

}  // namespace

// 520 runs, where threads share the work. Three steps show what threads could change; a fit of all would
// show no more.
TEST(Structures, ThreadsChangeNoBit) {
  const MatrixXd X = 2.0 * reference::design(520, 3, 9).array() - 1.0, Z = X.topRows(20) * 0.9;
  VectorXd y = X.col(0).array().sin() + X.col(1).array() * X.col(2).array();
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] += 0.05 * std::cos(1e3 * static_cast<double>(i));
  for (const Structure structure : structures::others) {
    std::vector<Model> models;
    for (const int threads : {1, 2, 3}) {
      FitOptions options;
      options.structure = structure;
      options.starts = options.candidates = 1;
      options.max_iterations = 3;
      options.threads = threads;
      models.push_back(fit(X, y, options));
    }
    for (const Model& other : models) {
      EXPECT_EQ(other.theta(), models[0].theta()) << to_string(structure);
      EXPECT_EQ(other.correlation().weight, models[0].correlation().weight) << to_string(structure);
      EXPECT_EQ(other.predict(Z).mean, models[0].predict(Z).mean) << to_string(structure);
      EXPECT_EQ(other.predict(Z).variance, models[0].predict(Z).variance) << to_string(structure);
    }
  }
}

// The covariance of any points has no eigenvalue below round-off, its diagonal is the variance, and paths
// have it.
TEST(Structures, CovarianceIsOne) {
  for (const Reference& r : some_kinds()) {
    const Model model = fit(r.X, r.y, structures::options_of(r));
    const MatrixXd Z = points(20), C = model.covariance(Z);
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<MatrixXd>(C).eigenvalues()[0], -1e-9 * model.process_variance());
    EXPECT_LT((C.diagonal() - model.predict(Z).variance).cwiseAbs().maxCoeff(),
              1e-9 * model.process_variance());
    // 2000 paths: a mean is good to σ/√2000; 5 of these are missed by one in 1.7e6 of 20.
    const MatrixXd paths = sample_paths(model, Z, 2000);
    const VectorXd error = (paths.rowwise().mean() - model.mean(Z)).cwiseAbs();
    EXPECT_TRUE((error.array() <= 5.0 * (C.diagonal().array().max(0.0) / 2000.0).sqrt() + 1e-9).all());
  }
}

// Runs appended are runs fitted with the same parameters: as round-off at a condition of 40/1e-3 leaves them.
TEST(Structures, AppendedRunsAreFittedOnes) {
  for (const Reference& r : some_kinds()) {
    const FitOptions options = fixed(r);
    const Model some = fit(r.X.topRows(24), r.y.head(24), options);
    const Model all = append(some, r.X.bottomRows(8), r.y.tail(8));
    // The same parameters, all runs at once.
    detail::ModelState s = all.state();
    MatrixXd R;
    fill_correlation(s.X, s.correlation, R);
    R.diagonal().array() += s.nugget;
    const MatrixXd L = R.selfadjointView<Eigen::Lower>().llt().matrixL();
    s.L = L;
    detail::estimate(s);
    const Model at_once(s);
    EXPECT_LT((all.mean(points(20)) - at_once.mean(points(20))).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((all.predict(points(20)).variance - at_once.predict(points(20)).variance).cwiseAbs().maxCoeff(),
              1e-9 * all.process_variance());
  }
}

// In closed form as by leaving each run out of the state; and a search, a validation and a choice take them.
TEST(Structures, AreSurrogatesLikeOthers) {
  for (const Reference& r : some_kinds()) {
    const Model model = fit(r.X, r.y, structures::options_of(r));
    const Validation v = leave_one_out(model);
    for (const Eigen::Index i : {Eigen::Index(0), Eigen::Index(13)}) {
      detail::ModelState s = model.state();
      const std::vector<Eigen::Index> in = detail::rows_besides({i}, r.X.rows());
      s.X = detail::rows_of(s.X, in);
      s.F = detail::rows_of(s.F, in);
      s.y = detail::entries_of(s.y, in);
      s.observed = detail::entries_of(s.observed, in);
      s.parameter_spread.resize(0, 0);
      MatrixXd R;
      fill_correlation(s.X, s.correlation, R);
      R.diagonal().array() += s.nugget;
      s.L = R.selfadjointView<Eigen::Lower>().llt().matrixL();
      detail::estimate(s);
      // The condition is below 32/1e-6: nine digits.
      ASSERT_GT(s.nugget, 1e-6);
      EXPECT_NEAR(Model(s).mean(r.X.row(i))[0], v.predicted[i], 1e-8);
    }
    const MatrixXd Z = points(50);
    const doe::Criterion improvement = expected_improvement(reinterpolated(model), doe::Goal::minimize);
    EXPECT_TRUE((improvement(Z).array() >= 0).all());
    EXPECT_TRUE(knowledge_gradient(model, doe::Goal::minimize)(Z).allFinite());
    EXPECT_EQ(validate(model, r.X, r.y).predicted, model.mean(r.X));
    const auto way = [&](const MatrixXd& X, const VectorXd& y) {
      return fit_transformed(X, y, Scale::linear, {}, structures::options_of(r));
    };
    EXPECT_EQ(choose_fit(r.X, r.y, {}, {{"only", way}}).model.model().theta(), model.theta());
  }
}

// A sum of four waves and a step of 3, 60 runs: the additive model with the step beside it is exact but for
// the waves' interpolation, so its size is met to a hundredth; a product with a step would find none.
TEST(Structures, AJumpIsSoughtWithTheirOwn) {
  doe::RandomStream random(777);
  MatrixXd X(60, 4);
  for (double& x : X.reshaped()) x = random.uniform();
  VectorXd y(60);
  for (Eigen::Index i = 0; i < 60; ++i) {
    y[i] = X(i, 0) > 0.5 ? 3 : 0;
    for (Eigen::Index k = 0; k < 4; ++k) y[i] += std::sin(4 * X(i, k) + static_cast<double>(k));
  }
  FitOptions options;
  options.structure = Structure::additive;
  const Stationarity found = check_stationarity(fit(X, y, options));
  ASSERT_TRUE(found.jump);
  EXPECT_EQ(found.jump->input, 0);
  EXPECT_NEAR(found.jump->size, 3, 0.03);
}

TEST(Structures, AnIsotropicExponentIsOne) {
  const MatrixXd X = MatrixXd::Identity(6, 3);
  const VectorXd y = VectorXd::LinSpaced(6, 0, 1);
  FitOptions options;
  options.structure = Structure::isotropic;
  options.correlation = Correlation::power_exponential;
  options.exponent = Eigen::Vector3d(1.5, 1.5, 2);
  try {
    fit(X, y, options);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_EQ(std::string(e.what()),
              "kriging::fit: exponent[2] is 2 and exponent[0] 1.5; an isotropic correlation has one for all "
              "numbers; give them alike, or take product");
  }
}
