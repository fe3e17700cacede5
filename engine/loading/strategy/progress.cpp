// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/strategy/progress.hpp>
#include <numbers>
#include <stdexcept>

namespace drawpoint::engine::loading {
namespace {

double clamped(double s) { return std::clamp(s, 0.0, 1.0); }

}  // namespace

ProgressOptions faithful_progress() {
  return {.mode = ProgressMode::faithful,
          .rotation = RotationLaw::linear,
          .angle_length = 1.0,
          .velocity_floor = 0,
          .tolerance = 0};
}

ProgressOptions progress_named(const std::string& name) {
  if (name == "projected") return {};
  if (name == "faithful") return faithful_progress();
  throw std::invalid_argument("loading::progress_named: there is no progress \"" + name +
                              "\"; choose projected or faithful");
}

double progress(const StageGoal& goal, const TipPose& start, const TipPose& now,
                const ProgressOptions& options) {
  const bool projected = options.mode == ProgressMode::projected;
  const double weight = projected ? options.angle_length * options.angle_length : 1.0;
  const double dx = now.x - start.x, dz = now.z - start.z, dphi = now.phi - start.phi;
  const double whole = goal.x * goal.x + goal.z * goal.z + weight * goal.phi * goal.phi;
  if (whole == 0) return 1;
  if (projected) return (dx * goal.x + dz * goal.z + weight * dphi * goal.phi) / whole;
  return std::sqrt((dx * dx + dz * dz + dphi * dphi) / whole);
}

bool goal_reached(double s, const ProgressOptions& options) { return s >= 1 - options.tolerance; }

double translation_factor(double s, const ProgressOptions& options) {
  const double c = clamped(s);
  return std::max(1 - c * c, options.velocity_floor);
}

double rotation_factor(double s, const ProgressOptions& options) {
  if (options.rotation == RotationLaw::as_translation) return translation_factor(s, options);
  const double factor = std::max(1 - clamped(s), options.velocity_floor);
  return options.rotation == RotationLaw::linear ? factor : factor / std::numbers::ln2;
}

}  // namespace drawpoint::engine::loading
