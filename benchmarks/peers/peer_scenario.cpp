// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/benchmarks/scenario/command.hpp>
#include <drawpoint/tests/support/mass_ratio_table.hpp>
#include <optional>

#include "peer.hpp"

/// The scenes of pile_scenario and mass_ratio_table in another engine: same start, same procedure, same
/// measures, same field names. One program an engine: peer_bullet, peer_ode, peer_mujoco. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using support::MassRatioTable;
using support::RockPile;

namespace {

using States = std::vector<support::RockState>;

struct Settings {
  PeerOptions peer;
  std::string scene = "pile";
  int rocks = 500;
  double ratio = 1000;
  std::uint64_t seed = 1;
  std::optional<int> settle, steps, dig;
  bool json = false;
};

constexpr const char* about =
    "Steps the scenes of pile_scenario and mass_ratio_table in another engine and measures them alike.\n"
    "Fields as there, and\n"
    "  engine, version, iterations\n"
    "  rocks_lost     rocks whose centre is outside the box at the end of digging";

int steps_in(double seconds, double step) {
  return std::max(1, static_cast<int>(std::lround(seconds / step)));
}

States states_of(const Peer& peer, std::size_t rocks) {
  States states;
  for (std::size_t i = 0; i < rocks; ++i) states.push_back(peer.rock(static_cast<int>(i)));
  return states;
}

/// Wall time of each step [ms], sorted.
std::vector<double> run_steps(Peer& peer, const std::string& phase, int steps, Progress& progress) {
  std::vector<double> times;
  for (int k = 0; k < steps; ++k) {
    const auto start = std::chrono::steady_clock::now();
    peer.step();
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    progress.show(phase, k + 1, steps);
  }
  std::sort(times.begin(), times.end());
  return times;
}

double median(const std::vector<double>& sorted) {
  return 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
}

int rocks_lost(const RockPile& pile, const States& states) {
  return static_cast<int>(std::count_if(states.begin(), states.end(), [&](const support::RockState& state) {
    return std::any_of(pile.walls.begin(), pile.walls.end(), [&](const support::PileWall& wall) {
      return !(wall.normal.dot(state.pose.translation()) > wall.offset);  // not finite is lost, too
    });
  }));
}

void add_overlaps(nlohmann::json& out, const std::string& prefix, const support::OverlapStatistics& s) {
  out.update({{prefix + "overlap_max", s.max},
              {prefix + "overlap_p99", s.p99},
              {prefix + "overlap_mean", s.mean},
              {prefix + "touching_pairs", s.pairs}});
}

nlohmann::json described(const Settings& s, const Peer& peer) {
  return {{"engine", engine_name()},
          {"version", peer.version()},
          {"iterations", s.peer.iterations},
          {"dt_s", s.peer.step}};
}

nlohmann::json run_pile(const Settings& s) {
  const double h = s.peer.step;
  const int settle = s.settle.value_or(steps_in(RockPile::settle_time, h)),
            steps = s.steps.value_or(steps_in(RockPile::rest_time, h)),
            dig = s.dig.value_or(steps_in(RockPile::dig_time, h));
  const RockPile pile = support::rock_pile(s.rocks, s.seed);
  const auto peer = make_peer(pile, s.peer);
  Progress progress;
  nlohmann::json out = described(s, *peer);
  out.update({{"rocks", s.rocks}, {"seed", s.seed}, {"mass_kg", pile.mass()}});
  out.update({{"settle_steps", settle}, {"rest_steps", steps}, {"dig_steps", dig}});

  run_steps(*peer, "settle", settle, progress);
  const States before = states_of(*peer, pile.rocks.size());
  out["ms_rest"] = median(run_steps(*peer, "rest", steps, progress));
  const States rested = states_of(*peer, pile.rocks.size());
  const support::Drift drift = support::drift(before, rested, steps * h);
  out["contacts"] = peer->contacts();
  add_overlaps(out, "", support::rock_overlaps(pile, rested));
  out["wall_overlap_max"] = support::wall_overlaps(pile, rested).max;
  out["drift_mm_s"] = 1e3 * drift.mean;
  out["drift_median_mm_s"] = 1e3 * drift.median;
  out["drift_p99_mm_s"] = 1e3 * drift.p99;
  out["drift_worst_mm_s"] = 1e3 * drift.worst;
  out["drift_window_s"] = steps * h;
  out["kinetic_energy_per_rock_j"] = support::kinetic_energy_per_rock(pile, rested);
  out["mean_height_m"] = support::mean_height(rested);

  peer->drive_blade(pile.blade.speed);
  const auto times = run_steps(*peer, "dig", dig, progress);
  const States dug = states_of(*peer, pile.rocks.size());
  out["ms_dig"] = std::accumulate(times.begin(), times.end(), 0.0) / dig;
  out["dig_contacts"] = peer->contacts();
  add_overlaps(out, "dig_", support::rock_overlaps(pile, dug));
  const Eigen::Vector3d blade(peer->blade_position(), pile.blade.start.y(), pile.blade.start.z());
  out["dig_blade_overlap_max"] = support::blade_overlaps(pile, dug, blade).max;
  out["rocks_lost"] = rocks_lost(pile, dug);
  return out;
}

/// The table as a pile of five rocks on a floor, with the blade far away.
RockPile as_pile(const MassRatioTable& table) {
  RockPile pile;
  pile.walls = {{Eigen::Vector3d::UnitZ(), 0}};
  pile.blade.start.x() = -8;
  for (const auto& cube : table.cubes) {
    pile.rocks.push_back(
        {static_cast<int>(pile.hulls.size()), Eigen::Isometry3d(Eigen::Translation3d(cube.start))});
    pile.hulls.push_back({engine::box(Eigen::Vector3d::Constant(cube.half)), cube.mass,
                          Eigen::Vector3d::Constant(cube.inertia)});
  }
  return pile;
}

nlohmann::json run_table(const Settings& s) {
  const MassRatioTable table = support::mass_ratio_table(s.ratio);
  const auto peer = make_peer(as_pile(table), s.peer);
  const int steps = steps_in(MassRatioTable::duration, s.peer.step);
  std::array<Eigen::Isometry3d, 5> poses;
  std::vector<double> times;
  double peak = 0;
  Progress progress;
  for (int k = 0; k < steps; ++k) {
    times.push_back(run_steps(*peer, "step", 1, progress)[0]);
    for (int i = 0; i < 5; ++i) poses[i] = peer->rock(i).pose;
    peak = std::max(peak, support::table_overlap(table, poses));
  }
  std::sort(times.begin(), times.end());
  nlohmann::json out = described(s, *peer);
  out.update({{"ratio", s.ratio},
              {"overlap_fraction", support::table_overlap(table, poses)},
              {"overlap_fraction_peak", peak},
              {"height_m", support::table_height(poses)},
              {"expected_height_m", MassRatioTable::expected_height},
              {"steps", steps},
              {"ms", median(times)}});
  return out;
}

void print_table(const nlohmann::json& result) {
  for (const auto& [key, value] : result.items())
    std::printf("%-26s %s\n", key.c_str(), value.dump().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "peer_" + engine_name());
  app.add_option("--scene", s.scene, "which scene")
      ->check(CLI::IsMember({"pile", "mass-ratio"}))
      ->capture_default_str();
  app.add_option("--rocks", s.rocks, "number of rocks (pile)")
      ->check(between(1, 100'000, "", "500 to 3000 are usual"))
      ->capture_default_str();
  app.add_option("--ratio", s.ratio, "mass of the large cube over that of a small one (mass-ratio)")
      ->check(between(0.001, 1e6, "", "101 and 1000 are usual"))
      ->capture_default_str();
  app.add_option("--seed", s.seed, "of sizes, shapes and start poses")
      ->check(between(0, 1e9, "", "any number names a pile"))
      ->capture_default_str();
  app.add_option("--iterations", s.peer.iterations, "of the engine's solver per step")
      ->check(between(1, 1e6, "", "10, 50 and 150 are usual"))
      ->capture_default_str();
  app.add_option("--dt", s.peer.step, "time step [s]")
      ->check(between(1e-4, 0.1, "s", "0.01 s is what the engines are compared at"))
      ->capture_default_str();
  app.add_option("--settle", s.settle, "steps of settling (default: 5 s)")
      ->check(between(1, 1e7, "steps", "leave it out for 5 s"));
  app.add_option("--steps", s.steps, "steps at rest, timed; drift is over these (default: 2 s)")
      ->check(between(1, 1e7, "steps", "leave it out for 2 s"));
  app.add_option("--dig", s.dig, "steps of digging (default: 1 s)")
      ->check(between(1, 1e7, "steps", "leave it out for 1 s; the blade meets the wall after 3.6 s"));
  app.add_flag("--json", s.json, "print one JSON object");
  return run_command(app, argc, argv, [&] {
    const nlohmann::json result = s.scene == "pile" ? run_pile(s) : run_table(s);
    if (s.json)
      std::printf("%s\n", result.dump().c_str());
    else
      print_table(result);
    return 0;
  });
}
