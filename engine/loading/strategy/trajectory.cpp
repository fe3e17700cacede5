// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/strategy/trajectory.hpp>
#include <stdexcept>

namespace drawpoint::engine::loading {
namespace {

// Tip after the curl about G, which stays, from a tip pose to a bucket angle.
TipPose curled_about_G(const TipPose& from, double phi, const ArmGeometry& arm) {
  const double b_from = from.phi + arm.psi_b, b_to = phi + arm.psi_b;
  return {.x = from.x + arm.GK * (std::cos(b_to) - std::cos(b_from)),
          .z = from.z + arm.GK * (std::sin(b_to) - std::sin(b_from)),
          .phi = phi};
}

TipPose curled(const Plan& plan, const TipPose& from, double phi, const ArmGeometry& arm) {
  if (plan.curl == CurlMode::tip_fixed) return {.x = from.x, .z = from.z, .phi = phi};
  return curled_about_G(from, phi, arm);
}

// What is left to go, up and in and nose up only.
StageGoal toward(const TipPose& place, const TipPose& now) {
  return {.x = std::max(place.x - now.x, 0.0),
          .z = std::max(place.z - now.z, 0.0),
          .phi = std::max(place.phi - now.phi, 0.0)};
}

}  // namespace

CurlMode curl_named(const std::string& name) {
  if (name == "hinge") return CurlMode::hinge_G;
  if (name == "tip") return CurlMode::tip_fixed;
  throw std::invalid_argument("loading::curl_named: there is no curl \"" + name + "\"; choose hinge or tip");
}

LiftGoal lift_named(const std::string& name) {
  if (name == "surface") return LiftGoal::behind_surface;
  if (name == "slope") return LiftGoal::along_slope;
  throw std::invalid_argument("loading::lift_named: there is no goal of the lift \"" + name +
                              "\"; choose surface or slope");
}

std::array<TipPose, 5> corner_points(const Plan& plan, double standoff, const ArmGeometry& arm) {
  const TipPose A{.x = plan.toe - standoff};
  const TipPose B{.x = plan.toe + plan.depth};
  TipPose C = B;
  if (plan.height > 0)
    C = {.x = B.x + plan.height / std::tan(plan.slope), .z = plan.height, .phi = plan.tilt};
  const TipPose D = curled(plan, C, plan.phi_max, arm);
  return {A, B, C, D, TipPose{.x = A.x, .z = D.z, .phi = D.phi}};
}

StageGoal stage_goal(const Plan& plan, int stage, const TipPose& now, const TipPose& cycle_start) {
  switch (stage) {
    case 1:
      return {.x = std::max(plan.toe + plan.depth - now.x, 0.0)};
    case 2:
      if (!(plan.height > 0)) return {};
      if (plan.lift == LiftGoal::along_slope)
        return {.x = plan.height / std::tan(plan.slope), .z = plan.height, .phi = plan.tilt};
      return toward(plan.corners[2], now);
    case 3:
      return {.phi = std::max(plan.phi_max - now.phi, 0.0)};
    case 4:
      return {.x = std::min(cycle_start.x - now.x, 0.0)};
    default:
      return {};
  }
}

std::vector<TipPose> planned_path(const Plan& plan, const ArmGeometry& arm, int arc_points) {
  const auto& [A, B, C, D, E] = plan.corners;
  std::vector<TipPose> path{A, B};
  if (plan.height > 0) path.push_back(C);
  for (int k = 1; k < arc_points; ++k)
    path.push_back(curled(plan, C, C.phi + (D.phi - C.phi) * k / arc_points, arm));
  path.push_back(D);
  path.push_back(E);
  return path;
}

}  // namespace drawpoint::engine::loading
