// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <drawpoint/tests/support/exact_contact.hpp>
#include <drawpoint/tests/support/rock_pile.hpp>
#include <numeric>

/// How truly an engine holds the pile of rock_pile.hpp, from rock poses and velocities alone: one code for
/// all engines, none of their contact finding in it.
///
/// Overlap of two rocks: their penetration depth, the least translation that parts them, by the separating
/// axis theorem over all face normals and all edge pairs of the true hulls, divided by the longest dimension
/// of the smaller rock. Pairs deeper than 10 µm touch; mean and percentiles are over these: pairs that touch by less
/// carry next to nothing, and would only thin the percentiles out. Drift: distance between a rock's centres at two
/// times over the time between. Kinetic energy: translation and rotation, per rock. SI units, world frame. Cost: about
/// 0.1 ms per touching pair, 0.5 s for 3000 settled rocks.
namespace drawpoint::support {

/// A rock's motion as an engine reports it: centre of mass, principal axes; velocities in world axes.
struct RockState {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Vector3d velocity = Vector3d::Zero(), angular_velocity = Vector3d::Zero();
};

/// A polyhedron in the world, made ready for many separating-axis tests.
struct PlacedHull {
  PlacedHull(const ConvexPolyhedron& hull, const Eigen::Isometry3d& pose)
      : world(hull.transformed(pose)), edges(edges_of(world)), centre(pose.translation()) {}

  ConvexPolyhedron world;
  std::vector<std::pair<Vector3d, Vector3d>> edges;
  Vector3d centre;
};

/// Penetration depth [m], 0 when apart: -best_separation(a, b), left at the first axis that parts them.
inline double penetration_depth(const PlacedHull& a, const PlacedHull& b) {
  double best = -std::numeric_limits<double>::infinity();
  for (const Vector3d& n : a.world.face_normals()) {
    best = std::max(best, separation_along(a.world, b.world, n));
    if (best >= 0) return 0;
  }
  for (const Vector3d& n : b.world.face_normals()) {
    best = std::max(best, separation_along(a.world, b.world, -n));
    if (best >= 0) return 0;
  }
  for (const auto& [p, q] : a.edges)
    for (const auto& [r, s] : b.edges) {
      const Vector3d n = (q - p).normalized().cross((s - r).normalized());
      if (n.norm() <= 1e-7) continue;  // parallel: their plane's normals are among the faces'
      best = std::max(best, separation_either_way(a.world, b.world, n.normalized()));
      if (best >= 0) return 0;
    }
  return -best;
}

constexpr double touching_depth = 1e-5;  ///< [m]

/// Over touching pairs; fractions of the smaller rock's longest dimension. Zeros when nothing touches.
struct OverlapStatistics {
  int pairs = 0;
  double max = 0, p99 = 0, mean = 0;
};

/// p99 is the nearest-rank percentile: the least value that 99 % of the values do not exceed.
inline OverlapStatistics overlap_statistics(std::vector<double> overlaps) {
  if (overlaps.empty()) return {};
  std::sort(overlaps.begin(), overlaps.end());
  const auto n = static_cast<double>(overlaps.size());
  return {static_cast<int>(overlaps.size()), overlaps.back(),
          overlaps[static_cast<std::size_t>(std::ceil(0.99 * n)) - 1],
          std::accumulate(overlaps.begin(), overlaps.end(), 0.0) / n};
}

namespace detail {

inline std::vector<PlacedHull> placed_hulls(const RockPile& pile, const std::vector<RockState>& states) {
  if (states.size() != pile.rocks.size())
    throw std::invalid_argument("pile measures: " + std::to_string(states.size()) + " states for " +
                                std::to_string(pile.rocks.size()) +
                                " rocks; give one per rock, in their order");
  std::vector<PlacedHull> placed;
  placed.reserve(states.size());
  for (std::size_t k = 0; k < states.size(); ++k)
    placed.emplace_back(pile.hulls[pile.rocks[k].hull].hull, states[k].pose);
  return placed;
}

}  // namespace detail

/// Rock on rock, over all pairs of the pile.
inline OverlapStatistics rock_overlaps(const RockPile& pile, const std::vector<RockState>& states) {
  const auto placed = detail::placed_hulls(pile, states);
  const auto hull = [&](int k) -> const ConvexPolyhedron& { return pile.hull_of(k).hull; };
  double widest = 0;
  for (const PileHull& h : pile.hulls) widest = std::max(widest, h.hull.radius());
  std::vector<int> by_x(placed.size());
  std::iota(by_x.begin(), by_x.end(), 0);
  std::sort(by_x.begin(), by_x.end(), [&](int a, int b) {
    return std::make_pair(placed[a].centre.x(), a) < std::make_pair(placed[b].centre.x(), b);
  });
  std::vector<double> overlaps;
  for (std::size_t i = 0; i < by_x.size(); ++i)
    for (std::size_t j = i + 1; j < by_x.size(); ++j) {
      const int a = by_x[i], b = by_x[j];
      const Vector3d apart = placed[b].centre - placed[a].centre;
      if (apart.x() > hull(a).radius() + widest) break;
      if (apart.norm() >= hull(a).radius() + hull(b).radius()) continue;
      const double depth = penetration_depth(placed[a], placed[b]);
      if (depth > touching_depth) overlaps.push_back(depth / std::min(hull(a).length(), hull(b).length()));
    }
  return overlap_statistics(std::move(overlaps));
}

/// Rock in wall or floor: the depth of the lowest vertex over the rock's longest dimension.
inline OverlapStatistics wall_overlaps(const RockPile& pile, const std::vector<RockState>& states) {
  std::vector<double> overlaps;
  for (const PileWall& wall : pile.walls)
    for (std::size_t k = 0; k < states.size(); ++k) {
      const ConvexPolyhedron& hull = pile.hull_of(static_cast<int>(k)).hull;
      double lowest = std::numeric_limits<double>::infinity();
      for (const Vector3d& p : hull.vertices())
        lowest = std::min(lowest, wall.normal.dot(states[k].pose * p) - wall.offset);
      if (lowest < -touching_depth) overlaps.push_back(-lowest / hull.length());
    }
  return overlap_statistics(std::move(overlaps));
}

/// Rock in blade, the blade's centre being where given.
inline OverlapStatistics blade_overlaps(const RockPile& pile, const std::vector<RockState>& states,
                                        const Vector3d& blade_centre) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = blade_centre;
  const PlacedHull blade(engine::box(pile.blade.half), pose);
  std::vector<double> overlaps;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const ConvexPolyhedron& hull = pile.hull_of(static_cast<int>(k)).hull;
    const Vector3d apart = (states[k].pose.translation() - blade_centre).cwiseAbs() - pile.blade.half;
    if (apart.maxCoeff() >= hull.radius()) continue;
    const double depth = penetration_depth(blade, {hull, states[k].pose});
    if (depth > touching_depth) overlaps.push_back(depth / hull.length());
  }
  return overlap_statistics(std::move(overlaps));
}

/// Speeds between two times [m/s].
struct Drift {
  double mean = 0, median = 0, p99 = 0, worst = 0;  ///< over rocks; p99: nearest rank, as of overlaps
};

/// seconds: between the two states, > 0.
inline Drift drift(const std::vector<RockState>& before, const std::vector<RockState>& after,
                   double seconds) {
  if (before.size() != after.size() || before.empty() || !(seconds > 0))
    throw std::invalid_argument("drift: needs as many rocks after (" + std::to_string(after.size()) +
                                ") as before (" + std::to_string(before.size()) +
                                "), at least one, and a time between them above 0 s");
  Drift d;
  std::vector<double> speeds;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const double speed = (after[k].pose.translation() - before[k].pose.translation()).norm() / seconds;
    d.mean += speed / static_cast<double>(before.size());
    d.worst = std::max(d.worst, speed);
    speeds.push_back(speed);
  }
  std::sort(speeds.begin(), speeds.end());
  d.median = speeds[speeds.size() / 2];
  d.p99 = speeds[static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(speeds.size()))) - 1];
  return d;
}

/// Mean kinetic energy per rock [J].
inline double kinetic_energy_per_rock(const RockPile& pile, const std::vector<RockState>& states) {
  double sum = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const PileHull& hull = pile.hull_of(static_cast<int>(k));
    const Vector3d w = states[k].pose.linear().transpose() * states[k].angular_velocity;
    sum += 0.5 * hull.mass * states[k].velocity.squaredNorm() + 0.5 * w.dot(hull.inertia.cwiseProduct(w));
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, states.size()));
}

/// Of the rocks' centres [m]: a pile that has lost rocks, or in which rocks have sunk into each other, is
/// low.
inline double mean_height(const std::vector<RockState>& states) {
  double sum = 0;
  for (const RockState& s : states) sum += s.pose.translation().z();
  return sum / static_cast<double>(std::max<std::size_t>(1, states.size()));
}

/// FNV-1a over the bits of all poses and velocities.
inline std::uint64_t state_hash(const std::vector<RockState>& states) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  const auto add = [&](const double* values, int count) {
    for (int k = 0; k < count; ++k) {
      const auto bits = std::bit_cast<std::uint64_t>(values[k]);
      for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (bits >> (8 * byte) & 0xff)) * 0x100000001b3ull;
    }
  };
  for (const RockState& s : states) {
    add(s.pose.matrix().data(), 16);
    add(s.velocity.data(), 3);
    add(s.angular_velocity.data(), 3);
  }
  return hash;
}

}  // namespace drawpoint::support
