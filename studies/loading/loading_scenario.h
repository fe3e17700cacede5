// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the options of the loading study choose: materials, solver, scene, mass and sizes of the rocks,
/// speeds, operator, laws of the operation, number of cycles and when to stop before it, and the scenario that
/// they make. The scene has a number of cycles of its own (thirty at the scale of Lindmark, 2016), which the
/// study's option overrides: two, unless told. And the run that simulates it.

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/scenario.hpp>
#include <drawpoint/studies/study.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

std::vector<StudyOption> loading_options();

/// All that Lindmark (2016) prints: materials with solver, scale with a choked raise, speeds, motors in the hinges,
/// planner and executor, and the three responses by its own definitions.
Preset lindmark2016_preset();

/// Study::options_complaint: of a precision with so few cycles that none can be left out, of a pile below a
/// bucket load, and of motors in the hinges where the machine's pump sets the speeds.
std::string loading_options_complaint(const OptionValues& options);

/// The scenario of all runs of a study, but for strategy, seed and log. Throws std::invalid_argument if an
/// option has no value or one that it cannot have.
engine::loading::Scenario loading_scenario(const RunContext& run);

/// As engine::loading::simulate; tells run.progress of each cycle.
engine::loading::LoadingLog simulate_run(const engine::loading::Scenario& scenario, const RunContext& run);

/// How production is taken from a log: with the haul that the options give, or none.
engine::loading::ProductionOptions production_options(const OptionValues& options);

/// How rock spill is taken from a log, and what must be read of the log for it.
engine::loading::SpillOptions spill_options(const OptionValues& options);
engine::loading::LogContent content_for(const OptionValues& options);
/// Logs::cycles: the loads and times of a run, of which production is made with the haul of the options.
CycleWork loading_cycles(const std::filesystem::path& log, const OptionValues& options);

/// Place of the cycle of median production in LoadingLog::cycles, of an even number the lesser of the two in the
/// middle; of equal ones the first. Requires a cycle.
std::size_t typical_cycle(const engine::loading::LoadingLog& log, const OptionValues& options);

/// How joint damage is taken from a log: by the yield torque that the options give, or that of Lindmark
/// (2016).
engine::loading::DamageOptions damage_options(const OptionValues& options);

}  // namespace drawpoint::studies
