// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/engine/geometry/mass_properties.hpp>
#include <drawpoint/engine/granular/pile.hpp>
#include <drawpoint/engine/granular/rock_shapes.hpp>

namespace drawpoint::engine::granular {

RockLibrary::RockLibrary(double density, int material) : density_(density), material_(material) {}

engine::RockBody RockLibrary::body(const RockSpec& spec) const {
  for (const auto& [known, body] : made_)
    if (known.shape == spec.shape && known.size == spec.size) return body;
  const auto polyhedron = rock_shapes().at(spec.shape).scaled(spec.size);
  const auto properties = engine::mass_properties(polyhedron, density_);
  made_.push_back({spec,
                   {std::make_shared<const engine::Shape>(polyhedron), properties.mass,
                    properties.inertia.diagonal(), material_}});
  return made_.back().second;
}

namespace {

// Places of a layer: as many as fit between the walls.
std::vector<Eigen::Vector2d> rectangle_places(const EmitterOptions& o) {
  std::vector<Eigen::Vector2d> places;
  const Eigen::Array2i n = (2 * o.half_lengths.array() / o.spacing).cast<int>().max(1);
  for (int i = 0; i < n.x(); ++i)
    for (int j = 0; j < n.y(); ++j)
      places.emplace_back(o.top.head<2>() +
                          o.spacing * Eigen::Vector2d(i - 0.5 * (n.x() - 1), j - 0.5 * (n.y() - 1)));
  return places;
}

// A square grid within the radius.
std::vector<Eigen::Vector2d> disc_places(const EmitterOptions& o) {
  std::vector<Eigen::Vector2d> places;
  const int reach = static_cast<int>(o.radius / o.spacing) + 1;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j) {
      const Eigen::Vector2d offset(i * o.spacing, j * o.spacing);
      if (offset.norm() <= o.radius) places.emplace_back(o.top.head<2>() + offset);
    }
  return places;
}

std::vector<Eigen::Vector2d> layer_places(const EmitterOptions& o) {
  return o.half_lengths.minCoeff() > 0 ? rectangle_places(o) : disc_places(o);
}

double radius_of(const engine::RockBody& body) {
  return std::get<engine::ConvexPolyhedron>(*body.shape).radius();
}

// Least height of a sphere's centre over the floor and over the spheres about all rocks.
double height_over(const engine::World& world, const Eigen::Vector2d& place, double radius) {
  double z = radius;
  for (const engine::Rock& rock : world.rocks()) {
    if (!rock.present) continue;
    const double reach = radius + radius_of(rock.body),
                 apart = (rock.pose.translation().head<2>() - place).norm();
    if (apart < reach)
      z = std::max(z, rock.pose.translation().z() + std::sqrt(reach * reach - apart * apart));
  }
  return z;
}

}  // namespace

Emitter::Emitter(const EmitterOptions& options, double density, std::uint64_t seed,
                 const SizeDistribution& sizes)
    : options_(options),
      places_(layer_places(options)),
      turns_(seed),
      sampler_(seed, density, sizes),
      next_(sampler_.next()) {}

std::vector<int> Emitter::emit(engine::World& world, const RockLibrary& library, std::vector<RockSpec>& specs,
                               double mass) {
  std::vector<int> born;
  if (mass <= 0 || world.time() < due_) return born;
  due_ = world.time() + options_.interval;
  for (const Eigen::Vector2d& place : places_) {
    if (mass <= 0) break;
    const RockSpec spec{next_.shape, next_.length};
    const engine::RockBody body = library.body(spec);
    const double z = height_over(world, place, radius_of(body)) + options_.clearance;
    if (z > options_.top.z()) continue;
    Eigen::Isometry3d pose(turns_.rotation());
    pose.translation() << place, z;
    born.push_back(world.add_rock(body, pose));
    specs.resize(world.rocks().size());
    specs.back() = spec;
    mass -= body.mass;
    next_ = sampler_.next();
  }
  return born;
}

bool RestWatch::at_rest(const engine::World& world) {
  const double h = world.options().step, mass = present_mass(world);
  elapsed_ += h;
  const bool calm = mass == 0 || (world.kinetic_energy() / mass < options_.mean_energy &&
                                  world.fastest_rock() < options_.fastest);
  calm_ = calm ? calm_ + h : 0;
  timed_out_ = calm_ < options_.hold && elapsed_ >= options_.cap;
  return calm_ >= options_.hold || timed_out_;
}

double present_mass(const engine::World& world) {
  double sum = 0;
  for (const engine::Rock& rock : world.rocks())
    if (rock.present) sum += rock.body.mass;
  return sum;
}

}  // namespace drawpoint::engine::granular
