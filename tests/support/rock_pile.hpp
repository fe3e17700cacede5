// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/engine/geometry/mass_properties.hpp>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/engine/granular/size_distribution.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

/// The pile on which contact engines are compared, as plain data: any engine can build it.
///
/// A box 7 m x 6 m of half-spaces (floor z = 0, four walls, no lid), N blasted rocks of the six shapes with
/// the sizes of table 3, and a kinematic blade 3 m wide that stands in the box from the start and is later
/// dragged along +x at 1.5 m/s. Procedure: put every rock at its start pose at rest, all at once; let the
/// pile settle for 5 s; measure at rest for 2 s; move the blade for 1 s.
///
/// Start poses: rocks come in the order of the size sampler, turned at random. Each is placed inside a sphere
/// about its centre of mass; of 64 random places the lowest is taken at which the sphere lies clear of all
/// others and of the blade. So no two rocks overlap, however they are turned. 3000 rocks reach to 8 m at
/// first, and collapse into a pile 1.9 m deep. They weigh 203 t: table 3 and these shapes give 68 kg per
/// rock.
///
/// World frame: z up, origin in the middle of the floor. Rock frames: origin at the centre of mass, principal
/// axes. SI units. Same number and seed, same scene, bit for bit. Cost: about 0.2 s for 3000 rocks.
namespace drawpoint::support {

/// One of the (at most 24) different rocks: a shape at a size.
struct PileHull {
  engine::ConvexPolyhedron hull;  ///< vertices in the rock's frame [m]
  double mass;                    ///< [kg]
  Eigen::Vector3d inertia;        ///< principal moments [kg m²]
};

struct PileRock {
  int hull;                 ///< index into RockPile::hulls
  Eigen::Isometry3d start;  ///< pose at t = 0, at rest
};

/// Solid where normal·x ≤ offset; the normal points into the box.
struct PileWall {
  Eigen::Vector3d normal;
  double offset;
};

/// One for all: rock on rock, wall and blade. Engines without a term leave it out and say so.
struct PileMaterial {
  double friction = 0.9;    ///< Coulomb μ
  double restitution = 0;   ///< e
  double rolling = 0.1;     ///< μ_r: moment ≤ μ_r R* × normal force (the most that blasted ore may have)
  double spinning = 0;      ///< μ_s, the same about the normal
  double stiffness = 1e8;   ///< k of a pair of bodies [N/m] (the engine's rock-on-rock value)
  double damping_time = 0;  ///< [s]; 0: the least that the method allows
};

/// A vertical plate that follows a given motion whatever it meets. Its lower edge is 20 mm above the floor:
/// too low for a rock to pass, high enough to leave the floor alone.
struct PileBlade {
  Eigen::Vector3d half = {0.05, 1.5, 1.0};    ///< half extents: 0.1 m thick, 3 m wide, 2 m high [m]
  Eigen::Vector3d start = {-2.0, 0.0, 1.02};  ///< of its centre [m]
  double speed = 1.5;                         ///< along +x while it digs [m/s]

  /// Centre after digging for t ≥ 0 [s].
  Eigen::Vector3d centre(double t) const { return start + Eigen::Vector3d(speed * t, 0, 0); }
};

struct RockPile {
  static constexpr double length = 7, width = 6;                         ///< of the box, along x and y [m]
  static constexpr double settle_time = 5, rest_time = 2, dig_time = 1;  ///< of the procedure [s]
  static constexpr double density = 4500;                                ///< [kg/m³]
  static constexpr double gravity = 9.81;                                ///< along -z [m/s²]

  PileMaterial material;
  PileBlade blade;
  std::vector<PileWall> walls;  ///< floor first
  std::vector<PileHull> hulls;
  std::vector<PileRock> rocks;

  const PileHull& hull_of(int rock) const { return hulls[rocks[rock].hull]; }
  double mass() const {
    double sum = 0;
    for (const PileRock& rock : rocks) sum += hulls[rock.hull].mass;
    return sum;
  }
};

namespace detail {

/// Spheres laid down from above, each where it comes to lie lowest among random places.
class SphereLayers {
 public:
  SphereLayers(const RockPile& pile, engine::CounterRandom& random) : blade_(pile.blade), random_(random) {
    columns_.resize(columns_x * columns_y);
  }

  Eigen::Vector3d place(double radius) {
    constexpr int tries = 64;
    Eigen::Vector3d best(0, 0, std::numeric_limits<double>::infinity());
    for (int k = 0; k < tries; ++k) {
      const double x = (random_.uniform() - 0.5) * (RockPile::length - 2 * radius),
                   y = (random_.uniform() - 0.5) * (RockPile::width - 2 * radius);
      if (over_blade(x, y, radius)) continue;
      const double z = rest_height(x, y, radius);
      if (z < best.z()) best = {x, y, z};
    }
    if (!std::isfinite(best.z())) return place(radius);  // all tries over the blade: a chance below 1e-20
    columns_[column(best.x(), best.y())].push_back({best, radius});
    return best;
  }

 private:
  struct Sphere {
    Eigen::Vector3d centre;
    double radius;
  };
  static constexpr int columns_x = 7, columns_y = 6;  // 1 m wide, more than any two radii

  static int cell(double at, double extent, int cells) {
    return std::clamp(static_cast<int>((at / extent + 0.5) * cells), 0, cells - 1);
  }
  static int column(double x, double y) {
    return cell(x, RockPile::length, columns_x) * columns_y + cell(y, RockPile::width, columns_y);
  }

  bool over_blade(double x, double y, double radius) const {
    return std::abs(x - blade_.start.x()) < blade_.half.x() + radius &&
           std::abs(y - blade_.start.y()) < blade_.half.y() + radius;
  }

  double rest_height(double x, double y, double radius) const {
    double z = radius;
    const int i = cell(x, RockPile::length, columns_x), j = cell(y, RockPile::width, columns_y);
    for (int m = std::max(0, i - 1); m <= std::min(columns_x - 1, i + 1); ++m)
      for (int n = std::max(0, j - 1); n <= std::min(columns_y - 1, j + 1); ++n)
        for (const Sphere& s : columns_[m * columns_y + n]) {
          const double reach = radius + s.radius, dx = x - s.centre.x(), dy = y - s.centre.y();
          const double square = reach * reach - dx * dx - dy * dy;
          if (square > 0) z = std::max(z, s.centre.z() + std::sqrt(square));
        }
    return z;
  }

  PileBlade blade_;
  engine::CounterRandom& random_;
  std::vector<std::vector<Sphere>> columns_;
};

inline int hull_index(RockPile& pile, std::array<int, 24>& known, const engine::granular::RockDraw& draw) {
  int& index = known[draw.shape * 4 + draw.size];
  if (index < 0) {
    index = static_cast<int>(pile.hulls.size());
    const auto hull = engine::granular::rock_shapes()[draw.shape].scaled(draw.length);
    const auto properties = engine::mass_properties(hull, RockPile::density);
    pile.hulls.push_back({hull, properties.mass, properties.inertia.diagonal()});
  }
  return index;
}

}  // namespace detail

/// The scene with `rocks` rocks, 1 to 100 000. Throws std::invalid_argument for another number.
inline RockPile rock_pile(int rocks, std::uint64_t seed = 1, const PileMaterial& material = {}) {
  if (rocks < 1 || rocks > 100'000)
    throw std::invalid_argument("rock_pile: the number of rocks is " + std::to_string(rocks) +
                                "; allowed: 1 to 100000; 500 to 3000 are usual");
  RockPile pile;
  pile.material = material;
  const Eigen::Vector3d X = Eigen::Vector3d::UnitX(), Y = Eigen::Vector3d::UnitY();
  pile.walls = {{Eigen::Vector3d::UnitZ(), 0},
                {X, -RockPile::length / 2},
                {-X, -RockPile::length / 2},
                {Y, -RockPile::width / 2},
                {-Y, -RockPile::width / 2}};
  engine::granular::RockSampler sampler(seed, RockPile::density);
  engine::CounterRandom random(seed ^ 0x70696c65);  // apart from the sampler's own stream
  detail::SphereLayers layers(pile, random);
  std::array<int, 24> known;
  known.fill(-1);
  for (int k = 0; k < rocks; ++k) {
    constexpr double clearance = 1e-3;  // [m], between the spheres of two rocks
    const int hull = detail::hull_index(pile, known, sampler.next());
    Eigen::Isometry3d start(random.rotation());
    start.translation() = layers.place(pile.hulls[hull].hull.radius() + clearance / 2);
    pile.rocks.push_back({hull, start});
  }
  return pile;
}

}  // namespace drawpoint::support
