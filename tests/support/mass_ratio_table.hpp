// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/tests/support/pile_measures.hpp>

/// A heavy cube on four light ones, as plain data: the scene that shows what a mass ratio does to a solver.
///
/// A cube with an edge of 2 m stands on four cubes with an edge of 0.2 m, and these on the floor z = 0. Their
/// centres are at x, y = ±0.8 m, 0.1 m inside the top's edges, so that no two edges coincide. The small cubes
/// have a density of 4500 kg/m³, the top has `ratio` times the mass of one of them (equal density at 1000).
/// All start at rest and just touch. A rigid table stays: overlap 0, mean height of the five centres (4 · 0.1
/// + 1.2)/5 = 0.32 m. Compliance lets it sink: at 1000:1 and k = 1e9 N/m each leg carries 89 kN at either
/// end, 0.09 mm or 0.045 % of its edge. World frame: z up, SI units. Source: the mass-ratio tables of ETH's
/// SimBenchmark and of engine forums; overlap alone does not show it, as a table whose legs have slipped out
/// has none.
namespace drawpoint::support {

struct MassRatioTable {
  struct Cube {
    double half;     ///< of the edge [m]
    double mass;     ///< [kg]
    double inertia;  ///< about any axis [kg m²]
    Vector3d start;  ///< of the centre [m]
  };
  static constexpr double small_edge = 0.2, large_edge = 2.0;     ///< [m]
  static constexpr double expected_height = (4 * 0.1 + 1.2) / 5;  ///< mean over the centres [m]
  static constexpr double duration = 3;                           ///< [s]

  std::array<Cube, 5> cubes;  ///< four legs, then the top
};

/// ratio: mass of the top over that of a leg, > 0. Throws std::invalid_argument otherwise.
inline MassRatioTable mass_ratio_table(double ratio) {
  if (!(ratio > 0) || !std::isfinite(ratio))
    throw std::invalid_argument("mass_ratio_table: the mass ratio is " + std::to_string(ratio) +
                                "; allowed: above 0; 1 to 1000 are usual");
  constexpr double small = MassRatioTable::small_edge, large = MassRatioTable::large_edge, inset = 0.1;
  const auto cube = [](double edge, double mass, const Vector3d& start) {
    return MassRatioTable::Cube{edge / 2, mass, mass * edge * edge / 6, start};
  };
  const double mass = 4500 * small * small * small, at = large / 2 - small / 2 - inset;
  return {{cube(small, mass, {at, at, small / 2}), cube(small, mass, {-at, at, small / 2}),
           cube(small, mass, {at, -at, small / 2}), cube(small, mass, {-at, -at, small / 2}),
           cube(large, ratio * mass, {0, 0, small + large / 2})}};
}

/// The largest overlap over all pairs of cubes and of cubes with the floor, as a fraction of the small edge.
inline double table_overlap(const MassRatioTable& table, const std::array<Eigen::Isometry3d, 5>& poses) {
  std::vector<PlacedHull> placed;
  for (std::size_t k = 0; k < poses.size(); ++k)
    placed.emplace_back(engine::box(Vector3d::Constant(table.cubes[k].half)), poses[k]);
  double deepest = 0;
  for (std::size_t a = 0; a < placed.size(); ++a) {
    for (const Vector3d& p : placed[a].world.vertices()) deepest = std::max(deepest, -p.z());
    for (std::size_t b = a + 1; b < placed.size(); ++b)
      deepest = std::max(deepest, penetration_depth(placed[a], placed[b]));
  }
  return deepest / MassRatioTable::small_edge;
}

/// Mean height of the five centres [m].
inline double table_height(const std::array<Eigen::Isometry3d, 5>& poses) {
  double sum = 0;
  for (const Eigen::Isometry3d& pose : poses) sum += pose.translation().z();
  return sum / static_cast<double>(poses.size());
}

}  // namespace drawpoint::support
