// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading_findings.h>
#include <drawpoint/studies/loading_front_findings.h>
#include <drawpoint/studies/loading_runs.h>
#include <drawpoint/engine/loading/log/run_measures.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::studies {
namespace {

using namespace of_loading;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double everything = std::numeric_limits<double>::infinity();

Finding f1(const LoadingRuns& runs) {
  return decided("F1", "Production rises with the wanted fill to an optimum at alpha 0.9 to 1.4",
                 runs.ridge(production, alpha, 0.9, 1.4));
}

// A mean of m of n runs drawn by chance scatters by s/√m √(1 − m/n).
Estimate best_decile_shift(const LoadingRuns& runs, Index v, double sign) {
  const Index n = runs.runs(), m = (n + 9) / 10;
  if (m < 4) return {};
  std::vector<Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), Index{0});
  const VectorXd p = runs.y(production), x = runs.x(v);
  std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) { return p[i] > p[j]; });
  order.resize(static_cast<std::size_t>(m));
  const double s = std::sqrt((x.array() - x.mean()).square().sum() / static_cast<double>(n - 1));
  return {
      sign * (x(order).mean() - x.mean()),
      s * std::sqrt((1.0 / static_cast<double>(m)) * (1 - static_cast<double>(m) / static_cast<double>(n)))};
}

Finding f3(const LoadingRuns& runs) {
  return decided("F3", "The highest production has high beta, high gamma and low kappa",
                 {{"beta in the best tenth over its mean", best_decile_shift(runs, beta, 1)},
                  {"gamma over its mean", best_decile_shift(runs, gamma, 1)},
                  {"kappa under its mean", best_decile_shift(runs, kappa, -1)}});
}

Finding f4(const LoadingRuns& runs) {
  return decided("F4",
                 "Alpha dominates production, then beta, kappa and gamma; gamma comes last in all responses",
                 {runs.explains_more(production, alpha, beta), runs.explains_more(production, beta, kappa),
                  runs.explains_more(production, kappa, gamma), runs.explains_more(damage, kappa, gamma),
                  runs.explains_more(spill, kappa, gamma)});
}

Finding f5(const LoadingRuns& runs) {
  std::vector<Criterion> criteria = {runs.explains_more(damage, beta, alpha),
                                     runs.explains_more(damage, alpha, kappa)};
  for (const Criterion& side : runs.ridge(damage, alpha, 0.75, 1.25)) criteria.push_back(side);
  return decided("F5", "Joint damage: beta first, alpha second; a ridge at alpha of about 1", criteria);
}

Finding f6(const LoadingRuns& runs) {
  return decided("F6", "Joint damage is largest for kappa of about 0.4",
                 runs.ridge(damage, kappa, 0.25, 0.55));
}

Finding f7(const LoadingRuns& runs) {
  return decided(
      "F7", "Spill grows with alpha and beta",
      {{"rank correlation with alpha", rank_correlation(runs.y(spill), runs.x(alpha)), small_correlation},
       {"with beta", rank_correlation(runs.y(spill), runs.x(beta)), small_correlation}});
}

Finding f8(const LoadingRuns& runs) {
  const VectorXd all = runs.y(spill), low = runs.within(spill, kappa, -everything, runs.third(kappa, 1)),
                 high = runs.within(spill, kappa, runs.third(kappa, 2), everything);
  Estimate effect;
  if (all.size() > 0) {
    VectorXd sorted = all;
    std::sort(sorted.data(), sorted.data() + sorted.size());
    const double much = sorted[(3 * sorted.size()) / 4];
    effect =
        share_difference(static_cast<int>((low.array() >= much).count()), static_cast<int>(low.size()),
                         static_cast<int>((high.array() >= much).count()), static_cast<int>(high.size()));
  }
  return decided("F8", "The largest spill decreases as kappa increases",
                 {{"share of the quarter with most spill, lowest less highest third of kappa", effect,
                   small_correlation}});
}

Estimate profile_of(const LoadingRuns& runs, Index v, Index r) {
  return profile_range(runs.x(v), runs.y(r), runs.lower(v), runs.upper(v));
}

// Where alpha itself shows nothing, there is nothing to be weaker than.
Finding f9(const LoadingRuns& runs) {
  std::vector<Criterion> criteria;
  for (const auto& [r, name] : {std::pair{production, "production"}, {damage, "damage"}, {spill, "spill"}}) {
    const Estimate a = profile_of(runs, alpha, r), g = profile_of(runs, gamma, r);
    Estimate margin;
    if (a.value > 2 * a.error)
      margin = {0.2 - g.value / a.value, std::hypot(g.error, a.error * g.value / a.value) / a.value};
    criteria.push_back({std::string(name) + ": 0.2 less gamma's range over alpha's", margin});
  }
  return decided("F9", "Gamma is weak everywhere: its profile has less than a fifth of alpha's range",
                 criteria);
}

// Thresholds: the source has 0.06, and 0.16 and 0.17; 0.10 is their geometric middle, 0.27 as far above. An
// NRMSE of n errors is off by 1/√(2n) of itself.
Finding f15(const StudyResults& results) {
  std::vector<Estimate> e(3);
  const double n = static_cast<double>(results.X_new.rows());
  for (std::size_t r = 0; r < 3 && results.X_new.rows() >= least_group && results.nrmse.size() >= 3; ++r)
    e[r] = {results.nrmse[r], results.nrmse[r] / std::sqrt(2 * n)};
  return decided("F15", "The surrogate of production is good, those of damage and spill are moderate",
                 {{"0.10 less NRMSE of production", difference({0.10}, e[production])},
                  {"0.27 less NRMSE of damage", difference({0.27}, e[damage])},
                  {"0.27 less NRMSE of spill", difference({0.27}, e[spill])},
                  {"NRMSE of damage less that of production", difference(e[damage], e[production])},
                  {"of spill less that of production", difference(e[spill], e[production])}});
}

// Kolmogorov's distance times √n exceeds 1.63 in 1 % of uniform samples: in 4 % for one of four variables.
Criterion uniform(const LoadingRuns& runs, const MatrixXd& X, const std::string& which) {
  Estimate margin;
  if (X.rows() >= 10) {
    margin.value = 1.63;
    for (Index v = 0; v < X.cols(); ++v)
      margin.value =
          std::min(margin.value, 1.63 - distance_from_uniform(X.col(v), runs.lower(v), runs.upper(v)));
  }
  return {which + ": 1.63 less the distance from uniform", margin};
}

/// The corners of the box among the training points, and the rows of all other points.
struct Corners {
  std::set<unsigned> found;  // bit v: at the upper end of variable v
  std::vector<Index> others;

  explicit Corners(const LoadingRuns& runs) {
    const MatrixXd& X = runs.results().X;
    for (Index i = 0; i < X.rows(); ++i) {
      unsigned upper = 0, lower = 0;
      for (Index v = 0; v < X.cols(); ++v) {
        upper |= static_cast<unsigned>(runs.upper(v) - X(i, v) < 1e-9) << v;
        lower |= static_cast<unsigned>(X(i, v) - runs.lower(v) < 1e-9) << v;
      }
      if ((upper | lower) == (1u << X.cols()) - 1)
        found.insert(upper);
      else
        others.push_back(i);
    }
  }
};

// The corners are forced, not drawn: half of them at each end of each variable. Uniform is what the other
// runs should be; fewer than ten of them leave it unclear. So does a plan of so few runs that corners would
// be more than two fifths of it, and that has none (runs/plan.h).
Finding f16(const LoadingRuns& runs) {
  const MatrixXd& X = runs.results().X;
  const Corners corners(runs);
  const int all = 1 << X.cols();
  Estimate margin;
  if (!corners.found.empty() || 2 * X.rows() >= 5 * all)
    margin.value = static_cast<double>(corners.found.size()) - all + 0.5;
  return decided(
      "F16", "Training points cover the box near-uniformly with its corners, validation points are uniform",
      {uniform(runs, X(corners.others, Eigen::all), "training without corners"),
       {"corners found, of " + std::to_string(all) + ", less all but a half", margin},
       uniform(runs, runs.results().X_new, "validation")});
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

Finding f14(const LoadingRuns& runs) {
  const StudyResults& results = runs.results();
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

/// Standard errors may come after the three responses.
void require_loading(const StudyResults& results) {
  if (results.problem.variables.size() != 4 || results.problem.responses.size() < 3)
    throw std::invalid_argument(
        "studies::loading_findings: " + std::to_string(results.problem.variables.size()) + " variables and " +
        std::to_string(results.problem.responses.size()) +
        " responses; the loading study has 4 (alpha, beta, gamma, kappa) and 3, with their standard errors "
        "6");
}

}  // namespace

Finding tracking_finding(const VectorXd& error, const VectorXd& depth, const VectorXd& beta_of) {
  return decided(
      "F14", "High and shallow plans are tracked well, low and deep plans badly",
      {{"rank correlation of tracking error and planned depth", rank_correlation(error, depth),
        small_correlation},
       {"of tracking error and lowness, -beta", rank_correlation(error, -beta_of), small_correlation}});
}

std::vector<Finding> loading_findings(const StudyResults& results) {
  require_loading(results);
  const LoadingRuns runs(results);
  const FrontFindings front = front_findings(runs);
  return {f1(runs), front.f2,  f3(runs),  f4(runs),  f5(runs),  f6(runs),  f7(runs),     f8(runs),
          f9(runs), front.f10, front.f11, front.f12, front.f13, f14(runs), f15(results), f16(runs)};
}

}  // namespace drawpoint::studies
