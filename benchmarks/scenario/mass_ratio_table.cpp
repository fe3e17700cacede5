// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <drawpoint/tests/support/mass_ratio_table.hpp>
#include <drawpoint/tests/support/pile_world.hpp>

#include "pile_run.hpp"

/// The table of tests/support/mass_ratio_table.hpp in the engine: how far a heavy cube sinks into light ones.
/// See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using support::MassRatioTable;

namespace {

constexpr const char* about =
    "Stands a cube of 2 m on four cubes of 0.2 m for 3 s and says how far they sink into each other.\n\n"
    "  mass_ratio_table                       1000:1, the engine's defaults\n"
    "  mass_ratio_table --ratio 101 --json    for a script\n\n"
    "Fields of --json:\n"
    "  overlap_fraction       largest exact overlap at the end, floor included, as a fraction of 0.2 m\n"
    "  overlap_fraction_peak  the same over all steps\n"
    "  height_m               mean height of the five centres at the end; look at it too: a table that has\n"
    "                         lost its legs has no overlap\n"
    "  expected_height_m      (4 x 0.1 + 1.2)/5 m\n"
    "  ms                     median wall time of a step";

using Poses = std::array<Eigen::Isometry3d, 5>;

Poses poses_of(const engine::World& world) {
  Poses poses;
  for (std::size_t k = 0; k < poses.size(); ++k) poses[k] = world.rocks()[k].pose;
  return poses;
}

void build(engine::World& world, const MassRatioTable& table) {
  using engine::Shape;
  world.add_static(std::make_shared<const Shape>(engine::HalfSpace{Eigen::Vector3d::UnitZ(), 0}),
                   Eigen::Isometry3d::Identity(), 0);
  for (const MassRatioTable::Cube& cube : table.cubes) {
    const auto shape = std::make_shared<const Shape>(engine::box(Eigen::Vector3d::Constant(cube.half)));
    world.add_rock({shape, cube.mass, Eigen::Vector3d::Constant(cube.inertia), 0},
                   Eigen::Isometry3d(Eigen::Translation3d(cube.start)));
  }
}

nlohmann::json run(double ratio, const EngineFlags& flags) {
  const auto options = world_options(flags);
  const MassRatioTable table = support::mass_ratio_table(ratio);
  engine::World world(options, support::pile_materials({}));
  build(world, table);
  Progress progress;
  PhaseTimes times;
  double peak = 0;
  const int steps = steps_in(MassRatioTable::duration, options.step);
  for (int k = 0; k < steps; ++k) {
    add_step(times, world);
    const Poses poses = poses_of(world);
    for (const Eigen::Isometry3d& pose : poses)
      if (!pose.matrix().allFinite())
        throw std::runtime_error(
            "a cube's pose is no longer finite at t = " + std::to_string(world.time()) +
            " s: the contact solution broke down; use a smaller step or more iterations");
    peak = std::max(peak, support::table_overlap(table, poses));
    progress.show("step", k + 1, steps);
  }
  nlohmann::json out = described(options);
  const Poses poses = poses_of(world);
  out.update({{"ratio", ratio},
              {"overlap_fraction", support::table_overlap(table, poses)},
              {"overlap_fraction_peak", peak},
              {"height_m", support::table_height(poses)},
              {"expected_height_m", MassRatioTable::expected_height},
              {"steps", steps},
              {"ms", times.median()}});
  return out;
}

void print_table(const nlohmann::json& j) {
  const auto number = [&](const char* key) { return j.at(key).get<double>(); };
  std::printf("mass ratio %g:1, %g s; %s\n", number("ratio"), MassRatioTable::duration, in_words(j).c_str());
  std::printf("overlap    %.4f %% of the small cube at the end, %.4f %% at most\n",
              100 * number("overlap_fraction"), 100 * number("overlap_fraction_peak"));
  std::printf("height     %.6f m, rigid %.6f m\n", number("height_m"), number("expected_height_m"));
  std::printf("time       %.4f ms per step\n", number("ms"));
}

}  // namespace

int main(int argc, char** argv) {
  double ratio = 1000;
  EngineFlags engine;
  bool json = false;
  CLI::App app(about, "mass_ratio_table");
  app.add_option("--ratio", ratio, "mass of the large cube over that of a small one")
      ->check(between(0.001, 1e6, "", "101 and 1000 are usual"))
      ->capture_default_str();
  add_engine_flags(app, engine);
  add_json_flag(app, json);
  return run_command(app, argc, argv, [&] { return show(run(ratio, engine), json, print_table); });
}
