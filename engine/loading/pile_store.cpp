// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawpoint/engine/loading/pile_store.hpp>
#include <drawpoint/engine/record/file.hpp>
#include <stdexcept>

namespace drawpoint::engine::loading {
namespace {

const record::FileKind pile_kind{"drawpoint settled pile", 2, 1};

void add_number(std::string& provenance, const std::string& name, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "=%.17g ", value);
  provenance += name + text;
}

// The machine's pairs are no part of it: it comes when the pile lies.
void add_material(std::string& provenance, const std::string& pair, const engine::Material& m) {
  add_number(provenance, pair + "_friction", m.friction);
  add_number(provenance, pair + "_rolling", m.rolling);
  add_number(provenance, pair + "_spinning", m.spinning);
  add_number(provenance, pair + "_stiffness", m.stiffness);
  add_number(provenance, pair + "_damping_time", m.damping_time);
  add_number(provenance, pair + "_restitution", m.restitution);
  add_number(provenance, pair + "_law", static_cast<int>(m.law));
}

// Files of before sizes could be chosen name none, and were poured with these.
void add_sizes(std::string& provenance, const granular::SizeDistribution& sizes) {
  if (sizes == granular::blasted_ore) return;
  for (const granular::SizeClass& size : sizes) {
    add_number(provenance, "size_length", size.length);
    add_number(provenance, "size_share", size.mass_share);
  }
}

// Files of before the shapes had a checksum name none, and have these.
void add_shapes(std::string& provenance) {
  constexpr std::uint64_t unnamed = 0x19b8448b9a203462u;
  const std::uint64_t shapes = granular::rock_shapes_checksum();
  if (shapes != unnamed) provenance += "shapes=" + std::to_string(shapes) + " ";
}

double pile_height(const engine::World& world) {
  double top = 0;
  for (const engine::Rock& rock : world.rocks())
    if (rock.present && rock.velocity.norm() < 0.5) top = std::max(top, rock.pose.translation().z());
  return top;
}

}  // namespace

std::string pile_provenance(const Scenario& s) {
  std::string provenance;
  const Drift& d = s.drift;
  add_number(provenance, "length", d.length);
  add_number(provenance, "width", d.width);
  add_number(provenance, "height", d.height);
  add_number(provenance, "raise_radius", d.raise_radius);
  add_number(provenance, "raise_widening", d.raise_widening);
  add_number(provenance, "raise_height", d.raise_height);
  add_number(provenance, "wall_roughness", d.wall_roughness);
  add_number(provenance, "mass", s.pile.mass);
  add_number(provenance, "density", s.pile.density);
  add_sizes(provenance, s.pile.sizes);
  add_shapes(provenance);
  add_number(provenance, "max_height", s.pile.max_height);
  provenance += "seed=" + std::to_string(s.pile.seed) + " ";
  const granular::EmitterOptions emitter = emitter_of(d);
  add_number(provenance, "release_radius", emitter.radius);
  add_number(provenance, "release_spacing", emitter.spacing);
  add_number(provenance, "release_clearance", emitter.clearance);
  add_number(provenance, "release_interval", emitter.interval);
  add_material(provenance, "rock_rock", s.materials.rock_rock);
  add_material(provenance, "rock_terrain", s.materials.rock_terrain);
  add_number(provenance, "step", s.world.step);
  provenance += "method=" + std::string(engine::to_string(s.world.solver.method)) + " ";
  add_number(provenance, "substeps", s.world.solver.substeps);
  add_number(provenance, "iterations", s.world.solver.iterations);
  add_number(provenance, "iteration_budget", s.world.solver.iteration_budget);
  add_number(provenance, "tolerance", s.pile.tolerance);
  add_number(provenance, "warm_start", s.world.warm_start);
  add_number(provenance, "gravity_x", s.world.gravity.x());
  add_number(provenance, "gravity_y", s.world.gravity.y());
  add_number(provenance, "gravity_z", s.world.gravity.z());
  add_number(provenance, "margin", s.world.contacts.margin);
  add_number(provenance, "slack", s.world.contacts.slack);
  add_number(provenance, "reuse_distance", s.world.contacts.reuse_distance);
  add_number(provenance, "reuse_angle", s.world.contacts.reuse_angle);
  add_number(provenance, "hysteresis", s.world.contacts.hysteresis);
  provenance += "narrow=" + std::string(engine::to_string(s.world.contacts.narrow)) + " ";
  add_number(provenance, "rest_speed", s.pile.rest.fastest);
  add_number(provenance, "rest_energy", s.pile.rest.mean_energy);
  add_number(provenance, "rest_hold", s.pile.rest.hold);
  add_number(provenance, "rest_cap", s.pile.rest.cap);
  return provenance;
}

SettledPile pour_pile(const Scenario& scenario, const std::function<void(double)>& progress,
                      const std::function<void(const engine::StepReport&)>& on_step) {
  check(scenario);
  engine::WorldOptions options = scenario.world;
  options.solver.tolerance = scenario.pile.tolerance;
  engine::World world(options, material_table(scenario.materials));
  add_drift(world, scenario.drift);
  const granular::RockLibrary library(scenario.pile.density, static_cast<int>(SurfaceKind::rock));
  granular::Emitter emitter(emitter_of(scenario.drift), scenario.pile.density, scenario.pile.seed,
                            scenario.pile.sizes);
  const auto step_world = [&] {
    const engine::StepReport report = world.step();
    if (on_step) on_step(report);
  };
  std::vector<granular::RockSpec> specs;
  double poured = 0;
  const int steps_per_second = std::max(1, static_cast<int>(std::lround(1 / world.options().step)));
  // A blocked raise gives no room for new rocks; then, or at the height limit, what lies there is the pile.
  double last_birth = 0;
  for (int step = 0; poured < scenario.pile.mass && world.time() - last_birth < granular::blocked_after;
       ++step) {
    if (pile_height(world) < scenario.pile.max_height)
      for (int rock : emitter.emit(world, library, specs, scenario.pile.mass - poured)) {
        poured += world.rocks()[rock].body.mass;
        last_birth = world.time();
      }
    step_world();
    if (progress && step % steps_per_second == 0) progress(std::min(1.0, poured / scenario.pile.mass));
  }
  granular::RestWatch watch(scenario.pile.rest);
  do step_world();
  while (!watch.at_rest(world));
  if (progress) progress(1.0);
  SettledPile pile{{}, world.time(), watch.timed_out(), pile_provenance(scenario)};
  for (std::size_t k = 0; k < specs.size(); ++k) pile.rocks.push_back({specs[k], world.rocks()[k].pose});
  return pile;
}

void write_pile(const std::filesystem::path& path, const SettledPile& pile, const Scenario& scenario) {
  std::vector<std::int32_t> shapes;
  std::vector<double> sizes, poses;
  for (const granular::PlacedRock& rock : pile.rocks) {
    shapes.push_back(rock.spec.shape);
    sizes.push_back(rock.spec.size);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) poses.push_back(rock.pose.matrix()(row, column));
  }
  record::Writer file(path, pile_kind);
  file.text("/", "provenance", pile_provenance(scenario));
  file.number("/", "poured_s", pile.poured_s);
  file.integer("/", "timed_out", pile.timed_out);
  file.array("/shape", std::span<const std::int32_t>(shapes));
  file.array("/size", std::span<const double>(sizes));
  file.array("/pose", std::span<const double>(poses), {pile.rocks.size(), 3, 4});
  file.commit();
}

SettledPile read_pile(const std::filesystem::path& path, const Scenario& scenario) {
  const record::Reader file(path, pile_kind);
  const std::string provenance = file.text("/", file.version() == 1 ? "recipe" : "provenance");
  if (provenance != pile_provenance(scenario))
    throw std::runtime_error(
        "loading::read_pile: " + path.string() +
        " was made for another drift, pile, rock material, rock shapes or solver; remove it to pour "
        "a new one, or name another file");
  const auto shapes = file.integers("/shape").values;
  const auto sizes = file.doubles("/size").values, poses = file.doubles("/pose").values;
  if (sizes.size() != shapes.size() || poses.size() != 12 * shapes.size())
    throw std::runtime_error("loading::read_pile: " + path.string() +
                             " contradicts itself; remove it to pour a new pile");
  SettledPile pile{{}, file.number("/", "poured_s"), file.integer("/", "timed_out") != 0, provenance};
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    granular::PlacedRock rock{{shapes[k], sizes[k]}, Eigen::Isometry3d::Identity()};
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        rock.pose.matrix()(row, column) = poses[12 * k + 4 * row + column];
    pile.rocks.push_back(rock);
  }
  return pile;
}

SettledPile prepared_pile(const Scenario& scenario, const std::function<void(double)>& progress) {
  if (!scenario.pile_file.empty() && std::filesystem::exists(scenario.pile_file))
    return read_pile(scenario.pile_file, scenario);
  const SettledPile pile = pour_pile(scenario, progress);
  if (!scenario.pile_file.empty()) write_pile(scenario.pile_file, pile, scenario);
  return pile;
}

}  // namespace drawpoint::engine::loading
