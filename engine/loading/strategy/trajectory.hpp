// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/loading/strategy/kinematics.hpp>
#include <string>
#include <vector>

/// What the planner hands to the executor, as a tip path A-B-C-D-E, and the goals of the four stages.
///
///   A-B drive in, bucket flat: from A (tip ℓ₀ before the toe) to B (depth d behind the toe)
///   B-C lift and tilt to C, d behind the pile's surface at height h, with φ = κθ; left out when h = 0
///   C-D curl fully back, to φ_max
///   D-E back out, until the tip is above A
/// World frame, metres and radians.
namespace drawpoint::engine::loading {

/// How the bucket curls in stage 3.
enum class CurlMode {
  hinge_G,   ///< only the tilt actuator moves, the tip swings about G; always possible (default)
  tip_fixed  ///< as Lindmark (2016) has it: the tip stays and G sinks, which a low tip forbids
};

/// By name. Throws std::invalid_argument with the names, as the others below.
CurlMode curl_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> curl_names = {"hinge", "tip"};

/// Where stage 2 aims.
enum class LiftGoal {
  behind_surface,  ///< at C, as deep behind the pile's surface as planned, from wherever stage 1 ended
                   ///< (default)
  along_slope      ///< by (h / tan θ, h) from where stage 1 ended, as Lindmark (2016) has it
};

LiftGoal lift_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> lift_names = {"surface", "slope"};

struct Plan {
  bool feasible = false;  ///< false: see message; the numbers are then not to be used
  std::string message;
  int row = -1;              ///< index into ColumnModel::rows
  double y = 0;              ///< lateral place of the bucket's middle [m]
  double depth = 0;          ///< d [m]
  double height = 0;         ///< h [m]
  double tilt = 0;           ///< φ = κθ at C [rad]
  double slope = 0;          ///< θ [rad]
  double toe = 0;            ///< x of the pile's toe in the row [m]
  double volume_centre = 0;  ///< VC of the row [m]
  double crest = 0;          ///< of the row's contour [m]
  double height_limit = 0;   ///< h_max [m]
  double area = 0;           ///< planned slice, α V_b / w_b [m²]
  bool limited = false;      ///< depth or height were cut to stay before x_limit
  double phi_max = 0;        ///< bucket angle at D [rad]
  CurlMode curl = CurlMode::hinge_G;
  LiftGoal lift = LiftGoal::behind_surface;
  std::array<TipPose, 5> corners;  ///< A, B, C, D, E
};

/// Displacement of the tip and of the bucket angle in one stage.
struct StageGoal {
  double x = 0, z = 0;  ///< [m]
  double phi = 0;       ///< [rad]
};

/// A to E of a plan whose numbers are set.
std::array<TipPose, 5> corner_points(const Plan& plan, double standoff, const ArmGeometry& arm);

/// The goal of stage 1-4 from where the tip is when it starts. Stages 1, 2 and 4 aim at places (B, C and A),
/// so that a drive-in that ended early is made good on the way up: the lift then leads into the pile instead
/// of skimming its surface (LiftGoal::along_slope keeps Lindmark's displacement). Stage 3 aims at a bucket
/// angle. `cycle_start` is the tip at the start of stage 1.
StageGoal stage_goal(const Plan& plan, int stage, const TipPose& now, const TipPose& cycle_start);

/// The path for a plot: straight pieces and the arc of the curl, `arc_points` points on it.
std::vector<TipPose> planned_path(const Plan& plan, const ArmGeometry& arm, int arc_points = 24);

}  // namespace drawpoint::engine::loading
