// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading_panels.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace drawpoint::studies {

using engine::loading::CycleRecord;
using engine::loading::LoadingLog;
using engine::loading::values_per_pose;
using nlohmann::json;

namespace {

constexpr double picture_interval = 0.5;  // of the replay [s]; keeps the page light

}  // namespace

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
                      ", from the side. The pile's contour is the mean over the "
                      "bucket's breadth before "
                      "the cycle; planned depth " +
                      fixed(cycle.plan.depth, 2) + " m, height " + fixed(cycle.plan.height, 2) +
                      " m, slope " + fixed(cycle.plan.slope * 180 / M_PI, 0) + " deg."},
      {"x_label", "along the drift [m]"},
      {"z_label", "height [m]"},
      {"contour", {{"x", rounded(cycle.contour_x)}, {"z", rounded(cycle.contour_z)}}},
      {"planned", {{"x", rounded(cycle.planned_x)}, {"z", rounded(cycle.planned_z)}}},
      {"actual", {{"x", rounded(samples(log, "tip_x", rows))}, {"z", rounded(samples(log, "tip_z", rows))}}},
      {"stages", stage_paths(log, rows)}};
}

namespace {

json shape_of(const engine::ConvexPolyhedron& shape) {
  json vertices = json::array();
  for (const auto& v : shape.vertices()) vertices.push_back({rounded(v.x()), rounded(v.y()), rounded(v.z())});
  return {{"vertices", vertices}, {"faces", shape.faces()}};
}

json poses_of(const engine::loading::SceneFrame& frame) {
  json poses = json::array();
  for (std::size_t b = 0; b + values_per_pose <= frame.poses.size(); b += values_per_pose) {
    if (std::isnan(frame.poses[b])) {
      poses.push_back(nullptr);
      continue;
    }
    json pose = json::array();
    for (std::size_t k = 0; k < values_per_pose; ++k) pose.push_back(rounded(frame.poses[b + k]));
    poses.push_back(pose);
  }
  return poses;
}

// "curl, 3.2 t in the bucket"; logs of version 4 do not know the mass.
std::string label_of(const engine::loading::SceneFrame& frame) {
  if (std::isnan(frame.bucket_mass)) return frame.label;
  return frame.label + ", " + fixed(1e-3 * frame.bucket_mass, 1) + " t in the bucket";
}

}  // namespace

json scene_panel(const LoadingLog& log, const CycleRecord& cycle, const std::string& who,
                 const std::string& title) {
  json shapes = json::array(), bodies = json::array(), frames = json::array();
  for (const auto& shape : log.scene.shapes) shapes.push_back(shape_of(shape));
  for (const auto& body : log.scene.bodies)
    bodies.push_back(
        {{"shape", body.shape}, {"color", body.color}, {"opacity", body.opacity}, {"name", body.name}});
  int poster = 0;
  double next = -1;
  for (const auto& frame : log.scene.frames) {
    if (frame.cycle != cycle.number || frame.t < next) continue;
    next = frame.t + picture_interval - 1e-6;
    if (frame.label == "curl") poster = static_cast<int>(frames.size());
    frames.push_back(
        {{"t", rounded(frame.t - cycle.t_start)}, {"label", label_of(frame)}, {"poses", poses_of(frame)}});
  }
  const double toe = cycle.plan.toe;
  return {{"type", "scene"},
          {"title", title},
          {"caption", who + ": drag to turn, wheel to zoom, play to watch it load. Walls and roof are drawn "
                            "transparent."},
          {"shapes", shapes},
          {"bodies", bodies},
          {"frames", frames},
          {"camera", {{"eye", {toe - 3.5, -11.0, 5.5}}, {"target", {toe - 1.2, 0.0, 1.3}}}},
          {"poster_frame", poster}};
}

}  // namespace drawpoint::studies
