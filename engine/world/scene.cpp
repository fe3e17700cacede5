// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/world/world.hpp>
#include <drawpoint/engine/world/checks.h>
#include <drawpoint/engine/world/state_hash.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine {
namespace {

using Eigen::Vector3d;

constexpr int world_body = 0;  // fixed surroundings are one body
constexpr int no_family = 0, fixed_family = 1, machine_family = 2;

}  // namespace

int World::add_surface(const Surface& surface, const Collider& collider) {
  const int id = finder_.add(collider);
  if (id >= static_cast<int>(surfaces_.size())) surfaces_.resize(id + 1, {Owner::fixed, -1, 0});
  surfaces_[id] = surface;
  return id;
}

Collider World::rock_collider(const RockBody& body, int rock) {
  return {body.shape, rock + 1, body.material, no_family, true, Eigen::Isometry3d::Identity()};
}

int World::add_rock(const RockBody& body, const Eigen::Isometry3d& pose, const Vector3d& velocity,
                    const Vector3d& angular_velocity) {
  detail::check(body, materials_.kinds());
  detail::check_pose("World::add_rock", pose);
  detail::check_velocity("World::add_rock", velocity, angular_velocity);
  const int index = static_cast<int>(rocks_.size());
  const int id = add_surface({Owner::rock, index, body.material, detail::reach_about_origin(*body.shape)},
                             rock_collider(body, index));
  rocks_.push_back({body, pose, velocity, angular_velocity, true, id});
  finder_.set_pose(id, pose);
  freezing_.add(index, rocks_.back());
  return index;
}

int World::checked(int rock, const char* place) const {
  if (rock < 0 || rock >= static_cast<int>(rocks_.size()))
    throw std::invalid_argument(std::string("engine::World::") + place + ": there is no rock " +
                                std::to_string(rock) + "; there are " + std::to_string(rocks_.size()));
  if (!rocks_[rock].present)
    throw std::invalid_argument(std::string("engine::World::") + place + ": rock " + std::to_string(rock) +
                                " was removed; look at Rock::present first");
  return rock;
}

void World::remove_rock(int rock) {
  Rock& r = rocks_[checked(rock, "remove_rock")];
  const std::vector<int> neighbours = freezing_.remove(rock);
  finder_.remove(r.collider);
  r.present = false;
  thaw(neighbours);
}

void World::set_rock_velocity(int rock, const Vector3d& velocity, const Vector3d& angular_velocity) {
  Rock& r = rocks_[checked(rock, "set_rock_velocity")];
  detail::check_velocity("World::set_rock_velocity", velocity, angular_velocity);
  if (frozen(rock)) thaw({rock});
  r.velocity = velocity;
  r.angular_velocity = angular_velocity;
}

void World::attach(ArticulatedBody* machine) {
  for (std::size_t id = 0; id < surfaces_.size(); ++id) {
    Surface& surface = surfaces_[id];
    if (surface.owner != Owner::part) continue;
    if (machine && surface.index < machine->parts()) continue;
    if (machine)
      throw std::invalid_argument("engine::World::attach: the machine has " +
                                  std::to_string(machine->parts()) + " parts, but part " +
                                  std::to_string(surface.index) + " has a shape; detach with nullptr first");
    finder_.remove(static_cast<int>(id));
    surface = {Owner::fixed, detached, 0};
    surfaces_mark_.add(static_cast<std::uint64_t>(id));
  }
  machine_ = machine;
}

int World::add_static(std::shared_ptr<const Shape> shape, const Eigen::Isometry3d& pose, int material) {
  detail::check_pose("World::add_static", pose);
  detail::check_material("World::add_static", material, materials_.kinds());
  const Shape* added = shape.get();
  const int id = add_surface(
      {Owner::fixed, -1, material},
      {std::move(shape), world_body, material, fixed_family, false, Eigen::Isometry3d::Identity()});
  finder_.set_pose(id, pose);
  mark_surface(id, *added, pose);
  return id;
}

void World::add_part_shape(int part, std::shared_ptr<const Shape> shape, const Eigen::Isometry3d& X_PS,
                           int material) {
  const int parts = machine_ ? machine_->parts() : 0;
  if (part < 0 || part >= parts)
    throw std::invalid_argument("engine::World::add_part_shape: there is no part " + std::to_string(part) +
                                "; the attached machine has " + std::to_string(parts));
  detail::check_pose("World::add_part_shape", X_PS);
  detail::check_material("World::add_part_shape", material, materials_.kinds());
  if (!shape || std::holds_alternative<HalfSpace>(*shape))
    throw std::invalid_argument("engine::World::add_part_shape: part " + std::to_string(part) +
                                " has no shape or a half-space; give a polyhedron or a cylinder");
  const Shape* added = shape.get();
  const double radius = detail::reach_about_origin(*shape) + X_PS.translation().norm();
  const int id = add_surface({Owner::part, part, material, radius},
                             {std::move(shape), machine_part(part), material, machine_family, true, X_PS});
  finder_.set_pose(id, machine_->part_pose(part));
  mark_surface(id, *added, X_PS);
}

void World::mark_surface(int id, const Shape& shape, const Eigen::Isometry3d& pose) {
  const Surface& surface = surfaces_[id];
  for (int x : {id, static_cast<int>(surface.owner), surface.index, surface.material})
    surfaces_mark_.add(static_cast<std::uint64_t>(x));
  add(surfaces_mark_, shape);
  surfaces_mark_.add(pose.linear());
  surfaces_mark_.add(pose.translation());
}

}  // namespace drawpoint::engine
