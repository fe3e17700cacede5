// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/engine/world/scene.h>

#include <drawpoint/engine/world/checks.h>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

constexpr int body_of_surroundings = 0;  // all of them are one body
constexpr int no_family = 0, fixed_family = 1, machine_family = 2;
constexpr int detached = -2;          // index of a part's surface whose machine was detached
constexpr int rocks_per_block = 128;  // that a thread takes at a time

Collider rock_collider(const RockBody& body, int rock) {
  return {body.shape, rock + 1, no_family, true, Eigen::Isometry3d::Identity()};
}

}  // namespace

Scene::Scene(const WorldOptions& options, const MaterialTable& materials,
             std::shared_ptr<const ThreadPool> pool)
    : options_(options), materials_(materials), pool_(std::move(pool)), finder_(options.contacts, pool_) {
  kinds_.fill(std::vector<bool>(static_cast<std::size_t>(materials.kinds())));
}

// Rocks touch everything, fixed surfaces and parts not their own kind.
void Scene::check_materials(const char* place, const SurfaceOwner& owner, int kind) const {
  for (const Owner other : {Owner::fixed, Owner::rock, Owner::part}) {
    if (other == owner.owner && other != Owner::rock) continue;
    const std::vector<bool>& kinds = kinds_[static_cast<std::size_t>(other)];
    for (int k = 0; k < static_cast<int>(kinds.size()); ++k)
      if ((kinds[k] || (owner.owner == other && k == kind)) && !materials_.given(k, kind))
        throw std::invalid_argument(
            std::string("engine::") + place + ": a surface of kind " + std::to_string(kind) +
            " can touch one of kind " + std::to_string(k) +
            ", but the materials say nothing about the two; give them by MaterialTable::set(" +
            std::to_string(k) + ", " + std::to_string(kind) + ", ...)");
  }
}

int Scene::add_surface(const char* place, const Surface& surface, const Collider& collider,
                       const Eigen::Isometry3d& pose) {
  check_materials(place, surface, surface.material);
  const int id = finder_.add(collider, pose);
  if (id >= static_cast<int>(surfaces_.size())) surfaces_.resize(id + 1);
  surfaces_[id] = surface;
  kinds_[static_cast<std::size_t>(surface.owner)][surface.material] = true;
  joined_surfaces_ += surface.owner != Owner::rock;
  return id;
}

int Scene::add_rock(const RockBody& body, const Eigen::Isometry3d& pose, const Vector3d& velocity,
                    const Vector3d& angular_velocity) {
  check(body, materials_.kinds());
  check_pose("World::add_rock", pose);
  check_velocity("World::add_rock", velocity, angular_velocity);
  const int index = static_cast<int>(rocks_.size());
  const int id =
      add_surface("World::add_rock", {{Owner::rock, index}, body.material, radius_about_origin(*body.shape)},
                  rock_collider(body, index), pose);
  rocks_.push_back({body, pose, velocity, angular_velocity, true, id});
  present_.push_back(index);
  extra_reach_.add(*body.shape);
  return index;
}

const Rock& Scene::rock(int rock, const char* place) const {
  if (rock < 0 || rock >= static_cast<int>(rocks_.size()))
    throw std::invalid_argument(std::string("engine::World::") + place + ": there is no rock " +
                                std::to_string(rock) + "; there are " + std::to_string(rocks_.size()));
  return rocks_[rock];
}

const Rock& Scene::present_rock(int rock, const char* place) const {
  if (!this->rock(rock, place).present)
    throw std::invalid_argument(std::string("engine::World::") + place + ": rock " + std::to_string(rock) +
                                " was removed; look at Rock::present first");
  return rocks_[rock];
}

Rock& Scene::present_rock(int rock, const char* place) {
  std::as_const(*this).present_rock(rock, place);
  return rocks_[rock];
}

void Scene::remove_rock(int rock) {
  finder_.remove(rocks_[rock].collider);
  rocks_[rock].present = false;
  std::erase(present_, rock);
}

void Scene::attach(ArticulatedBody* machine) {
  for (std::size_t id = 0; id < surfaces_.size(); ++id) {
    Surface& surface = surfaces_[id];
    if (surface.owner != Owner::part) continue;
    if (machine && surface.index < machine->parts()) continue;
    if (machine)
      throw std::invalid_argument("engine::World::attach: the machine has " +
                                  std::to_string(machine->parts()) + " parts, but part " +
                                  std::to_string(surface.index) + " has a shape; detach with nullptr first");
    finder_.remove(static_cast<int>(id));
    surface = {{Owner::fixed, detached}, 0};
    surroundings_.add(static_cast<std::uint64_t>(id));
  }
  if (!machine) extra_reach_.forget_parts();
  machine_ = machine;
}

int Scene::add_static(std::shared_ptr<const Shape> shape, const Eigen::Isometry3d& pose, int material) {
  check_pose("World::add_static", pose);
  check_material("World::add_static", material, materials_.kinds());
  const Shape* added = shape.get();
  const int id = add_surface(
      "World::add_static", {{Owner::fixed, -1}, material},
      {std::move(shape), body_of_surroundings, fixed_family, false, Eigen::Isometry3d::Identity()}, pose);
  hash_surface(id, *added, pose);
  return id;
}

void Scene::add_part_shape(int part, std::shared_ptr<const Shape> shape, const Eigen::Isometry3d& X_PS,
                           int material) {
  const int parts = machine_ ? machine_->parts() : 0;
  if (part < 0 || part >= parts)
    throw std::invalid_argument("engine::World::add_part_shape: there is no part " + std::to_string(part) +
                                "; the attached machine has " + std::to_string(parts));
  check_pose("World::add_part_shape", X_PS);
  check_material("World::add_part_shape", material, materials_.kinds());
  if (!shape || std::holds_alternative<HalfSpace>(*shape))
    throw std::invalid_argument("engine::World::add_part_shape: part " + std::to_string(part) +
                                " has no shape or a half-space; give a polyhedron or a cylinder");
  const Shape* added = shape.get();
  const double radius = radius_about_origin(*shape) + X_PS.translation().norm();
  const int id = add_surface("World::add_part_shape", {{Owner::part, part}, material, radius},
                             {std::move(shape), machine_part(part), machine_family, true, X_PS},
                             machine_->part_pose(part));
  extra_reach_.add_part(part, *added, radius);
  hash_surface(id, *added, X_PS);
}

void Scene::hash_surface(int id, const Shape& shape, const Eigen::Isometry3d& pose) {
  const Surface& surface = surfaces_[id];
  for (int x : {id, static_cast<int>(surface.owner), surface.index, surface.material})
    surroundings_.add(static_cast<std::uint64_t>(x));
  add(surroundings_, shape);
  surroundings_.add(pose.linear());
  surroundings_.add(pose.translation());
}

const SuperBody* Scene::linearise(double h) {
  prescribed_.reset();
  if (!machine_) return nullptr;
  prescribed_ = machine_->prescribed();
  super_ = machine_->linearise(h, options_.gravity);
  return prescribed_ ? nullptr : &super_;
}

Vector3d Scene::origin_of(const Surface& surface) const {
  if (surface.owner == Owner::rock) return rocks_[surface.index].pose.translation();
  return surface.owner == Owner::part ? super_.origins[surface.index] : Vector3d(Vector3d::Zero());
}

SurfaceOwner Scene::owner(int collider) const {
  const SurfaceOwner& owner = surface(collider);
  return owner.owner == Owner::fixed ? SurfaceOwner{Owner::fixed, collider} : owner;
}

// A part that contacts move is taken to keep its velocity at the start of the step, whatever its motors do.
RigidMotion Scene::motion_of(const Surface& surface) const {
  if (surface.owner == Owner::part) {
    if (prescribed_) return prescribed_->rigid;
    const SpatialVector V = super_.part_maps[surface.index] * super_.velocity_before;
    return {super_.origins[surface.index], V.tail<3>(), V.head<3>(), Vector3d::Zero()};
  }
  if (surface.owner == Owner::fixed) return {};
  const Rock& rock = rocks_[surface.index];
  return {rock.pose.translation(), rock.velocity, rock.angular_velocity, options_.gravity};
}

Vector3d Scene::part_acceleration(int part, const Vector3d& position, double h) const {
  if (prescribed_) return prescribed_->acceleration_at(position);
  const SpatialVector A = super_.part_maps[part] * (super_.velocity - super_.velocity_before) / h;
  return A.tail<3>() + Vector3d(A.head<3>()).cross(position - super_.origins[part]);
}

// How far beyond the margin a surface may go in a step: a pair closes by no more than the sum of its
// speculative margins and the margin, so no contact is missed at any speed that it has or gets
// (extra_reach.h). In whole steps of constants::speculative_step.
double Scene::speculative_margin_of(const Surface& surface, double h) const {
  constexpr double resolution = constants::speculative_step;
  const double fall = h * options_.gravity.norm();
  double speed = 0;
  if (surface.owner == Owner::rock) {
    const Rock& rock = rocks_[surface.index];
    speed = rock.velocity.norm() + rock.angular_velocity.norm() * surface.radius + fall;
  } else if (surface.owner == Owner::part) {
    const RigidMotion motion = motion_of(surface);
    const double gain =
        prescribed_
            ? h * (motion.acceleration.norm() + surface.radius * prescribed_->angular_acceleration.norm())
            : fall;
    speed = motion.velocity.norm() + motion.angular_velocity.norm() * surface.radius + gain;
  }
  const double way = h * speed + extra_reach_of(surface);
  return resolution * std::ceil(std::max(0.0, way - 0.5 * options_.contacts.margin) / resolution);
}

void Scene::place_colliders(double h) {
  moves_.resize(present_.size());
  pool_->blocks(static_cast<int>(present_.size()), rocks_per_block, [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      const Rock& rock = rocks_[present_[k]];
      moves_[k] = {rock.collider, rock.pose, speculative_margin_of(surfaces_[rock.collider], h)};
    }
  });
  for (std::size_t id = 0; id < surfaces_.size(); ++id)
    if (surfaces_[id].owner == Owner::part)
      moves_.push_back({static_cast<int>(id), machine_->part_pose(surfaces_[id].index),
                        speculative_margin_of(surfaces_[id], h)});
  finder_.move(moves_);
}

const std::vector<Manifold>& Scene::find_contacts(double h) {
  place_colliders(h);
  return finder_.find();
}

Eigen::Isometry3d Scene::shape_pose(int collider) const {
  const Surface& surface = this->surface(collider);
  if (surface.owner == Owner::rock) return rocks_[surface.index].pose;
  if (surface.owner == Owner::part)
    return machine_->part_pose(surface.index) * finder_.collider(collider).X_BC;
  return finder_.shape_pose(collider);
}

std::optional<RayHit> Scene::cast_ray(const Ray& ray, double most) const {
  std::optional<RayHit> first;
  for (int id = 0; id < static_cast<int>(surfaces_.size()); ++id) {
    const Surface& surface = surfaces_[id];
    if (surface.owner == Owner::rock && !rocks_[surface.index].present) continue;
    if (surface.owner == Owner::fixed && surface.index == detached) continue;
    const Eigen::Isometry3d X_WS = shape_pose(id);
    if (surface.owner == Owner::rock) {  // most rocks are passed by
      const Vector3d to_centre = X_WS.translation() - ray.origin;
      const double along = to_centre.dot(ray.direction);
      if (to_centre.squaredNorm() - along * along > surface.radius * surface.radius) continue;
    }
    const std::optional<RayEntry> entry = intersect(ray, *finder_.collider(id).shape, X_WS, most);
    if (!entry) continue;
    most = entry->distance;
    first = RayHit{owner(id), entry->distance, ray.origin + entry->distance * ray.direction, entry->normal};
  }
  return first;
}

ContactFinder Scene::finder_for(const std::vector<Rock>& rocks) const {
  ContactFinder finder(options_.contacts, pool_);
  for (std::size_t id = 0; id < surfaces_.size(); ++id) {
    const Surface& surface = surfaces_[id];
    const bool rock = surface.owner == Owner::rock;
    const bool gone =
        rock ? !rocks[surface.index].present : surface.owner == Owner::fixed && surface.index == detached;
    if (rock)  // where it is now: a tree of boxes that all stand at the origin takes long
      finder.add(rock_collider(rocks[surface.index].body, surface.index), rocks_[surface.index].pose);
    else if (gone)
      finder.add({std::make_shared<const Shape>(box(Eigen::Vector3d::Ones()))});
    else
      finder.add(finder_.collider(static_cast<int>(id)));
    if (gone) finder.remove(static_cast<int>(id));
  }
  return finder;
}

void Scene::replace(std::vector<Rock> rocks, ContactFinder finder) {
  finder_ = std::move(finder);
  rocks_ = std::move(rocks);
  present_.clear();
  for (std::size_t k = 0; k < rocks_.size(); ++k)
    if (rocks_[k].present) present_.push_back(static_cast<int>(k));
}

}  // namespace drawpoint::engine::detail
