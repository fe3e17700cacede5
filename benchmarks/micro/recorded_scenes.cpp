// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/benchmarks/micro/recorded_scenes.hpp>
#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>
#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::benchmarks {
namespace {

using namespace engine;
using engine::ContactProblem;
using engine::World;

// Rocks on a lattice above the box, layer after layer, each turned by the emitter's own draw.
void fill_box(World& world, int rocks) {
  const auto ground = std::make_shared<const engine::Shape>(engine::HalfSpace{Eigen::Vector3d::UnitZ(), 0});
  const int terrain = static_cast<int>(loading::SurfaceKind::terrain);
  world.add_static(ground, Eigen::Isometry3d::Identity(), terrain);
  for (const Eigen::Vector3d& n : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0),
                                   Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)})
    world.add_static(std::make_shared<const engine::Shape>(engine::HalfSpace{n, -2}),
                     Eigen::Isometry3d::Identity(), terrain);
  const granular::RockLibrary library;
  granular::RockSampler sampler(1, 4500);
  for (int k = 0; k < rocks; ++k) {
    const granular::RockDraw rock = sampler.next();
    const Eigen::Translation3d place(-1.5 + 1.0 * (k % 4), -1.5 + 1.0 * (k / 4 % 4), 0.5 + 0.9 * (k / 16));
    world.add_rock(library.body({rock.shape, rock.length}),
                   place * Eigen::AngleAxisd(k, Eigen::Vector3d(1, 2, 3).normalized()));
  }
}

void record_settled_pile(const std::filesystem::path& file) {
  constexpr int rocks = 600;
  World world({}, loading::material_table(loading::calibrated_materials()));
  fill_box(world, rocks);
  for (double fall = 0; fall < 5; fall += world.options().step) world.step();
  granular::RestWatch watch;
  do world.step();
  while (!watch.at_rest(world));
  if (watch.timed_out()) throw std::runtime_error("settled_pile: the pile does not come to rest");
  world.before_solve([&](const ContactProblem& problem) {
    record::write_contact_problem(file, problem, "settled pile: 600 rocks in a box of 4 m x 4 m, at rest");
  });
  world.step();
}

// A moment of a loading cycle.
struct Moment {
  const char *name, *words;
  long (*find)(const loading::LoadingLog&, double);
};

struct Scene {
  std::string name, note;
  loading::Scenario scenario;
  long (*find)(const loading::LoadingLog&, double);
};

// Number of the step, from 0, that ends at a time.
long step_ending_at(double time, double h) { return std::lround(time / h) - 1; }

long breakout_step(const loading::LoadingLog& log, double h) {
  const record::Table& table = log.signals;
  const std::size_t stage = table.index("stage"), force = table.index("hinge_G_force_x"),
                    time = table.index("time");
  double most = 0, when = -1;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.at(row, stage) > static_cast<int>(loading::Stage::lift)) continue;
    const double load = std::hypot(table.at(row, force), table.at(row, force + 1), table.at(row, force + 2));
    if (load > most) most = load, when = table.at(row, time);
  }
  if (when < 0) throw std::runtime_error("the cycle never loads the hinge");
  return step_ending_at(when, h);
}

long full_step(const loading::LoadingLog& log, double h) {
  for (const loading::StageResult& result : log.cycles.front().stages)
    if (result.stage == loading::Stage::curl) return step_ending_at(result.t_end, h);
  throw std::runtime_error("the cycle has no curl");
}

loading::Scenario one_cycle(loading::Scenario scenario, double rolling) {
  scenario.cycles = 1;
  scenario.strategy = {1.2, 0.8, 0.8, 0.2};
  scenario.materials = loading::with_resistance(loading::calibrated_materials(), rolling, 0);
  scenario.materials.rock_rock.friction = 0.9;
  return scenario;
}

std::vector<Scene> cycle_scenes() {
  const std::vector<Moment> moments{{"bucket_full", "bucket full, curled", full_step},
                                    {"bucket_at_breakout", "bucket at breakout", breakout_step}};
  std::vector<Scene> scenes;
  for (const Moment& moment : moments) {
    const std::string name = moment.name, note = moment.words;
    loading::Scenario small = one_cycle(loading::lh621_in_a_drift(), 0.1);
    small.pile.mass = 45e3;
    scenes.push_back({name, note + ": LH621 in a drift with 45 t of ore", small, moment.find});
    for (const auto& [rolling, text] : {std::pair(0.0, "0"), std::pair(0.1, "0.1")}) {
      const std::string materials = std::string(", friction 0.9, rolling resistance ") + text;
      scenes.push_back({name + "_rolling_" + text, note + ": LH621 in a drift with 120 t of ore" + materials,
                        one_cycle(loading::lh621_in_a_drift(), rolling), moment.find});
      scenes.push_back({name + "_at_lindmark2016_scale_rolling_" + text,
                        note + ": LH621 in a drift 7 m wide with 290 t of ore" + materials,
                        one_cycle(loading::lh621_at_lindmark2016_scale(), rolling), moment.find});
    }
  }
  return scenes;
}

struct Recorded {};  // thrown to end a simulation whose step is in its file

// The cycle runs twice from one pile, bit for bit the same: once to find the step, once to record it.
void record_cycle(const std::filesystem::path& file, const Scene& scene) {
  const loading::SettledPile pile = loading::pour_pile(scene.scenario);
  const loading::LoadingLog log = loading::simulate(scene.scenario, pile);
  if (!log.completed || log.cycles.empty())
    throw std::runtime_error(scene.name + ": the cycle fails: " + log.message);
  const long wanted = scene.find(log, scene.scenario.world.step);
  long step = 0;
  loading::SimulationHooks hooks;
  hooks.before_solve = [&](const ContactProblem& problem) {
    if (step++ != wanted) return;
    record::write_contact_problem(file, problem, scene.note);
    throw Recorded();
  };
  try {
    loading::simulate(scene.scenario, pile, hooks);
  } catch (const Recorded&) {
    return;
  }
  throw std::runtime_error(scene.name + ": the cycle ends before its step " + std::to_string(wanted));
}

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names{"settled_pile"};
  for (const Scene& scene : cycle_scenes()) names.push_back(scene.name);
  return names;
}

void record_scene(const std::string& name, const std::filesystem::path& file) {
  if (name == "settled_pile") return record_settled_pile(file);
  for (const Scene& scene : cycle_scenes())
    if (scene.name == name) return record_cycle(file, scene);
  std::string known;
  for (const std::string& other : scene_names()) known += (known.empty() ? "" : ", ") + other;
  throw std::invalid_argument("no scene \"" + name + "\"; known: " + known);
}

}  // namespace drawpoint::benchmarks
