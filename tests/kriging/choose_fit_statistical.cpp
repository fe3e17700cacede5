// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What would mislead a choice by leave-one-out: ways that choose by the runs they are given, and runs that do
/// not lie where predictions are asked for.

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/tests/kriging/corner_design.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int waves = 300, taken = 8;

struct Runs {
  MatrixXd X;
  VectorXd y;
};

Runs noise(Eigen::Index n, doe::Seed seed) {
  doe::RandomStream random(seed);
  Runs r{MatrixXd(n, 2), VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < 2; ++k) r.X(i, k) = random.uniform();
    r.y[i] = random.normal();
  }
  return r;
}

/// Of one direction, length and phase each, the same for every number.
double wave(int number, const VectorXd& x) {
  doe::RandomStream random(static_cast<doe::Seed>(100 + number));
  const double a = 20 * random.normal(), b = 20 * random.normal(), phase = 2 * M_PI * random.uniform();
  return std::cos(a * x[0] + b * x[1] + phase);
}

VectorXd wave_at(int number, const MatrixXd& X) {
  VectorXd values(X.rows());
  for (Eigen::Index i = 0; i < X.rows(); ++i) values[i] = wave(number, X.row(i).transpose());
  return values;
}

/// One after the other the wave that goes along most with what the ones before it leave of y.
std::vector<int> waves_of(const MatrixXd& X, const VectorXd& y) {
  MatrixXd A = MatrixXd::Ones(X.rows(), 1);
  std::vector<int> chosen;
  while (static_cast<int>(chosen.size()) < taken) {
    const VectorXd rest = y - A * A.householderQr().solve(y);
    int best = 0;
    double most = -1;
    for (int w = 0; w < waves; ++w) {
      const VectorXd values = wave_at(w, X);
      const double likeness = std::abs(values.dot(rest)) / values.norm();
      if (likeness > most) best = w, most = likeness;
    }
    chosen.push_back(best);
    A.conservativeResize(Eigen::NoChange, A.cols() + 1);
    A.rightCols(1) = wave_at(best, X);
  }
  return chosen;
}

TransformedModel fit_on(const std::vector<int>& chosen, const MatrixXd& X, const VectorXd& y) {
  FitOptions options;
  options.trend = Trend::user;
  options.basis.values = [chosen](const VectorXd& x) {
    VectorXd values = VectorXd::Ones(static_cast<Eigen::Index>(chosen.size()) + 1);
    for (std::size_t k = 0; k < chosen.size(); ++k)
      values[static_cast<Eigen::Index>(k) + 1] = wave(chosen[k], x);
    return values;
  };
  return fit_transformed(X, y, Scale::linear, {}, options);
}

std::vector<WayToFit> usual_ways() {
  std::vector<WayToFit> all;
  for (const FitOptions& options : usual_kinds())
    all.push_back(way_with_noise("", Scale::linear, {}, options, NoiseSource::estimated));
  return all;
}

std::vector<double> errors_of_ways(const Runs& r, const Runs& fresh) {
  std::vector<double> errors;
  for (const WayToFit& way : usual_ways())
    errors.push_back(validate(way.fitter(r.X, r.y), fresh.X, fresh.y).nrmse);
  return errors;
}

/// The way that the mean over the runs alone would take.
std::size_t best_over_runs(const FitChoice& choice) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < choice.table.size(); ++k) {
    const FitStanding& standing = choice.table[k];
    if (standing.gain > std::max(standing.standard_error, choice.table[best].gain)) best = k;
  }
  return best;
}

FitChoice choice_of(const Runs& r, const WayToFit& other) {
  const WayToFit plain{
      "plain", [](const MatrixXd& X, const VectorXd& y) { return fit_transformed(X, y, Scale::linear, {}); }};
  return choose_fit(r.X, r.y, {}, {plain, other});
}

}  // namespace

// Eight of 300 waves, the best one after the other, explain two thirds of 60 runs of pure noise, and
// leave-one-out with these waves given speaks for them by several standard errors. On runs that the choice
// has not seen they add their own error to the noise.
TEST(ChooseFit, TakesNoWayThatFollowsTheNoise) {
  for (doe::Seed seed = 1; seed <= 5; ++seed) {
    const FitChoice choice = choice_of(noise(60, seed), {"waves", [](const MatrixXd& X, const VectorXd& y) {
                                                           return fit_on(waves_of(X, y), X, y);
                                                         }});
    const FitStanding& standing = choice.table[1];
    EXPECT_GT(standing.gain, 2 * standing.standard_error) << "leave-one-out sees it: the test is void";
    EXPECT_LT(standing.refitted_gain, 0);
    EXPECT_EQ(choice.name(), "plain");
  }
}

// Three waves that are the response, and are not chosen by the runs.
TEST(ChooseFit, TakesTheWayThatIsRight) {
  const std::vector<int> response{3, 77, 200};
  for (doe::Seed seed = 1; seed <= 5; ++seed) {
    Runs r = noise(60, seed);
    for (const int w : response) r.y += wave_at(w, r.X);
    const FitChoice choice =
        choice_of(r, {"waves", [&](const MatrixXd& X, const VectorXd& y) { return fit_on(response, X, y); }});
    EXPECT_GT(choice.table[1].refitted_gain, 0);
    EXPECT_EQ(choice.name(), "waves");
  }
}

TEST(ChooseFit, AsksNoMoreWhereNoWayBeatsTheFirst) {
  const FitChoice choice = choice_of(noise(30, 1), {"same", [](const MatrixXd& X, const VectorXd& y) {
                                                      return fit_transformed(X, y, Scale::linear, {});
                                                    }});
  EXPECT_TRUE(std::isnan(choice.table[1].refitted_gain));
  EXPECT_EQ(choice.name(), "plain");
}

// Friedman's function, of whose 60 runs 32 are corners. The smooth way without a slope, the first, predicts it
// best. The mean over the runs speaks for other ways, by more than chance, that have more than twice its error.
TEST(ChooseFit, IsNotMisledByCorners) {
  Runs fresh{reference::design(1000, 5, 999), {}};
  fresh.y = reference::values(reference::friedman5, fresh.X);
  int misled = 0;
  for (doe::Seed seed = 1; seed <= 5; ++seed) {
    Runs r{reference::corner_design(seed), {}};
    r.y = reference::values(reference::friedman5, r.X);
    const std::vector<double> errors = errors_of_ways(r, fresh);
    const FitChoice choice = choose_fit(r.X, r.y, {}, usual_ways());
    EXPECT_LT(errors[choice.best], 2 * errors[0]) << "seed " << seed;
    misled += errors[best_over_runs(choice)] > 2 * errors[0];
  }
  EXPECT_GE(misled, 3) << "the designs no longer show what this test is about";
}
