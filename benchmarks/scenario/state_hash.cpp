// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdio>
#include <drawpoint/tests/support/dug_pile.hpp>

#include "command.hpp"

/// Prints the hash of the full state of a pile under a moving blade, to compare builds, threads and machines
/// by. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;

namespace {

struct Settings {
  EngineFlags engine;
  MaterialFlags material{support::BladePile::stone.rolling, support::BladePile::stone.spinning};
  int rocks = 200;
  long steps = 2000, every = 500, restart = 0;
};

constexpr const char* about =
    "Heaps up rocks between walls, drives a blade to and fro through them and prints a line\n"
    "\"step HASH points\" now and then. HASH is of all bits of all rocks and of the machine: equal on any\n"
    "number of threads, in any run and any build of the same source.\n\n"
    "  state_hash                                   200 rocks, 2000 steps\n"
    "  state_hash --threads 8 --restart 1000        the same lines, across a snapshot file in mid-run\n"
    "  state_hash --rocks 40 --steps 200 --every 50 short enough for a build with sanitizers";

int run(const Settings& s) {
  engine::Material stone = support::BladePile::stone;
  stone.rolling = s.material.rolling;
  stone.spinning = s.material.spinning;
  support::DugPile pile(s.rocks, world_options(s.engine), stone);
  Progress progress;
  while (pile.step() < s.steps) {
    if (s.restart > 0 && pile.step() == s.restart)
      pile.restart(std::filesystem::temp_directory_path() /
                   ("drawpoint_state_hash_" + std::to_string(::getpid())));
    pile.run(1);
    progress.show("step", static_cast<int>(pile.step()), static_cast<int>(s.steps));
    if (pile.step() % s.every != 0 && pile.step() != s.steps) continue;
    std::printf("%ld %016llx %d\n", pile.step(), static_cast<unsigned long long>(pile.hash()),
                pile.report().points);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "state_hash");
  app.add_option("--rocks", s.rocks, "number of rocks")
      ->check(between(1, 10'000, "", "20 make a layer"))
      ->capture_default_str();
  app.add_option("--steps", s.steps, "steps")
      ->check(between(1, 1e7, "steps", "2000 are 20 s at the default step"))
      ->capture_default_str();
  app.add_option("--every", s.every, "steps between two lines")
      ->check(between(1, 1e7, "steps", "1 finds the first step that differs"))
      ->capture_default_str();
  app.add_option("--restart", s.restart, "step at which a snapshot file carries the run over; 0: none")
      ->check(between(0, 1e7, "steps", "half of --steps is usual"))
      ->capture_default_str();
  add_engine_flags(app, s.engine);
  add_material_flags(app, s.material);
  return run_command(app, argc, argv, [&] { return run(s); });
}
