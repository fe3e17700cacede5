// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/strategy/planner.hpp>
#include <numeric>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::loading {
namespace {

[[noreturn]] void reject(const std::string& what, double value, const std::string& allowed) {
  throw std::invalid_argument("loading::" + what + " is " + std::to_string(value) + "; give " + allowed);
}

void require_share(const char* name, double value) {
  if (!(value >= 0 && value <= 1)) reject("Strategy: " + std::string(name) + " [1]", value, "0 to 1");
}

void require_finite_positive(const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value))
    reject("PlannerOptions: " + std::string(name), value, "a finite value above 0");
}

void check(const PlannerOptions& options) {
  require_finite_positive("bucket_volume [m3]", options.bucket_volume);
  require_finite_positive("bucket_width [m]", options.bucket_width);
  require_finite_positive("arm.FG [m]", options.arm.FG);
  require_finite_positive("arm.GK [m]", options.arm.GK);
  require_finite_positive("phi_max [rad]", options.phi_max);
  if (!(options.standoff >= 0) || !std::isfinite(options.standoff))
    reject("PlannerOptions: standoff [m]", options.standoff, "a finite value of at least 0");
  if (std::isnan(options.roof) || std::isnan(options.x_limit) || std::isnan(options.boom_max))
    throw std::invalid_argument(
        "loading::PlannerOptions: roof [m], x_limit [m] or boom_max [rad] is not a number; "
        "give numbers, infinity for no limit");
  for (const Eigen::Vector2d& point : options.outline)
    if (!point.allFinite())
      throw std::invalid_argument(
          "loading::PlannerOptions: a point of the outline [m] is not finite; give x and z of each");
}

// How high a point gets over the pivot that the bucket turns about, from one bucket angle to another.
double highest(const Eigen::Vector2d& point, double from, double to) {
  const double level = std::atan2(point.y(), point.x());
  if (level + from <= M_PI / 2 && M_PI / 2 <= level + to) return point.norm();
  return point.norm() * std::max(std::sin(level + from), std::sin(level + to));
}

// How high the bucket with its load gets over where the tip is at C, while it curls.
double room_over_tip(double tilt, const PlannerOptions& options) {
  const ArmGeometry& arm = options.arm;
  const Eigen::Vector2d tip = arm.GK * Eigen::Vector2d(std::cos(arm.psi_b), std::sin(arm.psi_b));
  const bool about_tip = options.curl == CurlMode::tip_fixed;
  const Eigen::Vector2d pivot = about_tip ? tip : Eigen::Vector2d(0, 0);
  const double end = std::max(tilt, options.phi_max);
  double room = highest(tip - pivot, tilt, end);
  for (const Eigen::Vector2d& point : options.outline)
    room = std::max(room, highest(point - pivot, tilt, end));
  return about_tip ? room : room - arm.GK * std::sin(tilt + arm.psi_b);
}

// How far the tip at C, so high, is ahead of the front tyres.
double tip_before_tyres(double height, double tilt, const PlannerOptions& options) {
  const ArmPose pose = arm_pose(options.arm, {.x = 0, .z = height, .phi = tilt});
  return -pose.q_d - options.tyre_reach;
}

// The greatest height at which the tyres have not followed the tip beyond B: bisection, as the room falls with height.
double height_for_tyres(double slope, double tilt, const PlannerOptions& options) {
  const auto fits = [&](double h) {
    return h / std::tan(slope) + options.tyre_room <= tip_before_tyres(h, tilt, options);
  };
  double low = 0, high = 10;
  if (!(slope > 0) || fits(high)) return high;
  for (int k = 0; k < 40; ++k) (fits(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

double reachable_height(double crest, double tilt, const PlannerOptions& options) {
  const double tip = tip_pose(options.arm, {.a = options.boom_max, .b = tilt + options.arm.psi_b}).z;
  return std::max(0.0, std::min({crest, tip, options.roof - room_over_tip(tilt, options)}));
}

// Depth gives way first; when the slope alone leads beyond the limit, so does the height.
void stay_before(double x_limit, Plan& plan) {
  const double room = std::max(0.0, x_limit - plan.toe);
  const double climb = plan.height > 0 ? plan.height / std::tan(plan.slope) : 0.0;
  if (plan.depth + climb <= room) return;
  plan.limited = true;
  plan.depth = std::max(0.0, std::min(plan.depth, room - climb));
  plan.height = std::min(plan.height, room * std::tan(plan.slope));
}

}  // namespace

void check(const Strategy& strategy) {
  if (!(strategy.alpha >= 0) || !std::isfinite(strategy.alpha))
    reject("Strategy: alpha [1]", strategy.alpha, "a finite value of at least 0 (studied: 0.2 to 2)");
  require_share("beta", strategy.beta);
  require_share("gamma", strategy.gamma);
  require_share("kappa", strategy.kappa);
}

double planned_depth(double height, double slope, double area) {
  if (area == 0) return 0;
  return 2 * area / (height + std::sqrt(height * height + 2 * slope * area));
}

int row_for(double gamma, const ColumnModel& model) {
  std::vector<int> order(model.rows.size());
  std::iota(order.begin(), order.end(), 0);
  const auto nanometres = [&](int row) { return std::llround(1e9 * model.rows[row].volume_centre); };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return nanometres(a) > nanometres(b); });
  return order.at(static_cast<std::size_t>(std::lround(gamma * static_cast<double>(order.size() - 1))));
}

Plan plan_trajectory(const Strategy& strategy, const ColumnModel& model, const PlannerOptions& options) {
  check(strategy);
  check(options);
  Plan plan;
  if (model.rows.empty()) {
    plan.message = "no place across the drift where the bucket fits and finds a pile";
    return plan;
  }
  plan.row = row_for(strategy.gamma, model);
  const Row& row = model.rows[plan.row];
  plan.feasible = true;
  plan.y = row.y;
  plan.slope = row.slope;
  plan.toe = row.front;
  plan.volume_centre = row.volume_centre;
  plan.crest = row.crest;
  plan.tilt = strategy.kappa * row.slope;
  plan.height_limit = std::min(reachable_height(row.crest, plan.tilt, options),
                               height_for_tyres(row.slope, plan.tilt, options));
  plan.height = strategy.beta * plan.height_limit;
  plan.area = strategy.alpha * options.bucket_volume / options.bucket_width;
  plan.depth = planned_depth(plan.height, plan.slope, plan.area);
  plan.phi_max = options.phi_max;
  plan.curl = options.curl;
  plan.lift = options.lift;
  stay_before(options.x_limit, plan);
  plan.corners = corner_points(plan, options.standoff, options.arm);
  return plan;
}

}  // namespace drawpoint::engine::loading
