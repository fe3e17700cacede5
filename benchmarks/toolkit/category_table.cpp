// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// category_table: what a correlation between levels of a category is worth. Takes no options; prints two
/// tables, each row of 20 designs: five ways to fit seven functions of two numbers and a category, and
/// intervals at a level without runs.
///
///   numbers   the index of the level as a number, what a fit does that knows no categories
///   separate  a model of the numbers for each level
///   alike     kriging::FitOptions::levels: one θ, exp(−4θ) between any two levels
///   own       a θ per level, exp(−4(θₐ + θ_b)): numbers that are 1 at one level and 0 at others
///   places    a place in the plane per level, exp(−|zₐ − z_b|²) (Zhang, Tao, Chen, Apley 2020), by the same
///             prior for the numbers and λ; what is unknown of its parameters is in no variance

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/categories.hpp>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace drawpoint;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int designs = 20, points = 400;

struct Case {
  const char* name;
  int levels;
  kriging::categories::Function f;
};

constexpr Case cases[] = {{"scrambled", 4, kriging::categories::scrambled},
                          {"paired", 4, kriging::categories::paired},
                          {"unrelated", 4, kriging::categories::unrelated},
                          {"ordered", 4, kriging::categories::ordered},
                          {"shuffled", 4, kriging::categories::shuffled},
                          {"idle", 4, kriging::categories::idle},
                          {"beam", 6, kriging::categories::beam}};

using Predictor = std::function<kriging::Prediction(const MatrixXd&)>;
using Fitter = std::function<Predictor(const MatrixXd& X, const VectorXd& y, int levels)>;

kriging::FitOptions options_of(Index d) {
  kriging::FitOptions options = kriging::categories::unit_options(d);
  options.seed = 1;
  return options;
}

Predictor numbers(const MatrixXd& X, const VectorXd& y, int levels) {
  kriging::FitOptions options = options_of(3);
  options.upper[2] = levels - 1;
  return [model = kriging::fit(X, y, options)](const MatrixXd& Z) { return model.predict(Z); };
}

Predictor alike(const MatrixXd& X, const VectorXd& y, int levels) {
  kriging::FitOptions options = options_of(3);
  options.levels = {0, 0, levels};
  return [model = kriging::fit(X, y, options)](const MatrixXd& Z) { return model.predict(Z); };
}

MatrixXd with_indicators(const MatrixXd& X, int levels) {
  MatrixXd Z = MatrixXd::Zero(X.rows(), 2 + levels);
  for (Index i = 0; i < X.rows(); ++i) {
    Z.row(i).head(2) = X.row(i).head(2);
    Z(i, 2 + static_cast<Index>(X(i, 2))) = 1.0;
  }
  return Z;
}

Predictor own(const MatrixXd& X, const VectorXd& y, int levels) {
  return [levels, model = kriging::fit(with_indicators(X, levels), y, options_of(2 + levels))](
             const MatrixXd& Z) { return model.predict(with_indicators(Z, levels)); };
}

std::vector<Index> rows_at(const MatrixXd& X, int level) {
  std::vector<Index> rows;
  for (Index i = 0; i < X.rows(); ++i)
    if (X(i, 2) == level) rows.push_back(i);
  return rows;
}

Predictor separate(const MatrixXd& X, const VectorXd& y, int levels) {
  std::vector<kriging::Model> models;
  for (int level = 0; level < levels; ++level) {
    const std::vector<Index> rows = rows_at(X, level);
    models.push_back(kriging::fit(X(rows, std::vector<Index>{0, 1}), y(rows), options_of(2)));
  }
  return [models](const MatrixXd& Z) {
    kriging::Prediction all{VectorXd(Z.rows()), VectorXd(Z.rows())};
    for (std::size_t level = 0; level < models.size(); ++level) {
      const std::vector<Index> rows = rows_at(Z, static_cast<int>(level));
      const kriging::Prediction p = models[level].predict(Z(rows, std::vector<Index>{0, 1}));
      all.mean(rows) = p.mean;
      all.variance(rows) = p.variance;
    }
    return all;
  };
}

/// Places of the levels from 2L − 3 numbers: the first at the origin, the second on the first axis.
MatrixXd places_of(const VectorXd& z, int levels) {
  MatrixXd at = MatrixXd::Zero(levels, 2);
  at(1, 0) = z[0];
  for (int level = 2; level < levels; ++level) at.row(level) << z[2 * level - 3], z[2 * level - 2];
  return at;
}

MatrixXd with_places(const MatrixXd& X, const MatrixXd& places) {
  MatrixXd Z(X.rows(), 4);
  for (Index i = 0; i < X.rows(); ++i) Z.row(i) << X(i, 0), X(i, 1), places.row(static_cast<Index>(X(i, 2)));
  return Z;
}

/// Of ln θ of two numbers on [-1, 1], the places, ln λ; the gradient by central differences.
class LatentPlaces {
 public:
  LatentPlaces(MatrixXd X, VectorXd y, int levels)
      : X_(std::move(X)), y_(std::move(y)), levels_(levels), prior_(X_.rows(), {true, true}, true, 0.5) {
    X_.leftCols(2) = (2.0 * X_.leftCols(2)).array() - 1.0;
  }

  double value(const VectorXd& p) const {
    const Index last = p.size() - 1;
    kriging::Likelihood likelihood(with_places(X_, places_of(p.segment(2, last - 2), levels_)), y_);
    VectorXd q(5), of_prior(3);
    q << p[0], p[1], 0.0, 0.0, p[last];
    of_prior << p[0], p[1], p[last];
    return likelihood.value(q) + prior_.value(of_prior);
  }

  VectorXd gradient(const VectorXd& p) const {
    VectorXd g(p.size());
    for (Index k = 0; k < p.size(); ++k) {
      VectorXd up = p, down = p;
      up[k] += 1e-5;
      down[k] -= 1e-5;
      g[k] = (value(up) - value(down)) / 2e-5;
    }
    return g;
  }

 private:
  MatrixXd X_;
  VectorXd y_;
  int levels_;
  kriging::detail::JointlyRobustPrior prior_;
};

/// From 16 random starts.
VectorXd likeliest_places(LatentPlaces& likelihood, int levels) {
  const Index m = 2 * levels;
  kriging::Box box{VectorXd::Constant(m, -3.0), VectorXd::Constant(m, 3.0)};
  box.lower.head(2).setConstant(std::log(1.2e-5));
  box.upper.head(2).setConstant(std::log(1250.0));
  box.lower[m - 1] = std::log(1e-10);
  box.upper[m - 1] = std::log(10.0);
  doe::RandomStream random(1);
  VectorXd best;
  double highest = -1e300;
  for (int start = 0; start < 16; ++start) {
    VectorXd p(m);
    for (double& entry : p) entry = 2.0 * random.uniform() - 1.0;
    p.head(2).array() -= 1.5;
    p[m - 1] = std::log(start % 2 == 0 ? 1e-6 : 1e-2);
    kriging::detail::BoxClimb<LatentPlaces> climb(likelihood, box, p);
    climb.advance(100, 1e-4);
    if (!(climb.value() > highest)) continue;
    highest = climb.value();
    best = climb.p();
  }
  return best;
}

/// With the parameters found: inputs are scaled so that θ = 1 for all of them.
Predictor places(const MatrixXd& X, const VectorXd& y, int levels) {
  const VectorXd centred = y.array() - y.mean();
  const double deviation = centred.norm() / std::sqrt(static_cast<double>(y.size() - 1));
  LatentPlaces likelihood(X, centred / deviation, levels);
  const VectorXd p = likeliest_places(likelihood, levels);
  const MatrixXd at = places_of(p.segment(2, p.size() - 3), levels);
  kriging::FitOptions options = options_of(4);
  for (Index k = 0; k < 4; ++k) {
    const double half = k < 2 ? 0.5 * std::exp(-0.5 * p[k]) : 1.0;
    options.lower[k] = -half;
    options.upper[k] = half;
  }
  options.theta_lower = options.theta_upper = 1.0;
  options.nugget_lower = options.nugget_upper = std::exp(p[p.size() - 1]);
  return [at, model = kriging::fit(with_places(X, at), y, options)](const MatrixXd& Z) {
    return model.predict(with_places(Z, at));
  };
}

struct Way {
  const char* name;
  Fitter fitter;
};

struct Result {
  double error = 0, coverage = 0, score = 0, seconds = 0;
};

Result result_of(const Way& way, const Case& one, int runs) {
  Result sum;
  for (int seed = 1; seed <= designs; ++seed) {
    const MatrixXd X = kriging::categories::points(runs, one.levels, static_cast<doe::Seed>(seed));
    const MatrixXd Z = kriging::categories::points(points, one.levels, static_cast<doe::Seed>(1000 + seed));
    const VectorXd y = kriging::categories::values(one.f, X), truth = kriging::categories::values(one.f, Z);
    const double deviation = std::sqrt((truth.array() - truth.mean()).square().mean());
    const auto begin = std::chrono::steady_clock::now();
    const Predictor predict = way.fitter(X, y, one.levels);
    sum.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const kriging::Prediction p = predict(Z);
    sum.error += (p.mean - truth).norm() / std::sqrt(static_cast<double>(points)) / deviation;
    for (Index i = 0; i < points; ++i) {
      const double v = std::max(p.variance[i] / deviation / deviation, 1e-12);
      const double e = (truth[i] - p.mean[i]) / deviation;
      sum.coverage += std::abs(e) <= 1.96 * std::sqrt(v) ? 1.0 / points : 0.0;
      sum.score += 0.5 * (std::log(2.0 * M_PI * v) + e * e / v) / points;
    }
  }
  return {sum.error / designs, sum.coverage / designs, sum.score / designs, sum.seconds / designs};
}

/// Share of 95 % intervals at a level without runs that hold the truth, 400 draws: sin 5u + v² and an offset
/// per level, normal of deviation 1; `levels` of them have four runs each.
double coverage_without_runs(int levels) {
  constexpr int draws = 400;
  int covered = 0;
  for (int draw = 1; draw <= draws; ++draw) {
    doe::RandomStream random(static_cast<doe::Seed>(draw));
    const MatrixXd X = kriging::categories::points(4 * levels, levels, static_cast<doe::Seed>(draw));
    VectorXd offset(levels + 1), y(X.rows());
    for (double& entry : offset) entry = random.normal();
    const auto f = [&](double u, double v, int level) { return std::sin(5 * u) + v * v + offset[level]; };
    for (Index i = 0; i < y.size(); ++i) y[i] = f(X(i, 0), X(i, 1), static_cast<int>(X(i, 2)));
    const Predictor predict = alike(X, y, levels + 1);
    const double u = random.uniform(), v = random.uniform();
    const kriging::Prediction p = predict(Eigen::RowVector3d(u, v, levels));
    covered += std::abs(f(u, v, levels) - p.mean[0]) <= 1.96 * std::sqrt(p.variance[0]);
  }
  return static_cast<double>(covered) / draws;
}

}  // namespace

int main() {
  const std::vector<Way> ways = {
      {"numbers", numbers}, {"separate", separate}, {"alike", alike}, {"own", own}, {"places", places}};
  std::printf("%-10s %5s %-9s %8s %9s %8s %8s\n", "function", "runs", "way", "error", "coverage", "score",
              "seconds");
  for (const Case& one : cases)
    for (const int runs_per_level : {6, 12})
      for (const Way& way : ways) {
        const Result r = result_of(way, one, runs_per_level * one.levels);
        std::printf("%-10s %5d %-9s %8.4f %9.3f %8.3f %8.3f\n", one.name, runs_per_level * one.levels,
                    way.name, r.error, r.coverage, r.score, r.seconds);
        std::fflush(stdout);
      }
  std::printf("\nlevels with runs: share of 95 %% intervals at one without that hold the truth\n");
  for (const int levels : {2, 3, 5, 9}) std::printf("%d %.3f\n", levels, coverage_without_runs(levels));
}
