// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// success_table: how well is it decided where runs fail, by the model of success, by the nearest run and by the
/// share of failures? Twenty designs per region. `success_table FOLDER` also writes each case as CSV, for
/// benchmarks/peers/toolkit/success_peers.py, which has scikit-learn decide them.

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/success_model.hpp>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace drawpoint;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int designs = 20, places = 500;

/// On the unit box; `chance` of success.
struct Region {
  const char* name;
  int inputs, runs;
  double (*chance)(const VectorXd& x);
};

double certain(bool fails) { return fails ? 0.0 : 1.0; }

constexpr std::array regions = {
    Region{"edge", 4, 50, [](const VectorXd& x) { return certain(x[0] + x[1] >= 1.4); }},
    Region{"corner", 4, 50, [](const VectorXd& x) { return certain(x[0] > 0.6 && x[1] > 0.6); }},
    Region{"ball", 3, 60, [](const VectorXd& x) { return certain((x.array() - 0.5).matrix().norm() < 0.4); }},
    Region{"anywhere", 4, 50, [](const VectorXd&) { return 0.9; }},
    Region{"blurred edge", 4, 60,
           [](const VectorXd& x) { return 1.0 / (1.0 + std::exp(15.0 * (x[0] - 0.7))); }},
    Region{"two of seven", 7, 80, [](const VectorXd& x) { return certain(x[0] * x[1] > 0.45); }},
    Region{"few runs", 4, 20, [](const VectorXd& x) { return certain(x[0] > 0.75); }},
    Region{"rare", 4, 100, [](const VectorXd& x) { return certain(x[0] > 0.8 && x[1] > 0.75); }}};

struct Case {
  MatrixXd X, Z;
  std::vector<bool> succeeded;
  VectorXd chance;  // at Z

  Case(const Region& region, int design) {
    doe::RandomStream random(static_cast<doe::Seed>(77 * design));
    const auto points = [&](int count) {
      MatrixXd U(count, region.inputs);
      for (int i = 0; i < count; ++i)
        for (int k = 0; k < region.inputs; ++k) U(i, k) = random.uniform();
      return U;
    };
    X = points(region.runs);
    for (Eigen::Index i = 0; i < X.rows(); ++i)
      succeeded.push_back(random.uniform() < region.chance(X.row(i).transpose()));
    Z = points(places);
    chance.resize(places);
    for (Eigen::Index i = 0; i < places; ++i) chance[i] = region.chance(Z.row(i).transpose());
  }
};

/// Mean over places of ln P of what a run does, and of wrong decisions.
struct Score {
  double log = 0, wrong = 0;

  void add(const VectorXd& P, const VectorXd& chance) {
    for (Eigen::Index i = 0; i < P.size(); ++i) {
      const double p = std::min(std::max(P[i], 1e-9), 1.0 - 1e-9), q = chance[i];
      log += (q * std::log(p) + (1.0 - q) * std::log(1.0 - p)) / (designs * places);
      wrong += (P[i] >= 0.5 ? 1.0 - q : q) / (designs * places);
    }
  }
};

VectorXd by_nearest(const Case& c) {
  VectorXd P(c.Z.rows());
  for (Eigen::Index i = 0; i < P.size(); ++i) {
    Eigen::Index nearest = 0;
    (c.X.rowwise() - c.Z.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
    P[i] = c.succeeded[static_cast<std::size_t>(nearest)] ? 1.0 : 0.0;
  }
  return P;
}

void write(const Case& c, const std::filesystem::path& file) {
  std::ofstream out(file);
  const auto row = [&](const Eigen::RowVectorXd& x, double last) {
    for (const double value : x) out << doe::detail::number_text(value) << ',';
    out << doe::detail::number_text(last) << '\n';
  };
  for (Eigen::Index i = 0; i < c.X.rows(); ++i)
    row(c.X.row(i),
        c.succeeded[static_cast<std::size_t>(i)] ? 2.0 : -2.0);  // runs: 2 and -2; places: the chance
  for (Eigen::Index i = 0; i < c.Z.rows(); ++i) row(c.Z.row(i), c.chance[i]);
  if (!out.flush()) throw std::runtime_error(file.string() + " could not be written");
}

void print(const Region& region, const std::string& folder) {
  Score model, nearest, share;
  double seconds = 0, failed = 0;
  for (int design = 1; design <= designs; ++design) {
    const Case c(region, design);
    const auto begin = std::chrono::steady_clock::now();
    const kriging::SuccessModel fitted = kriging::fit_success(
        c.X, c.succeeded, {VectorXd::Zero(region.inputs), VectorXd::Ones(region.inputs)});
    model.add(fitted.probability(c.Z), c.chance);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / designs;
    nearest.add(by_nearest(c), c.chance);
    const double failures = static_cast<double>(fitted.failures());
    failed += failures / designs;
    share.add(VectorXd::Constant(places, 1.0 - (failures + 1.0) / (region.runs + 2.0)), c.chance);
    if (!folder.empty())
      write(c, std::filesystem::path(folder) /
                   (std::string(region.name) + "_" + std::to_string(design) + ".csv"));
  }
  std::printf("%-13s %6d %5d %6.1f | %7.3f %7.3f | %6.3f %7.3f %6.3f | %7.3f\n", region.name, region.inputs,
              region.runs, failed, model.log, share.log, model.wrong, nearest.wrong, share.wrong, seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string folder = argc > 1 ? argv[1] : "";
    if (!folder.empty()) std::filesystem::create_directories(folder);
    std::printf(
        "mean over %d designs, %d places each: log score (higher is better); share of wrong decisions\n",
        designs, places);
    std::printf("%-13s %6s %5s %6s | %7s %7s | %6s %7s %6s | %7s\n", "region", "inputs", "runs", "failed",
                "model", "share", "model", "nearest", "share", "seconds");
    for (const Region& region : regions) print(region, folder);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "success_table: %s\n", e.what());
    return 1;
  }
}
