// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/loading/strategy/trajectory.hpp>
#include <string>
#include <string_view>

/// How far a stage has come, and how fast to go on.
///
/// Progress toward the goal (x_g, z_g, φ_g), Δ the displacement since the stage began, ℓ a length that weighs
/// angles:
///   projected  s = (Δx x_g + Δz z_g + ℓ² Δφ φ_g) / (x_g² + z_g² + ℓ² φ_g²)      (default, ℓ = GK)
///   faithful   s = √((Δx² + Δz² + Δφ²) / (x_g² + z_g² + φ_g²)), metres and radians added, blind to direction
/// Speeds fall as max(1 − s², ε): without the floor s = tanh(t/T₀) and the goal is never reached. With it and
/// T₀ = distance over first speed, the stage ends (s = 1 − δ) at T₀ (atanh √(1−ε) + (1 − δ − √(1−ε)) /
/// ε), 2.69 T₀ for ε = 0.05, δ = 0. Rotation in stage 2 follows the same factor; Lindmark's (1 − s) turns
/// it through only ln 2 of its goal. Source: Lindmark 2016, equations 41-46.
namespace drawpoint::engine::loading {

enum class ProgressMode { projected, faithful };

/// The factor of the rotation in stage 2.
enum class RotationLaw {
  as_translation,  ///< 1 − s², matched (default)
  linear,          ///< 1 − s, as printed: ends at about 69 % of the wanted tilt
  linear_rescaled  ///< (1 − s) / ln 2
};

struct ProgressOptions {
  ProgressMode mode = ProgressMode::projected;
  RotationLaw rotation = RotationLaw::as_translation;
  double angle_length = 1.868;   ///< ℓ [m]; used by projected
  double velocity_floor = 0.05;  ///< ε [1]; 0 as printed
  double tolerance = 0.02;       ///< δ: the goal is reached at s ≥ 1 − δ [1]; 0 as printed
};

/// As Lindmark (2016) prints it: stages 2 to 4 then end by their time limit.
ProgressOptions faithful_progress();
/// "projected": the default; "faithful": faithful_progress(). Throws std::invalid_argument with the names.
ProgressOptions progress_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> progress_names = {"projected", "faithful"};

/// s [1]; 1 for a goal of no displacement.
double progress(const StageGoal& goal, const TipPose& start, const TipPose& now,
                const ProgressOptions& options = {});

bool goal_reached(double s, const ProgressOptions& options);

double translation_factor(double s, const ProgressOptions& options);
double rotation_factor(double s, const ProgressOptions& options);

}  // namespace drawpoint::engine::loading
