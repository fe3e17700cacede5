// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/say/page/panels.h>
#include <drawpoint/studies/say/page/scene_tracks.h>

#include <algorithm>
#include <stdexcept>

namespace drawpoint::studies::detail {

namespace {

using nlohmann::json;

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

void check_plan(const json& panel) {
  const std::size_t across = list(panel, "y").size(), along = list(panel, "x").size();
  if (along == 0 || list(panel, "heights").size() != across)
    reject_panel("\"heights\" has not one row per value of \"y\"");
  for (const json& row : panel.at("heights"))
    if (!row.is_array() || row.size() != along)
      reject_panel("a row of \"heights\" has not one value per value of \"x\"");
  const auto two = [](const json& object, const char* name) {
    if (list(object, name).size() != 2) reject_panel(quoted(name) + " has not two values");
  };
  two(panel, "walls");
  for (const json& curve : list(panel, "curves")) {
    member(curve, "name");
    check_curve(curve, "x", "y");
  }
  for (const char* name : {"x", "y"}) two(member(panel, "place"), name);
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

void check_signals(const json& panel) {
  if (!panel.contains("signals")) return;
  for (const json& signal : list(panel, "signals")) {
    for (const char* name : {"name", "unit"})
      if (!member(signal, name).is_string()) reject_panel(quoted(name) + " of a signal is not a text");
    check_curve(signal, "t", "y");
    if (!signal.contains("lines")) continue;
    for (const json& limit : list(signal, "lines"))
      if (!member(limit, "name").is_string() || !member(limit, "y").is_number())
        reject_panel("a line of a signal has no name or no number y");
  }
}

void check_drift(const json& panel) {
  if (!panel.contains("drift")) return;
  const json &drift = panel.at("drift"), &raise = member(drift, "raise");
  const auto number = [](const json& object, const char* name) {
    const json& value = member(object, name);
    if (!value.is_number()) reject_panel(quoted(name) + " of the drift is not a number");
    return value.get<double>();
  };
  number(raise, "x");
  const bool long_enough = number(drift, "length") > number(drift, "from");
  if (!long_enough || number(drift, "width") <= 0 || number(drift, "height") <= 0 ||
      number(raise, "radius") <= 0)
    reject_panel(
        "the drift has no extent: its length lies beyond \"from\", its width, height and radius above 0");
}

json checked_scene(const json& panel) {
  check_shapes(panel);
  check_drift(panel);
  check_signals(panel);
  list(panel, "frames");
  if (panel.contains("follow") && panel.at("follow").get<std::size_t>() >= panel.at("bodies").size())
    reject_panel("the body to follow is not there");
  json scene = panel;
  scene["poses"] = packed_tracks(panel);
  for (json& frame : scene["frames"]) frame.erase("poses");
  for (json& body : scene["bodies"]) body.erase("track");
  return scene;
}

json checked(const json& panel) {
  const std::string type = member(panel, "type").get<std::string>();
  for (const char* name : {"title", "caption"})
    if (!member(panel, name).is_string()) reject_panel(quoted(name) + " is not a text");
  if (panel.contains("cycle") && !(panel.at("cycle").is_number_integer() && panel.at("cycle") >= 1))
    reject_panel("\"cycle\" is not a whole number from 1");
  if (panel.contains("note") && !panel.at("note").is_string()) reject_panel("\"note\" is not a text");
  if (panel.contains("in_scene") && !panel.at("in_scene").is_boolean())
    reject_panel("\"in_scene\" is neither true nor false");
  if (type == "scene") return checked_scene(panel);
  if (type == "path")
    check_path(panel);
  else if (type == "plan")
    check_plan(panel);
  else if (type == "lines")
    check_lines(panel);
  else if (type == "table")
    check_table(panel);
  else
    reject_panel("the type " + quoted(type) + " is none of path, plan, scene, lines, table");
  return panel;
}

}  // namespace

json without_repeated(json panels) {
  const auto cycle_of = [](const json& panel) { return panel.value("cycle", 0); };
  std::vector<int> shown;
  for (const json& panel : panels)
    if (panel.at("type") == "scene") shown.push_back(cycle_of(panel));
  json others = json::array();
  for (json& panel : panels) {
    const bool of_a_cycle = cycle_of(panel) != 0;
    const bool beside =
        of_a_cycle ? std::find(shown.begin(), shown.end(), cycle_of(panel)) != shown.end() : !shown.empty();
    if (!beside || !panel.value("in_scene", false)) others.push_back(std::move(panel));
  }
  return others;
}

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
