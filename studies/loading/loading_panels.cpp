// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_panels.h>
#include <drawpoint/engine/loading/log/hinge_torque.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace drawpoint::studies {

using engine::loading::CycleRecord;
using engine::loading::LoadingLog;
using nlohmann::json;

// Three decimals: millimetres, and the text of a number stays short.
json rounded(double value) { return std::round(value * 1e3) / 1e3; }
json rounded(const std::vector<double>& values) {
  json out = json::array();
  for (double value : values) out.push_back(rounded(value));
  return out;
}

std::string fixed(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

Rows rows_of(const LoadingLog& log, int cycle) {
  const std::vector<double> column = log.signals.column("cycle");
  const auto begin = std::lower_bound(column.begin(), column.end(), cycle);
  const auto end = std::upper_bound(column.begin(), column.end(), cycle);
  return {static_cast<std::size_t>(begin - column.begin()), static_cast<std::size_t>(end - column.begin())};
}

// All values of a signal in one cycle: a line that leaves samples out hides its peaks.
std::vector<double> samples(const LoadingLog& log, const char* name, Rows rows) {
  const std::size_t column = log.signals.index(name);
  std::vector<double> out;
  for (std::size_t r = rows.first; r < rows.last; ++r) out.push_back(log.signals.at(r, column));
  return out;
}

std::vector<double> hinge_torque(const LoadingLog& log, Rows rows,
                                 engine::loading::TorqueComponent component) {
  const engine::loading::HingeTorque whole(log);
  const bool all = component == engine::loading::TorqueComponent::all;
  std::vector<double> torque;
  for (std::size_t row = rows.first; row < rows.last; ++row) {
    const Eigen::Vector3d T = whole.at(row);
    torque.push_back(1e-3 * (all ? T.norm() : std::hypot(T.x(), T.z())));
  }
  return torque;
}

namespace {

json stage_paths(const LoadingLog& log, Rows rows) {
  const std::vector<double> stage = samples(log, "stage", rows), x = samples(log, "tip_x", rows),
                            z = samples(log, "tip_z", rows);
  json stages = json::array();
  for (int k = 1; k <= 4; ++k) {
    json xs = json::array(), zs = json::array();
    for (std::size_t i = 0; i < stage.size(); ++i)
      if (stage[i] == k) {
        xs.push_back(rounded(x[i]));
        zs.push_back(rounded(z[i]));
      }
    stages.push_back(
        {{"name", std::string(name(static_cast<engine::loading::Stage>(k)))}, {"x", xs}, {"z", zs}});
  }
  return stages;
}

}  // namespace

json path_panel(const LoadingLog& log, const CycleRecord& cycle, const std::string& who,
                const std::string& title) {
  const Rows rows = rows_of(log, cycle.number);
  return {
      {"type", "path"},
      {"title", title},
      {"caption", who +
                      ", from the side. The pile's contour is the mean over the bucket's breadth before the "
                      "cycle; planned depth " +
                      fixed(cycle.plan.depth, 2) + " m, height " + fixed(cycle.plan.height, 2) +
                      " m, slope " + fixed(cycle.plan.slope * 180 / M_PI, 0) + " deg."},
      {"x_label", "along the drift [m]"},
      {"z_label", "height [m]"},
      {"contour", {{"x", rounded(cycle.contour_x)}, {"z", rounded(cycle.contour_z)}}},
      {"planned", {{"x", rounded(cycle.planned_x)}, {"z", rounded(cycle.planned_z)}}},
      {"actual", {{"x", rounded(samples(log, "tip_x", rows))}, {"z", rounded(samples(log, "tip_z", rows))}}},
      {"stages", stage_paths(log, rows)}};
}

}  // namespace drawpoint::studies
