// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_findings.h>
#include <drawpoint/studies/loading/loading_front_findings.h>
#include <drawpoint/studies/loading/loading_run_findings.h>
#include <drawpoint/studies/loading/loading_surfaces.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::studies {
namespace {

using namespace of_loading;
using Eigen::Index;
using Eigen::VectorXd;

Finding f1(const LoadingSurfaces& surfaces) {
  return decided("F1", "Production rises with the wanted fill to an optimum at alpha 0.9 to 1.4",
                 surfaces.ridge(production, alpha, 0.9, 1.4));
}

/// Mean of a variable over the tenth of the points with most of a response, less its mean.
double best_tenth_shift(const LoadingSurface& s, Index r, Index v) {
  const VectorXd y = s.y(r), x = s.x(v);
  if (!(deviation_of(y) > 0)) return std::nan("");
  std::vector<Index> order(static_cast<std::size_t>(y.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) { return y[i] > y[j]; });
  order.resize(order.size() / 10);
  return x(order).mean() - x.mean();
}

Finding f3(const LoadingSurfaces& surfaces) {
  const auto shift = [](Index v, double sign) {
    return [=](const LoadingSurface& s) { return sign * best_tenth_shift(s, production, v); };
  };
  return decided("F3", "The highest production has high beta, high gamma and low kappa",
                 {surfaces.criterion("beta in the best tenth over its mean", {production}, shift(beta, 1)),
                  surfaces.criterion("gamma over its mean", {production}, shift(gamma, 1)),
                  surfaces.criterion("kappa under its mean", {production}, shift(kappa, -1))});
}

Finding f4(const LoadingSurfaces& surfaces) {
  return decided(
      "F4", "Alpha dominates production, then beta, kappa and gamma; gamma comes last in all responses",
      {surfaces.explains_more(production, alpha, beta), surfaces.explains_more(production, beta, kappa),
       surfaces.explains_more(production, kappa, gamma), surfaces.explains_more(damage, kappa, gamma),
       surfaces.explains_more(spill, kappa, gamma)});
}

Finding f5(const LoadingSurfaces& surfaces) {
  std::vector<Criterion> criteria = {surfaces.explains_more(damage, beta, alpha),
                                     surfaces.explains_more(damage, alpha, kappa)};
  for (const Criterion& side : surfaces.ridge(damage, alpha, 0.75, 1.25)) criteria.push_back(side);
  return decided("F5", "Joint damage: beta first, alpha second; a ridge at alpha of about 1", criteria);
}

Finding f6(const LoadingSurfaces& surfaces) {
  return decided("F6", "Joint damage is largest for kappa of about 0.4",
                 surfaces.ridge(damage, kappa, 0.25, 0.55));
}

Finding f7(const LoadingSurfaces& surfaces) {
  const auto correlation = [](Index v) {
    return [v](const LoadingSurface& s) { return rank_correlation(s.y(spill), s.x(v)).value; };
  };
  return decided(
      "F7", "Spill grows with alpha and beta",
      {surfaces.criterion("rank correlation with alpha", {spill}, correlation(alpha), small_correlation),
       surfaces.criterion("with beta", {spill}, correlation(beta), small_correlation)});
}

/// Share of the points in the lowest third of kappa where spill is in its highest quarter, less that of the
/// highest third.
double share_of_most_spill(const LoadingSurface& s) {
  VectorXd much = s.y(spill);
  if (!(deviation_of(much) > 0)) return std::nan("");
  VectorXd sorted = much;
  std::sort(sorted.begin(), sorted.end());
  const double least = sorted[(3 * sorted.size()) / 4];
  for (double& y : much) y = y >= least ? 1 : 0;
  const Eigen::Vector3d shares = means_of_thirds(s.x(kappa), much, s.lower(kappa), s.upper(kappa));
  return shares[0] - shares[2];
}

Finding f8(const LoadingSurfaces& surfaces) {
  return decided(
      "F8", "The largest spill decreases as kappa increases",
      {surfaces.criterion("share of the quarter with most spill, lowest less highest third of kappa", {spill},
                          share_of_most_spill, small_correlation)});
}

Finding f9(const LoadingSurfaces& surfaces) {
  std::vector<Criterion> criteria;
  for (const auto& [r, name] : {std::pair{production, "production"}, {damage, "damage"}, {spill, "spill"}})
    criteria.push_back(surfaces.criterion(
        std::string(name) + ": a fifth of alpha's range less gamma's, in standard deviations", {r},
        [r = r](const LoadingSurface& s) {
          return 0.2 * s.profile_range(r, alpha) - s.profile_range(r, gamma);
        }));
  return decided("F9", "Gamma is weak everywhere: its profile has less than a fifth of alpha's range",
                 criteria);
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

std::vector<Finding> loading_findings(const StudyResults& results) {
  require_loading(results);
  const LoadingSurfaces all = draw_surfaces(results);
  const FrontFindings front = front_findings(all);
  const RunFindings runs = run_findings(results);
  return {f1(all), front.f2,  f3(all),   f4(all),   f5(all),   f6(all),  f7(all),  f8(all),
          f9(all), front.f10, front.f11, front.f12, front.f13, runs.f14, runs.f15, runs.f16};
}

}  // namespace drawpoint::studies
