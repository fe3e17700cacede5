// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/scenario.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"

/// Flags that the commands of the loading case share, beside those of command.hpp.
namespace drawpoint::benchmarks {

/// Moves as BOOM/TILT/SECONDS with commas between. Throws std::invalid_argument with the form.
std::vector<engine::loading::Move> round_of(const std::string& text);

/// How the loader is driven, by the names of engine/loading/strategy.
struct OperationFlags {
  std::string speeds = "lindmark2016", operated = "plan", curl = "hinge", lift = "surface",
              progress = "projected", arm = "cylinders", lift_end = "arm", moves;
  std::optional<double> curl_hold, crowd, slip;
  std::optional<int> rounds;
  bool whole_cycle = false;

  void apply(engine::loading::Scenario& scenario) const;
};

/// The operator, what was given of its moves and the laws that are not the default: "plan, curl held by 0,
/// --arm hinges".
std::string in_words(const OperationFlags& flags);

/// --speeds, --operator and its numbers, and the laws of the operation: --curl, --lift, --lift-end, --progress,
/// --arm and --whole-cycle.
void add_operation_flags(CLI::App& app, OperationFlags& flags);

/// The drift and what lies in it; what is not given is the scene's.
struct PileFlags {
  std::string scene = "small";
  std::optional<double> mass;  ///< [t]
  std::string sizes = "mine";

  engine::loading::Scenario scenario() const;
};

/// --scene, --mass and --sizes.
void add_pile_flags(CLI::App& app, PileFlags& flags);

/// --beta, --gamma and --kappa; alpha is each command's own.
void add_shares_of_strategy(CLI::App& app, engine::loading::Strategy& strategy);

/// Once parsed: those that were not given become the rocks' in the loading case.
void take_mine_materials(const CLI::App& app, MaterialFlags& flags);

}  // namespace drawpoint::benchmarks
