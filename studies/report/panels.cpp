// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/report/panels.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace drawpoint::studies::detail {

namespace {

using nlohmann::json;
using Pose = std::array<double, 7>;

[[noreturn]] void reject_panel(const std::string& what) { throw std::invalid_argument(what); }

std::string quoted(const std::string& name) { return '"' + name + '"'; }

const json& member(const json& object, const char* name) {
  if (!object.is_object() || !object.contains(name)) reject_panel(quoted(name) + " is missing");
  return object.at(name);
}

const json& list(const json& object, const char* name) {
  const json& value = member(object, name);
  if (!value.is_array()) reject_panel(quoted(name) + " is not a list");
  return value;
}

void check_curve(const json& curve, const char* x, const char* y) {
  if (list(curve, x).size() != list(curve, y).size())
    reject_panel(quoted(x) + " and " + quoted(y) + " differ in length");
}

void check_path(const json& panel) {
  for (const char* name : {"contour", "planned", "actual"}) check_curve(member(panel, name), "x", "z");
  if (!panel.contains("stages")) return;
  for (const json& stage : list(panel, "stages")) {
    member(stage, "name");
    check_curve(stage, "x", "z");
  }
}

void check_lines(const json& panel) {
  for (const json& line : list(panel, "series")) {
    member(line, "name");
    check_curve(line, "x", "y");
  }
}

void check_table(const json& panel) {
  const std::size_t columns = list(panel, "columns").size();
  for (const json& row : list(panel, "rows"))
    if (!row.is_array() || row.size() != columns)
      reject_panel("a row has not as many cells as there are columns");
}

void check_shapes(const json& panel) {
  for (const json& shape : list(panel, "shapes")) {
    const std::size_t corners = list(shape, "vertices").size();
    for (const json& face : list(shape, "faces"))
      for (const json& corner : face)
        if (corner.get<std::size_t>() >= corners)
          reject_panel("a face names a vertex that its shape does not have");
  }
  const std::size_t shapes = panel.at("shapes").size();
  for (const json& body : list(panel, "bodies"))
    if (member(body, "shape").get<std::size_t>() >= shapes)
      reject_panel("a body names a shape that is not there");
}

void check_frames(const json& panel) {
  const json& frames = list(panel, "frames");
  if (frames.empty()) reject_panel("there are no frames");
  for (const json& frame : frames) {
    if (!member(frame, "t").is_number()) reject_panel("a frame's time is not a number");
    if (list(frame, "poses").size() != panel.at("bodies").size())
      reject_panel("a frame has not one pose for every body");
  }
  if (panel.value("poster_frame", std::size_t{0}) >= frames.size())
    reject_panel("the poster frame is not among the frames");
}

/// Poses of all frames in a row, absent bodies as NaN.
std::vector<Pose> read_poses(const json& frames) {
  std::vector<Pose> poses;
  for (const json& frame : frames)
    for (const json& pose : frame.at("poses")) {
      poses.emplace_back();
      poses.back().fill(std::numeric_limits<double>::quiet_NaN());
      if (!pose.is_null()) poses.back() = pose.get<Pose>();
    }
  return poses;
}

bool absent(const Pose& pose) {
  return !std::all_of(pose.begin(), pose.end(), [](double v) { return std::isfinite(v); });
}

struct Box {
  std::array<double, 3> origin{};
  double scale = 1.0;  ///< [m] a unit
};

Box box_around(const std::vector<Pose>& poses) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  Box box;
  double half_extent = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Pose& pose : poses) {
      if (absent(pose)) continue;
      low[k] = std::min(low[k], pose[k]);
      high[k] = std::max(high[k], pose[k]);
    }
    if (low[k] > high[k]) return box;
    box.origin[k] = 0.5 * (low[k] + high[k]);
    half_extent = std::max(half_extent, 0.5 * (high[k] - low[k]));
  }
  if (half_extent > 0.0) box.scale = half_extent / 32767.0;
  return box;
}

std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63u];
  }
  return text;
}

void append(std::string& bytes, double value) {
  const auto n = static_cast<std::uint16_t>(
      static_cast<std::int16_t>(std::lround(std::clamp(value, -32768.0, 32767.0))));
  bytes += static_cast<char>(n & 255u);
  bytes += static_cast<char>(n >> 8);
}

json packed(const std::vector<Pose>& poses) {
  const Box box = box_around(poses);
  std::string bytes;
  for (const Pose& pose : poses) {
    const bool gone = absent(pose);
    for (std::size_t k = 0; k < 7; ++k) {
      const double value = k < 3 ? (pose[k] - box.origin[k]) / box.scale : 32767.0 * pose[k];
      append(bytes, !gone ? std::max(value, -32767.0) : k == 0 ? -32768.0 : 0.0);
    }
  }
  return {{"data", base64(bytes)}, {"origin", box.origin}, {"scale", box.scale}};
}

json checked_scene(const json& panel) {
  check_shapes(panel);
  check_frames(panel);
  json scene = panel;
  scene["poses"] = packed(read_poses(panel.at("frames")));
  for (json& frame : scene["frames"]) frame.erase("poses");
  return scene;
}

json checked(const json& panel) {
  const std::string type = member(panel, "type").get<std::string>();
  for (const char* name : {"title", "caption"})
    if (!member(panel, name).is_string()) reject_panel(quoted(name) + " is not a text");
  if (type == "scene") return checked_scene(panel);
  if (type == "path")
    check_path(panel);
  else if (type == "lines")
    check_lines(panel);
  else if (type == "table")
    check_table(panel);
  else
    reject_panel("the type " + quoted(type) + " is none of path, scene, lines, table");
  return panel;
}

}  // namespace

json checked_panels(const json& panels, std::vector<std::string>& cautions) {
  json good = json::array();
  if (panels.is_null()) return good;
  if (!panels.is_array()) {
    cautions.push_back("The figures of the simulation were left out: they are not a list of panels.");
    return good;
  }
  for (std::size_t i = 0; i < panels.size(); ++i) {
    try {
      good.push_back(checked(panels[i]));
    } catch (const std::exception& error) {
      cautions.push_back("Figure " + std::to_string(i + 1) +
                         " of the simulation was left out: " + error.what() + ".");
    }
  }
  return good;
}

}  // namespace drawpoint::studies::detail
