// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/run_description.h>
#include <cstdio>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/engine/loading/libraries.hpp>

namespace drawpoint::engine::loading {
namespace {

// "0.2 of 0.3 m, 0.3 of 0.4 m": shares of the mass.
std::string in_words(const granular::SizeDistribution& sizes) {
  std::string words;
  for (const granular::SizeClass& size : sizes) {
    char text[64];
    std::snprintf(text, sizeof text, "%s%g of %g m", words.empty() ? "" : ", ", size.mass_share, size.length);
    words += text;
  }
  return words;
}

// "boom 0.1, tilt 0.1 rad/s for 0.5 s; ...": the moves of a round.
std::string in_words(const OperatorMoves& moves) {
  std::string words;
  for (const Move& move : moves.round) {
    char text[96];
    std::snprintf(text, sizeof text, "%sboom %g, tilt %g rad/s for %g s", words.empty() ? "" : "; ",
                  move.boom, move.tilt, move.time);
    words += text;
  }
  return words.empty() ? "none" : words;
}

}  // namespace

void describe(const Scenario& s, const Site& site, LoadingLog& log) {
  const Lhd& lhd = site.lhd();
  log.numbers = {{"alpha", s.strategy.alpha},
                 {"beta", s.strategy.beta},
                 {"gamma", s.strategy.gamma},
                 {"kappa", s.strategy.kappa},
                 {"cycles", s.cycles},
                 {"precision", s.precision},
                 {"standoff", s.standoff},
                 {"drift_length", s.drift.length},
                 {"drift_width", s.drift.width},
                 {"drift_height", s.drift.height},
                 {"pile_mass", site.initial_mass()},
                 {"rocks", static_cast<double>(site.world().rocks().size())},
                 {"density", s.pile.density},
                 {"payload", lhd.payload},
                 {"bucket_width", lhd.bucket_width},
                 {"bucket_struck_volume", struck_volume(lhd.options.bucket)},
                 {"bucket_heaped_volume", heaped_volume(lhd.options.bucket)},
                 {"pin_spacing", lhd.pin_spacing},
                 {"tyre_radius", lhd.tyre_radius},
                 {"rock_friction", s.materials.rock_rock.friction},
                 {"rock_rolling", s.materials.rock_rock.rolling},
                 {"rock_spinning", s.materials.rock_rock.spinning},
                 {"steel_friction", s.materials.rock_steel.friction},
                 {"steel_rolling", s.materials.rock_steel.rolling},
                 {"floor_friction", s.materials.rock_terrain.friction},
                 {"rock_tyre_friction", s.materials.rock_tyre.friction},
                 {"steel_floor_friction", s.materials.steel_terrain.friction},
                 {"tyre_floor_friction", s.materials.tyre_terrain.friction},
                 {"whole_cycle", s.whole_cycle ? 1.0 : 0.0},
                 {"step", s.world.step},
                 {"substeps", s.world.solver.substeps},
                 {"iterations", s.world.solver.iterations},
                 {"iteration_budget", s.world.solver.iteration_budget},
                 {"tolerance", s.world.solver.tolerance},
                 {"warm_start", s.world.warm_start},
                 {"set_drive_in", s.executor.speeds.drive_in},
                 {"set_lift", s.executor.speeds.lift},
                 {"set_curl", s.executor.speeds.curl},
                 {"drive_acceleration", s.executor.speeds.limits.drive_acceleration},
                 {"set_back_out", s.executor.speeds.back_out},
                 {"longest_drive_in", s.executor.speeds.stage_limit[0]},
                 {"longest_lift", s.executor.speeds.stage_limit[1]},
                 {"longest_curl", s.executor.speeds.stage_limit[2]},
                 {"longest_back_out", s.executor.speeds.stage_limit[3]},
                 {"slow_share", s.executor.slow_share},
                 {"slow_window", s.executor.slow_window},
                 {"dig_window", s.executor.dig_window},
                 {"move_rounds", s.executor.moves.rounds},
                 {"held_up", s.executor.moves.held_up},
                 {"most_slip", s.executor.moves.most_slip},
                 {"crowd", s.executor.moves.crowd},
                 {"curl_hold", s.executor.moves.curl_hold},
                 {"wheel_torque_limit", s.machine.wheel_torque},
                 {"engine_power", s.machine.drive_line.engine_power},
                 {"hydraulic_pressure", s.machine.hydraulics.pressure},
                 {"pump_flow", s.machine.hydraulics.pump_flow},
                 {"lift_bore", s.machine.hydraulics.lift.bore},
                 {"lift_rod", s.machine.hydraulics.lift.rod},
                 {"tilt_bore", s.machine.hydraulics.tilt.bore},
                 {"tilt_rod", s.machine.hydraulics.tilt.rod}};
  log.texts = {{"machine", "Sandvik LH621 class"},
               {"curl", s.curl == CurlMode::hinge_G ? "hinge G" : "tip fixed"},
               {"arm_drive", s.machine.arm_drive == ArmDrive::cylinders ? "cylinders" : "hinges"},
               {"progress", s.executor.progress.mode == ProgressMode::projected ? "projected" : "faithful"},
               {"lift_end", s.executor.lift_end == LiftEnd::arm ? "arm" : "any actuator"},
               {"moves", in_words(s.executor.moves)},
               {"after_stuck", s.executor.stuck == StuckPolicy::next_stage ? "next stage" : "back out"},
               {"rock_sizes", in_words(s.pile.sizes)},
               {"rock_shapes", std::to_string(granular::rock_shapes_checksum())},
               {"seed", std::to_string(s.seed)},
               {"lift", s.lift == LiftGoal::behind_surface ? "behind surface" : "along slope"},
               {"simulator", simulator},
               {"version", DRAWPOINT_VERSION}};
}

}  // namespace drawpoint::engine::loading
