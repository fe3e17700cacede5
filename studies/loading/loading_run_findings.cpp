// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_run_findings.h>
#include <drawpoint/studies/loading/loading_surfaces.h>
#include <drawpoint/studies/loading/statistics/finding_statistics.h>
#include <drawpoint/engine/loading/log/run_measures.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::studies {
namespace {

using namespace of_loading;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double lower(const doe::Problem& problem, Index v) {
  return problem.variables[static_cast<std::size_t>(v)].lower;
}
double upper(const doe::Problem& problem, Index v) {
  return problem.variables[static_cast<std::size_t>(v)].upper;
}

// Thresholds: the source has 0.06, and 0.16 and 0.17; 0.10 is their geometric middle, 0.27 as far above. Without a
// standard error an NRMSE of n errors is off by 1/√(2n) of itself.
Finding f15(const StudyResults& results) {
  std::vector<Estimate> e(3);
  const double n = static_cast<double>(results.X_new.rows());
  for (std::size_t r = 0; r < 3 && results.X_new.rows() >= least_group && results.nrmse.size() >= 3; ++r)
    e[r] = {results.nrmse[r],
            r < results.nrmse_error.size() ? results.nrmse_error[r] : results.nrmse[r] / std::sqrt(2 * n)};
  return decided("F15", "The surrogate of production is good, those of damage and spill are moderate",
                 {{"0.10 less error of the mean of production", difference({0.10}, e[production])},
                  {"0.27 less error of the mean of damage", difference({0.27}, e[damage])},
                  {"0.27 less error of the mean of spill", difference({0.27}, e[spill])},
                  {"error of damage less that of production", difference(e[damage], e[production])},
                  {"of spill less that of production", difference(e[spill], e[production])}});
}

// Kolmogorov's distance times √n exceeds 1.63 in 1 % of uniform samples: in 4 % for one of four variables.
Criterion uniform(const doe::Problem& problem, const MatrixXd& X, const std::string& which) {
  Estimate margin;
  if (X.rows() >= 10) {
    margin.value = 1.63;
    for (Index v = 0; v < X.cols(); ++v)
      margin.value = std::min(margin.value,
                              1.63 - distance_from_uniform(X.col(v), lower(problem, v), upper(problem, v)));
  }
  return {which + ": 1.63 less the distance from uniform", margin};
}

/// The corners of the box among the training points, and the rows of all other points.
struct Corners {
  std::set<unsigned> found;  // bit v: at the upper end of variable v
  std::vector<Index> others;

  Corners(const doe::Problem& problem, const MatrixXd& X) {
    for (Index i = 0; i < X.rows(); ++i) {
      unsigned high = 0, low = 0;
      for (Index v = 0; v < X.cols(); ++v) {
        high |= static_cast<unsigned>(upper(problem, v) - X(i, v) < 1e-9) << v;
        low |= static_cast<unsigned>(X(i, v) - lower(problem, v) < 1e-9) << v;
      }
      if ((high | low) == (1u << X.cols()) - 1)
        found.insert(high);
      else
        others.push_back(i);
    }
  }
};

// The corners are forced, not drawn: half of them at each end of each variable. Uniform is what the other
// runs should be; fewer than ten of them leave it unclear. So does a plan of so few runs that corners would
// be more than two fifths of it, and that has none (run/plan.h).
Finding f16(const StudyResults& results) {
  const MatrixXd& X = results.X;
  const Corners corners(results.problem, X);
  const int all = 1 << X.cols();
  Estimate margin;
  if (!corners.found.empty() || 2 * X.rows() >= 5 * all)
    margin.value = static_cast<double>(corners.found.size()) - all + 0.5;
  return decided(
      "F16", "Training points cover the box near-uniformly with its corners, validation points are uniform",
      {uniform(results.problem, X(corners.others, Eigen::all), "training without corners"),
       {"corners found, of " + std::to_string(all) + ", less all but a half", margin},
       uniform(results.problem, results.X_new, "validation")});
}

/// What the logs say of tracking, of those that can be used.
struct Tracking {
  std::vector<double> error, depth, beta_of;
  int unusable = 0;
  std::string reason;  // why the first cannot be used

  void add(const std::filesystem::path& file, double beta_of_run) {
    try {
      const auto log = engine::loading::read_log(file, engine::loading::LogContent::without_scene);
      const double of_run = engine::loading::tracking_error(log);
      double sum = 0;
      for (const auto& cycle : log.cycles) sum += cycle.plan.depth;
      if (!std::isfinite(of_run + sum))
        throw std::runtime_error(file.string() + ": tracking error or planned depth is not a number");
      error.push_back(of_run);
      depth.push_back(sum / static_cast<double>(log.cycles.size()));
      beta_of.push_back(beta_of_run);
    } catch (const std::exception& e) {
      if (unusable++ == 0) reason = e.what();
    }
  }
};

Finding f14(const StudyResults& results) {
  Tracking tracking;
  for (std::size_t i = 0; i < results.logs.size(); ++i)
    if (!results.logs[i].empty()) tracking.add(results.logs[i], results.X(static_cast<Index>(i), beta));
  const std::size_t n = tracking.error.size();
  const auto vector = [&](const std::vector<double>& v) {
    return VectorXd(Eigen::Map<const VectorXd>(v.data(), static_cast<Index>(n)));
  };
  Finding finding =
      tracking_finding(vector(tracking.error), vector(tracking.depth), vector(tracking.beta_of));
  if (tracking.unusable > 0)
    finding.grounds += "; " + std::to_string(tracking.unusable) + " of " +
                       std::to_string(n + static_cast<std::size_t>(tracking.unusable)) +
                       " logs could not be used, the first: " + tracking.reason;
  return finding;
}

}  // namespace

Finding tracking_finding(const VectorXd& error, const VectorXd& depth, const VectorXd& beta_of) {
  return decided(
      "F14", "High and shallow plans are tracked well, low and deep plans badly",
      {{"rank correlation of tracking error and planned depth", rank_correlation(error, depth),
        small_correlation},
       {"of tracking error and lowness, -beta", rank_correlation(error, -beta_of), small_correlation}});
}

RunFindings run_findings(const StudyResults& results) { return {f14(results), f15(results), f16(results)}; }

}  // namespace drawpoint::studies
