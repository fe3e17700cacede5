// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// A world as bytes and back: World::save() and World::restore().

#include <drawpoint/engine/world/checks.h>
#include <drawpoint/engine/world/world_impl.h>
#include <drawpoint/engine/base/byte_stream.hpp>
#include <drawpoint/engine/base/hash.hpp>
#include <drawpoint/engine/world/state_hash.hpp>

#include <string>
#include <utility>

namespace drawpoint::engine {
namespace {

constexpr std::uint64_t state_mark = 0x376574617473'7044;  // "Dpstate7": the version is the last digit

void add(StateHash& hash, const WorldOptions& o) {
  hash.add(o.step);
  hash.add(o.gravity);
  for (int x :
       {static_cast<int>(o.solver.method), o.solver.substeps, o.solver.iterations, o.solver.iteration_budget})
    hash.add(static_cast<std::uint64_t>(x));
  hash.add(o.solver.tolerance);
  hash.add(o.warm_start);
  for (double x : {o.contacts.margin, o.contacts.slack, o.contacts.reuse_distance, o.contacts.reuse_angle,
                   o.contacts.hysteresis})
    hash.add(x);
  hash.add(static_cast<std::uint64_t>(o.contacts.narrow));
}

void add(StateHash& hash, const Material& m) {
  for (double x : {m.friction, m.rolling, m.stiffness, m.damping_time, m.spinning, m.restitution})
    hash.add(x);
  hash.add(static_cast<std::uint64_t>(m.law));
}

void add(StateHash& hash, const MaterialTable& table) {
  for (int a = 0; a < table.kinds(); ++a)
    for (int b = a; b < table.kinds(); ++b) add(hash, table.of(a, b));
}

// No step leaves a rock farther or faster than this; beyond, squares overflow in the next one.
void check_motion(const Rock& rock, const ByteReader& in) {
  if (rock.pose.translation().cwiseAbs().maxCoeff() > constants::farthest_restored)
    in.fail("holds a rock more than 1e9 m from the origin");
  if (rock.velocity.cwiseAbs().maxCoeff() > constants::fastest_solution ||
      rock.angular_velocity.cwiseAbs().maxCoeff() > 10 * constants::fastest_solution)
    in.fail("holds a rock faster than 1e4 m/s or 1e5 rad/s");
}

// What a state is of: a restore compares them one by one, so that it can say what differs.
struct SceneHashes {
  std::uint64_t options, materials, surroundings, rocks, machine;

  void save(ByteWriter& out) const {
    for (std::uint64_t x : {options, materials, surroundings, rocks, machine}) out.put(x);
  }
  static SceneHashes read(ByteReader& in) {
    SceneHashes hashes{};
    for (std::uint64_t* x :
         {&hashes.options, &hashes.materials, &hashes.surroundings, &hashes.rocks, &hashes.machine})
      in.get(*x);
    return hashes;
  }
  // Empty, or in what the scenes differ.
  std::string difference(const SceneHashes& other) const {
    if (options != other.options) return "other options (step, gravity, solver or contacts)";
    if (materials != other.materials) return "other materials";
    if (surroundings != other.surroundings) return "other fixed surroundings or machine parts";
    if (rocks != other.rocks) return "other rocks";
    if (machine != other.machine) return "another machine, or none";
    return {};
  }
};

SceneHashes hashes_of(const WorldOptions& world_options, const detail::Scene& scene) {
  StateHash options, materials, rocks;
  add(options, world_options);
  add(materials, scene.materials());
  for (const Rock& rock : scene.rocks()) {
    add(rocks, *rock.body.shape);
    rocks.add(rock.body.mass);
    rocks.add(rock.body.inertia);
    rocks.add(static_cast<std::uint64_t>(rock.body.material));
    rocks.add(static_cast<std::uint64_t>(rock.collider));
  }
  const std::uint64_t parts = scene.machine() ? 1 + static_cast<std::uint64_t>(scene.machine()->parts()) : 0;
  return {options.value(), materials.value(), scene.surroundings_hash(), rocks.value(), parts};
}

}  // namespace

void add(StateHash& hash, const Shape& shape) {
  hash.add(static_cast<std::uint64_t>(shape.index()));
  if (const auto* plane = std::get_if<HalfSpace>(&shape)) {
    hash.add(plane->normal);
    hash.add(plane->offset);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    hash.add(cylinder->radius);
    hash.add(cylinder->half_width);
  } else {
    const auto& polyhedron = std::get<ConvexPolyhedron>(shape);
    hash.add(static_cast<std::uint64_t>(polyhedron.faces().size()));
    for (const Eigen::Vector3d& vertex : polyhedron.vertices()) hash.add(vertex);
  }
}

std::uint64_t state_hash(const World& world) {
  StateHash hash;
  hash.add(world.time());
  for (const Rock& rock : world.rocks()) {
    hash.add(static_cast<std::uint64_t>(rock.present));
    if (!rock.present) continue;
    hash.add(rock.pose.linear());
    hash.add(rock.pose.translation());
    hash.add(rock.velocity);
    hash.add(rock.angular_velocity);
  }
  if (world.machine())
    for (double x : world.machine()->state()) hash.add(x);
  return hash.value();
}

std::vector<std::byte> World::save() const {
  ByteWriter out;
  out.put(state_mark);
  hashes_of(impl_->options, impl_->scene).save(out);
  out.put(impl_->time);
  out.put(impl_->last_step);
  out.put(static_cast<std::int64_t>(impl_->steps));
  out.put_count(rocks().size());
  for (const Rock& rock : rocks()) {
    out.put(rock.present);
    out.put(rock.pose);
    out.put(rock.velocity);
    out.put(rock.angular_velocity);
  }
  const std::vector<double> machine = this->machine() ? this->machine()->state() : std::vector<double>();
  out.put_count(machine.size());
  for (double x : machine) out.put(x);
  out.put(impl_->contacts.memory().save(impl_->scene.finder()));
  out.put(impl_->scene.finder().save());
  return out.take();
}

void World::restore(std::span<const std::byte> state) {
  ByteReader in(state);
  if (in.get<std::uint64_t>() != state_mark) in.fail("is none of a world, or of another version,");
  if (const std::string what = SceneHashes::read(in).difference(hashes_of(impl_->options, impl_->scene));
      !what.empty())
    throw std::runtime_error("engine::World::restore: the state is of " + what +
                             "; build the world by the same calls as the one that was saved");
  const auto time = in.get<double>();
  const auto last_step = in.get<double>();
  if (!(last_step >= 0 && last_step <= 0.1)) in.fail("holds a step outside 0 to 0.1 s");
  const auto steps = in.get<std::int64_t>();
  std::vector<Rock> rocks = impl_->scene.rocks();
  if (in.get_count(145) != rocks.size()) in.fail("holds another number of rocks");
  for (Rock& rock : rocks) {
    in.get(rock.present);
    in.get(rock.pose);
    in.get(rock.velocity);
    in.get(rock.angular_velocity);
    check_motion(rock, in);
  }
  std::vector<double> machine(in.get_count(sizeof(double)));
  for (double& x : machine) in.get(x);
  const std::span<const std::byte> pairs = in.get_bytes(in.get_count(1)),
                                   contacts = in.get_bytes(in.get_count(1));
  in.expect_end();
  ContactFinder finder = impl_->scene.finder_for(rocks);
  finder.restore(contacts);
  detail::PairMemory memory = detail::PairMemory::read(finder, pairs);
  ArticulatedBody* const attached = impl_->scene.machine();
  if (!attached && !machine.empty()) in.fail("holds a machine; there is none here:");
  if (attached) attached->set_state(machine);
  impl_->scene.replace(std::move(rocks), std::move(finder));
  impl_->contacts.memory() = std::move(memory);
  impl_->time = time;
  impl_->last_step = last_step;
  impl_->steps = static_cast<long>(steps);
}

}  // namespace drawpoint::engine
