// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_front_findings.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace drawpoint::studies {
namespace {

using namespace of_loading;
using Eigen::Index;
using Eigen::VectorXd;

/// Where too few points are to be had a draw says nothing.
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr Index least_points = 5;
const std::vector<Index> all_responses = {production, damage, spill};

double share_above(const VectorXd& x, double limit) { return (x.array() > limit).cast<double>().mean(); }

// Where alpha does not matter, a point of the front lies above 1.5 as often as one of the box does.
double spared(const LoadingSurface& s) {
  const VectorXd front = s.front_x(alpha);
  return front.size() < least_points ? nothing : share_above(s.x(alpha), 1.5) - share_above(front, 1.5);
}

Finding f2(const LoadingSurfaces& surfaces) {
  constexpr double end = std::numeric_limits<double>::infinity(), chance = 0.5 / 1.8;
  return decided(
      "F2", "Beyond alpha 1.2 production falls, and fewer Pareto points than by chance have alpha above 1.5",
      {surfaces.criterion(
           "production at 0.9 to 1.3 over that above 1.5, in standard deviations", {production},
           [](const LoadingSurface& s) {
             return s.level(production, alpha, 0.9, 1.3) - s.level(production, alpha, 1.5, end);
           },
           small_difference),
       surfaces.criterion("share of the box above 1.5 less that of the front", all_responses, spared,
                          chance / 2)});
}

Finding f10(const LoadingSurfaces& surfaces) {
  const auto correlation = [](Index a, Index b) {
    return [=](const LoadingSurface& s) { return rank_correlation(s.front_y(a), s.front_y(b)).value; };
  };
  return decided("F10", "On the front production competes with damage and with spill, which rise together",
                 {surfaces.criterion("rank correlation of production and damage", all_responses,
                                     correlation(production, damage), small_correlation),
                  surfaces.criterion("of production and spill", all_responses, correlation(production, spill),
                                     small_correlation),
                  surfaces.criterion("of damage and spill", all_responses, correlation(damage, spill),
                                     small_correlation)});
}

/// Points that are low in both, in the lowest third of the box in damage and in that of spill, by alpha: in its
/// lowest third, and beyond.
struct LowCorner {
  double low = 0, rest = 0, low_corner = 0, rest_corner = 0;

  explicit LowCorner(const LoadingSurface& s) {
    const VectorXd a = s.x(alpha), d = s.y(damage), m = s.y(spill);
    const double most_damage = threshold(d), most_spill = threshold(m);
    for (Index i = 0; i < a.size(); ++i) {
      const bool corner = d[i] <= most_damage && m[i] <= most_spill, is_low = a[i] < s.third(alpha, 1);
      (is_low ? low : rest) += 1;
      (is_low ? low_corner : rest_corner) += corner;
    }
  }
  static double threshold(VectorXd y) {
    std::sort(y.begin(), y.end());
    return y[y.size() / 3];
  }
  double all() const { return low_corner + rest_corner; }
};

// Sure: points of low alpha are low more often; only: most that are low have it.
Finding f11(const LoadingSurfaces& surfaces) {
  return decided("F11", "Low alpha is the only sure way to minimal damage and spill",
                 {surfaces.criterion(
                      "share of points low in both, lowest third of alpha less the rest", {damage, spill},
                      [](const LoadingSurface& s) {
                        const LowCorner c(s);
                        return c.low_corner / c.low - c.rest_corner / c.rest;
                      },
                      small_correlation),
                  surfaces.criterion("share of these with alpha in its lowest third less a half",
                                     {damage, spill}, [](const LoadingSurface& s) {
                                       const LowCorner c(s);
                                       return c.all() < least_points ? nothing : c.low_corner / c.all() - 0.5;
                                     })});
}

/// Among the points of the front with high beta and less production than half of them, the share of low alpha.
double low_alpha_share(const LoadingSurface& s) {
  const VectorXd a = s.front_x(alpha), b = s.front_x(beta), p = s.front_y(production);
  VectorXd sorted = p;
  std::sort(sorted.begin(), sorted.end());
  double found = 0, low = 0;
  for (Index i = 0; i < p.size(); ++i)
    if (b[i] > s.third(beta, 2) && p[i] < sorted[p.size() / 2]) {
      ++found;
      low += a[i] < s.third(alpha, 1);
    }
  return found < least_points ? nothing : low / found;
}

// By chance a third of them has alpha in its lowest third.
Finding f12(const LoadingSurfaces& surfaces) {
  return decided(
      "F12", "Pareto points of high beta and low production exist, with low alpha more often than by chance",
      {surfaces.criterion(
          "share of these in the lowest third of alpha less 1/3", all_responses,
          [](const LoadingSurface& s) { return low_alpha_share(s) - 1.0 / 3; }, 1.0 / 3)});
}

// A front that rises all the way leaves no residual; a millionth stands for it.
double roughness(const LoadingSurface& s, Index r) {
  const VectorXd p = s.front_y(production);
  return p.size() < 2 * least_points ? nothing : std::log(std::max(rising_residual(p, s.front_y(r)), 1e-6));
}

Finding f13(const LoadingSurfaces& surfaces) {
  return decided("F13", "The production-spill front is smoother than the production-damage front",
                 {surfaces.criterion(
                     "logarithm of damage's over spill's residual from a rising fit", all_responses,
                     [](const LoadingSurface& s) { return roughness(s, damage) - roughness(s, spill); })});
}

}  // namespace

FrontFindings front_findings(const LoadingSurfaces& surfaces) {
  return {f2(surfaces), f10(surfaces), f11(surfaces), f12(surfaces), f13(surfaces)};
}

}  // namespace drawpoint::studies
