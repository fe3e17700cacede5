// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/append.hpp>
#include <drawpoint/kriging/count_model.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/fit_fidelities.hpp>
#include <drawpoint/kriging/nonstationarity.hpp>
#include <drawpoint/kriging/success_model.hpp>
#include <drawpoint/tests/kriging/categories.hpp>
#include <functional>
#include <stdexcept>
#include <string>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

FitOptions four_levels() {
  FitOptions options = categories::unit_options(3);
  options.levels = {0, 0, 4};
  return options;
}

std::string fault(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

std::string no_level(const std::string& place, const std::string& entry, const std::string& value) {
  return place + ": X(" + entry + ", 2) is " + value +
         "; input 2 is a category; allowed are its levels, whole numbers from 0 to 3; give the index of a "
         "level";
}

MatrixXd at_level(double level) { return Eigen::RowVector3d(0.4, 0.6, level); }

std::vector<bool> successes(const MatrixXd& X) {
  std::vector<bool> succeeded;
  for (Eigen::Index i = 0; i < X.rows(); ++i) succeeded.push_back(!(X(i, 2) == 2.0 && X(i, 0) > 0.3));
  return succeeded;
}

VectorXd some_counts(const MatrixXd& X) {
  VectorXd counts(X.rows());
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    counts[i] = std::floor(X(i, 2) == 1.0 ? 12 * X(i, 0) : 2 * X(i, 1));
  return counts;
}

std::vector<FidelityLevel> two_fidelities(const std::function<MatrixXd(const MatrixXd&)>& naming) {
  const auto rough = [](double u, double v, int level) {
    return 0.8 * categories::scrambled(u, v, level) + u * v;
  };
  const MatrixXd cheap = categories::points(40, 4, 3), few = categories::points(14, 4, 4);
  return {{"rough", naming(cheap), categories::values(+rough, cheap), four_levels()},
          {"true", naming(few), categories::values(categories::scrambled, few), four_levels()}};
}

MatrixXd as_named(const MatrixXd& X) { return X; }

}  // namespace

TEST(CategoryFaults, AreNamed) {
  const auto [X, y] = categories::runs(categories::scrambled, 24, 5);
  MatrixXd between = X, beyond = X;
  between(3, 2) = 1.5;
  beyond(7, 2) = 4;
  const auto fitted = [&, runs = &y](const MatrixXd& Z) { fit(Z, *runs, four_levels()); };
  EXPECT_EQ(fault([&] { fitted(between); }), no_level("kriging::fit", "3", "1.5"));
  EXPECT_EQ(fault([&] { fitted(beyond); }), no_level("kriging::fit", "7", "4"));
  const Model model = fit(X, y, four_levels());
  const std::string at_point = no_level("kriging::Model", "0", "-1");
  EXPECT_EQ(fault([&] { model.predict(at_level(-1)); }), at_point);
  EXPECT_EQ(fault([&] { model.mean(at_level(-1)); }), at_point);
  EXPECT_EQ(fault([&] { model.covariance(at_level(-1)); }), at_point);
  EXPECT_EQ(fault([&] { model.gradient(at_level(-1).row(0)); }), at_point);
  EXPECT_EQ(fault([&] { model.mean_gradient(at_level(-1).row(0)); }), at_point);
  EXPECT_EQ(fault([&] { append(model, at_level(2.5), VectorXd::Ones(1)); }),
            no_level("kriging::append", "0", "2.5"));
}

TEST(CategoryFaults, OfOptionsAreNamed) {
  const auto [X, y] = categories::runs(categories::scrambled, 24, 5);
  const auto with = [&, runs = &y, points = &X](const std::vector<int>& levels) {
    FitOptions options;
    options.levels = levels;
    return fault([&] { fit(*points, *runs, options); });
  };
  EXPECT_EQ(
      with({0, 4}),
      "kriging::fit: levels has 2 entries but X has 3 columns; give one per input, 0 for a number, or none");
  EXPECT_EQ(with({0, 0, 1}),
            "kriging::fit: levels[2] is 1; allowed are 0 for a number and 2 or more for a category; count "
            "its levels");
  EXPECT_EQ(
      with({0, -1, 4}),
      "kriging::fit: levels[1] is -1; allowed are 0 for a number and 2 or more for a category; count its "
      "levels");
  EXPECT_EQ(with({0, 0, 0}), "accepted");
}

// Levels that are all 0 change nothing, not a bit.
TEST(Categories, NoneAreNumbers) {
  const auto [X, y] = categories::runs(categories::scrambled, 24, 5);
  FitOptions none = four_levels();
  none.levels = {0, 0, 0};
  const Model a = fit(X, y, none), b = fit(X, y, categories::unit_options(3));
  EXPECT_EQ(a.predict(X).variance, b.predict(X).variance);
  EXPECT_TRUE(a.correlation().levels.empty());
}

// Levels 0, 1 and 3 differ by offsets and slopes, so that level 2 may lie anywhere between and beyond: its
// variance is many times that of a level with runs, and the message says what it rests on.
TEST(Categories, ALevelWithoutRunsIsUncertain) {
  auto [X, y] = categories::runs(categories::scrambled, 48, 5);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    if (X(i, 2) != 2.0) rows.push_back(i);
  const Model model = fit(X(rows, Eigen::all), y(rows), four_levels());
  EXPECT_NE(model.message().find(
                "the fit had no run of level 2 of input 2: predictions there rest on the other levels"),
            std::string::npos)
      << model.message();
  const double there = model.predict(at_level(2)).variance[0], here = model.predict(at_level(1)).variance[0];
  EXPECT_GT(there, 100 * here);
}

TEST(Categories, NeedNoBounds) {
  const auto [X, y] = categories::runs(categories::scrambled, 24, 5);
  FitOptions options = four_levels();
  options.lower = VectorXd::Zero(3);
  options.upper = VectorXd::Ones(3);
  const VectorXd with = fit(X, y, options).mean(at_level(1));
  options.upper[2] = 0;
  EXPECT_EQ(fit(X, y, options).mean(at_level(1)), with);
}

// All runs at one level tell nothing of the others: the trend, with the variance s² and that of the trend.
TEST(Categories, OneLevelAloneTellsNothingOfOthers) {
  auto [X, y] = categories::runs(categories::idle, 24, 5);
  X.col(2).setConstant(1.0);
  const Model model = fit(X, y, four_levels());
  EXPECT_NE(model.message().find(
                "the fit had no run of levels 0, 2, 3 of input 2: predictions there are the trend"),
            std::string::npos)
      << model.message();
  EXPECT_NEAR(model(at_level(3).row(0)), model.trend(), 1e-12 * (1 + std::abs(model.trend())));
  EXPECT_GE(model.predict(at_level(3)).variance[0], model.process_variance());
  const MatrixXd numbers = X.leftCols(2);
  const Model of_numbers = fit(numbers, y, categories::unit_options(2));
  EXPECT_NEAR(model(at_level(1).row(0)), of_numbers(Eigen::Vector2d(0.4, 0.6)), 1e-4);
}

// A constant model knows levels too.
TEST(Categories, AConstantKnowsItsLevels) {
  const MatrixXd X = categories::points(8, 4, 1);
  const Model model = fit(X, VectorXd::Constant(8, 3.0), four_levels());
  EXPECT_EQ(model(at_level(1).row(0)), 3.0);
  EXPECT_EQ(fault([&] { model.mean(at_level(1.5)); }), no_level("kriging::Model", "0", "1.5"));
}

TEST(SuccessOfCategories, NamesMeanNothing) {
  const MatrixXd X = categories::points(40, 4, 6), Z = categories::points(20, 4, 7);
  const SuccessOptions options{VectorXd::Zero(3), VectorXd::Ones(3), {0, 0, 4}};
  const SuccessModel a = fit_success(X, successes(X), options),
                     b = fit_success(categories::renamed(X), successes(X), options);
  EXPECT_EQ(a.probability(Z), b.probability(categories::renamed(Z)));
  EXPECT_GT(a.probability(at_level(1))[0], 0.8);
  EXPECT_LT(a.probability(Eigen::RowVector3d(0.8, 0.5, 2))[0], 0.5);
  EXPECT_EQ(fault([&, model = &a] { model->probability(at_level(1.5)); }),
            no_level("kriging::SuccessModel::probability", "0", "1.5"));
  MatrixXd wrong = X;
  wrong(0, 2) = 4;
  EXPECT_EQ(fault([&] { fit_success(wrong, successes(X), options); }),
            no_level("kriging::fit_success", "0", "4"));
}

TEST(CountsOfCategories, NamesMeanNothing) {
  const MatrixXd X = categories::points(40, 4, 6), Z = categories::points(20, 4, 7);
  const CountOptions options{VectorXd::Zero(3), VectorXd::Ones(3), {0, 0, 4}};
  const CountModel a = fit_counts(X, some_counts(X), options),
                   b = fit_counts(categories::renamed(X), some_counts(X), options);
  EXPECT_EQ(a.mean(Z), b.mean(categories::renamed(Z)));
  EXPECT_GT(a.mean(Eigen::RowVector3d(0.9, 0.5, 1))[0], 2 * a.mean(Eigen::RowVector3d(0.9, 0.5, 2))[0]);
  EXPECT_EQ(fault([&, model = &a] { model->mean(at_level(1.5)); }),
            no_level("kriging::CountModel", "0", "1.5"));
}

TEST(CokrigingOfCategories, NamesMeanNothing) {
  const FidelityOptions options{.rho = Trend::linear, .compare = true};
  const FidelityModel a = fit_fidelities(two_fidelities(as_named), options),
                      b = fit_fidelities(two_fidelities(categories::renamed), options);
  const MatrixXd Z = categories::points(20, 4, 7);
  const Prediction p = a.predict(Z), q = b.predict(categories::renamed(Z));
  EXPECT_EQ(p.mean, q.mean);
  EXPECT_EQ(p.variance, q.variance);
  const VectorXd x = at_level(1).row(0);
  EXPECT_EQ(a.gradient(x).mean[2], 0.0);
  EXPECT_EQ(a.gradient(x).variance[2], 0.0);
  EXPECT_EQ(fault([&, model = &a] { model->mean(at_level(1.5)); }),
            no_level("kriging::FidelityModel", "0", "1.5"));
}

TEST(CokrigingOfCategories, OtherCategoriesAreRefused) {
  std::vector<FidelityLevel> levels = two_fidelities(as_named);
  levels[1].options.levels = {};
  EXPECT_EQ(
      fault([&] { fit_fidelities(levels); }),
      "kriging::fit_fidelities: level \"true\": its options.levels differ from those of the cheapest level; "
      "allowed are the same categories everywhere; give all levels the same");
  levels[1].options.levels = {0, 0, 4};
  levels[1].X(2, 2) = 9;
  EXPECT_EQ(fault([&] { fit_fidelities(levels); }),
            no_level("kriging::fit_fidelities: level \"true\"", "2", "9"));
}

// Levels that differ are no jump: there is no place between them.
TEST(StationarityOfCategories, LevelsAreNoJump) {
  const auto [X, y] = categories::runs(categories::scrambled, 60, 5);
  const Stationarity found = check_stationarity(fit(X, y, four_levels()));
  EXPECT_FALSE(found.uneven);
  EXPECT_FALSE(found.jump);
}
