// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <drawpoint/engine/granular/pile.hpp>
#include <drawpoint/engine/loading/drift.hpp>
#include <drawpoint/engine/loading/lhd.hpp>
#include <drawpoint/engine/loading/mine_materials.hpp>
#include <drawpoint/engine/loading/strategy/executor.hpp>
#include <drawpoint/engine/loading/strategy/planner.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <filesystem>
#include <string>
#include <string_view>

/// Everything that decides a loading simulation. Equal scenarios give equal logs, bit for bit.
namespace drawpoint::engine::loading {

struct PileOptions {
  double mass = 120e3;    ///< heaped up in the pre-simulation [kg]
  double density = 4500;  ///< of the rock [kg/m³]
  granular::SizeDistribution sizes = granular::blasted_ore;
  double max_height = 8;   ///< pouring stops when the pile reaches it [m]
  std::uint64_t seed = 1;  ///< of the pouring; one pile serves all runs of a study
  /// SolverOptions::tolerance while pouring, in place of Scenario::world's: a pile is poured once, so it is
  /// solved further than the cycles that dig in it.
  double tolerance = engine::SolverOptions{}.tolerance;
  granular::RestOptions rest;
};

struct Scenario {
  Strategy strategy;
  std::uint64_t seed = 1;  ///< of the rocks that come down the raise where others were loaded or cleared away
  int cycles = 1;
  /// The run ends before `cycles` are done, after least_cycles_to_end or more, once the standard error of its
  /// mean production (at the pile, without haul; relative_production_error) is at most this share of the mean;
  /// 0: it does not. A run ends when its cycles happen to agree, so that it understates its error, by a fifth
  /// or so.
  double precision = 0;
  double standoff = 2.0;  ///< tip to toe at the start [m]
  /// Also simulated are: the approach over the standoff, the way back once the bucket is clear, standing before it is
  /// weighed, a raise that lets rock down as slowly as piles are poured, only then, and the wait until nothing moves.
  /// Otherwise approach and way back take the time and energy that the machine's own law gives them
  /// (strategy/left_out.hpp).
  bool whole_cycle = false;
  Drift drift;
  PileOptions pile;
  MineMaterials materials = calibrated_materials();
  LhdOptions machine;
  ExecutorOptions executor;
  ColumnOptions columns;
  CurlMode curl = CurlMode::hinge_G;  ///< how the bucket breaks out of the pile
  LiftGoal lift = LiftGoal::behind_surface;
  engine::WorldOptions world;
  double frame_interval = 0.05;  ///< between recorded pictures of the scene [s]; the step: every one
  /// How far a rock in the log's pictures may be from its place in each coordinate [m], and by the same number
  /// its quaternion; a tenth of it for the machine. A pixel or two of the replay. 0: every sample is kept.
  double frame_tolerance = 0.02;
  /// Signals hold the wrench in every joint of the tree in place of hinge G's alone.
  bool log_all_joints = false;
  std::filesystem::path
      pile_file;  ///< settled pile to start from; made and saved there when missing; empty: poured anew
  std::filesystem::path log_file;  ///< run log to write (HDF5); empty: none
};

/// Cycles that a run does before it may end by its precision: fewer agree by chance too often.
inline constexpr int least_cycles_to_end = 5;

/// Speeds are the `lindmark2016` preset, 2-3 times what such a machine's hydraulics deliver, as the 12 s
/// cycles of Lindmark (2016) demand; take with_speeds(scenario, "machine") for engineering conclusions.
///
/// The LH621 in a drift 6 m wide with a small pile (120 t, about 1750 rocks, crest 2.5 m), one cycle.
Scenario lh621_in_a_drift();

/// The scale of Lindmark (2016): a drift 7 m wide, 290 t (about 4200 rocks), thirty cycles.
Scenario lh621_at_lindmark2016_scale();

/// By name: "small", "lindmark2016". Throws std::invalid_argument with the names.
Scenario scene_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> scene_names = {"small", "lindmark2016"};

/// The scene with a pile of another mass [kg] or of other sizes. Its iteration budget goes with the number of
/// rocks, so that every contact point gets as many iterations as in the scene.
Scenario with_pile_of(Scenario scenario, double mass, const granular::SizeDistribution& sizes);

/// The scene with speeds_named(name), and what drives them, in place of its `machine.drive_line` and
/// `machine.hydraulics`: the machine's speeds come with its engine of 382 kW and its hydraulics, those of
/// Lindmark (2016) with wheels and cylinders that have their force at any speed, as there. Throws
/// std::invalid_argument.
Scenario with_speeds(Scenario scenario, const std::string& name);

/// As loosely as Lindmark (2016) solves contacts: 150 iterations of a step of 1/60 s that remember nothing of
/// the step before. Rocks then give way, which the source's coefficients need to be loaded at all. The
/// iteration itself is ours, with momentum: nearer to the solution than 150 plain ones.
engine::WorldOptions lindmark2016_solver();

/// Throws std::invalid_argument naming the place, the value and what is allowed.
void check(const Scenario& scenario);

}  // namespace drawpoint::engine::loading
