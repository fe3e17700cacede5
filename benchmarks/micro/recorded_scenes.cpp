// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/benchmarks/micro/recorded_scenes.hpp>
#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>
#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <stdexcept>

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

loading::Scenario cycle() {
  loading::Scenario scenario = loading::lh621_in_a_drift();
  scenario.pile.mass = 45e3;
  scenario.strategy = {1.2, 0.8, 0.8, 0.2};
  return scenario;
}

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
  if (when < 0) throw std::runtime_error("bucket_at_breakout: the cycle never loads the hinge");
  return step_ending_at(when, h);
}

long full_step(const loading::LoadingLog& log, double h) {
  for (const loading::StageResult& result : log.cycles.front().stages)
    if (result.stage == loading::Stage::curl) return step_ending_at(result.t_end, h);
  throw std::runtime_error("bucket_full: the cycle has no curl");
}

// The cycle runs twice, bit for bit the same: once to find the step, once to record it.
void record_cycle(const std::filesystem::path& file, long (*find)(const loading::LoadingLog&, double),
                  const std::string& note) {
  loading::Scenario scenario = cycle();
  scenario.pile_file = file;
  scenario.pile_file += ".pile";
  const loading::LoadingLog log = loading::simulate(scenario);
  if (!log.completed || log.cycles.empty()) throw std::runtime_error("the cycle fails: " + log.message);
  const long wanted = find(log, scenario.world.step);
  long step = 0;
  loading::SimulationHooks hooks;
  hooks.before_solve = [&](const ContactProblem& problem) {
    if (step++ == wanted) record::write_contact_problem(file, problem, note);
  };
  loading::simulate(scenario, hooks);
  std::filesystem::remove(scenario.pile_file);
}

}  // namespace

void record_scene(const std::string& scene, const std::filesystem::path& file) {
  if (scene == "settled_pile") return record_settled_pile(file);
  if (scene == "bucket_at_breakout")
    return record_cycle(file, breakout_step, "bucket at breakout: LH621 in a drift with 45 t of ore");
  if (scene == "bucket_full")
    return record_cycle(file, full_step, "bucket full, curled: LH621 in a drift with 45 t of ore");
  throw std::invalid_argument("no scene \"" + scene +
                              "\"; known: settled_pile, bucket_full, bucket_at_breakout");
}

}  // namespace drawpoint::benchmarks
