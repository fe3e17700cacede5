// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/strategy/column_model.hpp>
#include <drawpoint/engine/loading/strategy/trajectory.hpp>
#include <limits>
#include <vector>

/// Strategy and pile to trajectory.
///
/// The bucket takes a slice of constant horizontal thickness d up to height h and the sector through which
/// the tip moves when it breaks out: w_b (d h + ½ θ d²) = α V_b. Positive root of ½ θ d² + h d − A = 0
/// without cancellation, A = α V_b / w_b:
///   d = 2A / (h + √(h² + 2 θ A)),   finite for θ → 0 (d → A/h) and for h = 0 (d = √(2A/θ)).
/// h = β h_max, h_max = least of: the crest of the row's contour, the tip height with the boom at its upper
/// end and the bucket at κθ, that from which the bucket curls below the roof, and that to which the front tyres follow
/// the tip along the slope, h / tan θ, on the floor that the drive-in has cleared. Row: rows sorted by volume
/// centre, nearest to the back wall first, entry round(γ (n − 1)); they lie a centimetre apart, so the volume
/// centre follows γ continuously, while the place may jump from one side to the other. φ = κθ. Source: Lindmark
/// 2016, equations 48-51; (50) corrected, Lindmark (2016) prints h²/θ under the root.
namespace drawpoint::engine::loading {

/// The four design variables.
struct Strategy {
  double alpha = 1.0;  ///< wanted fill as a share of the bucket's volume, ≥ 0 [1]; studied range 0.2 to 2
  double beta = 0.5;   ///< stage-2 height as a share of h_max, 0 to 1 [1]; 0 leaves stage 2 out
  double gamma = 0.5;  ///< lateral place, 0: nearest to the back wall, 1: where the pile protrudes most [1]
  double kappa = 0.5;  ///< tilt in stage 2 as a share of the pile's slope, 0 to 1 [1]
};

/// Throws std::invalid_argument naming the value and what is allowed.
void check(const Strategy& strategy);

struct PlannerOptions {
  double bucket_volume = 8.0;  ///< V_b [m³]
  double bucket_width = 3.2;   ///< w_b [m]
  double standoff = 2.0;       ///< ℓ₀, tip to toe at the start [m]
  double boom_max = 0.80285;   ///< highest elevation of FG, 46° [rad]
  double phi_max = 0.78540;    ///< bucket fully curled back, 45° [rad]
  double roof =
      std::numeric_limits<double>::infinity();  ///< the bucket stays below it, at C and through the curl [m]
  /// The bucket with its load, for `roof`: points (x, z) relative to G, floor level [m]; the tip counts anyway.
  std::vector<Eigen::Vector2d> outline;
  /// Upper limit of the tip's x at C, e.g. before the back wall [m]; d gives way first, then h.
  double x_limit = std::numeric_limits<double>::infinity();
  /// Front tyres' foremost points ahead of the axle [m]; minus infinity: tyres limit nothing.
  double tyre_reach = -std::numeric_limits<double>::infinity();
  double tyre_room = 0.3;  ///< from those to the rock that the drive-in left standing [m]
  CurlMode curl = CurlMode::hinge_G;
  LiftGoal lift = LiftGoal::behind_surface;
  ArmGeometry arm;
};

/// d [m] for height h ≥ 0 [m], slope θ ≥ 0 [rad] and area A ≥ 0 [m²]; h and θ not both 0 unless A = 0.
double planned_depth(double height, double slope, double area);

/// Row for γ: index into model.rows. Ties, to a nanometre, keep the order of y. Needs at least one row.
int row_for(double gamma, const ColumnModel& model);

/// Not feasible (with a message) when the model has no row. Throws std::invalid_argument on a bad strategy or
/// option.
Plan plan_trajectory(const Strategy& strategy, const ColumnModel& model, const PlannerOptions& options = {});

}  // namespace drawpoint::engine::loading
