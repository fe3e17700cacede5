// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>
#include <drawpoint/engine/loading/scenario.hpp>
#include <functional>

/// Simulates loading cycles: plan from the pile as it lies, drive in, lift, curl, back out, weigh, refill,
/// wait for rest, again; as often as the scenario says, or until the mean production is known as well as it
/// wants (`precision`, `left_out_cycles`).
///
/// Every cycle starts straight in front of the planned place: hauling, dumping and driving are left out. Its first and
/// last parts, in which the machine drives alone, are not simulated but counted by the machine's own law: it begins at
/// the pile's toe with the speed of its approach, and ends in backing out when the bucket is clear with what it carries
/// (Site::bucket_is_clear). From when it backs out rock comes down the raise, until the drift holds its first mass
/// again or the raise is blocked; what is missing then comes while the machine digs. The next cycle begins when the
/// pile stands, though single rocks may still roll. With Scenario::whole_cycle all of it is simulated, standing for a
/// second before it is weighed, and rest for PileOptions::rest. What the bucket carries is weighed and taken away,
/// spilled rocks stay where they lie. Rocks that lie on the rest of the machine, or where it must stand, are taken away
/// and logged (`cleared_mass`).
///
/// A step whose contact solution breaks down is done again in ten parts (`repeated_steps`), a rock that left
/// the drift is taken away (`escaped_mass`), and a cycle that breaks down all the same is lost
/// (`lost_cycles`), not the run; more than 1 % of the pile's mass or one cycle in five is failure. Failure is
/// data: a pile without a place to load, or a solution that breaks down, gives a log with completed = false
/// and a message; the cycles done before are in it. Each cycle goes to the disk when it ends, and is not
/// written again before the run ends: a run that is killed leaves what it had done, completed = false. Throws
/// std::invalid_argument for a bad scenario and std::runtime_error if a file cannot be read or written.
/// Deterministic. Cost: some ms per step and 1000 rocks.
namespace drawpoint::engine::loading {

struct SimulationHooks {
  /// After each step, with where its time went. What it, `on_cycle` or `look_ahead` throws ends the run, with
  /// its message.
  std::function<void(const engine::StepReport&)> on_step;
  std::function<void(const CycleRecord&)> on_cycle;  ///< after each cycle that is not lost
  engine::World::Observer before_solve;              ///< in each step of the cycles, as World::before_solve
  /// Before each step in which the strategy drives the machine. It may step the world, to look ahead with the
  /// speeds that are set, but must restore it.
  std::function<void(engine::World&)> look_ahead;
};

LoadingLog simulate(const Scenario& scenario, const SimulationHooks& hooks = {});

/// From this pile, whatever it was poured with; the scenario's pile file is not looked at.
LoadingLog simulate(const Scenario& scenario, const SettledPile& pile, const SimulationHooks& hooks = {});

}  // namespace drawpoint::engine::loading
