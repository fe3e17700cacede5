// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/loading/strategy/operator_moves.hpp>
#include <drawpoint/engine/loading/strategy/planner.hpp>
#include <string_view>

/// Families of loading strategies: ways to fill a bucket that differ in what is done, not in how much of it.
///
///   slice            Lindmark's (2016): drive in, lift along the slope behind a slice of constant thickness, curl
///   drive_and_curl   drive in and curl where the drive-in ends; no lift
///   steps            as slice, and a drive-in that is held up goes on in steps: lift, curl, lift, curl
///   edge_dropped     as steps, and after each curl the edge is dropped back into the rock: lift, curl, dump, curl
/// All push while the bucket curls, at a speed that is set, and ease the throttle where wheels spin. Sources and rates
/// of the moves: operator_moves.hpp.
namespace drawpoint::engine::loading {

enum class Family : int { slice, drive_and_curl, steps, edge_dropped };
inline constexpr std::array<std::string_view, 4> family_names = {"slice", "drive_and_curl", "steps",
                                                                 "edge_dropped"};

/// How it is driven. `rounds`: of steps or drops in a drive-in, at least 1; slice and drive_and_curl have none.
/// `crowd`: at which the drive pushes in the curl, at least 0 [m/s]. Throws std::invalid_argument.
OperatorMoves moves_of(Family family, int rounds, double crowd);

/// What the family makes of a strategy: without lift, drive_and_curl has beta = 0 and kappa = 0.
Strategy strategy_of(Family family, Strategy strategy);

}  // namespace drawpoint::engine::loading
