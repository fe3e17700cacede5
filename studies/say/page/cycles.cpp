// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/say/page/cycles.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace drawpoint::studies::detail {
namespace {

using nlohmann::json;

/// The number of the cycle that a panel names; empty where it names none or is no panel, which panels.h reports.
std::optional<int> cycle_of(const json& panel) {
  if (!panel.is_object() || !panel.contains("cycle") || !panel.at("cycle").is_number_integer()) return {};
  return panel.at("cycle").get<int>();
}

bool is_of(const json& panel, int cycle) { return cycle_of(panel).value_or(cycle) == cycle; }

/// Size of a panel as text, without the bodies and shapes, which scenes of a run share.
std::size_t bytes_of(const json& panel) {
  std::size_t bytes = 0;
  for (const auto& [name, value] : panel.items())
    if (name != "bodies" && name != "shapes")
      bytes += value.dump(-1, ' ', false, json::error_handler_t::replace).size();
  return bytes;
}

void share_bodies(json& panels) {
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const auto is_alike = [&](const json& other) {
      return other.contains("bodies") && other.at("bodies") == panels[k].at("bodies") &&
             other.at("shapes") == panels[k].at("shapes");
    };
    if (!panels[k].contains("bodies")) continue;
    const auto end = panels.begin() + static_cast<std::ptrdiff_t>(k);
    const auto first = std::find_if(panels.begin(), end, is_alike);
    if (first == end) continue;
    panels[k]["bodies_of"] = first - panels.begin();
    panels[k].erase("bodies");
    panels[k].erase("shapes");
  }
}

}  // namespace

std::vector<int> cycles_of(const json& panels) {
  std::vector<int> cycles;
  for (const json& panel : panels) {
    const std::optional<int> cycle = cycle_of(panel);
    if (cycle && std::find(cycles.begin(), cycles.end(), *cycle) == cycles.end()) cycles.push_back(*cycle);
  }
  return cycles;
}

json panels_of_cycle(const json& panels, int cycle) {
  json some = json::array();
  for (const json& panel : panels)
    if (is_of(panel, cycle)) some.push_back(panel);
  return some;
}

std::vector<int> fit_cycles(json& panels, std::size_t most_bytes) {
  const std::vector<int> cycles = cycles_of(panels);
  std::vector<int> left_out;
  std::size_t bytes = 0;
  for (const int cycle : cycles) {
    for (const json& panel : panels)
      if (cycle_of(panel) == cycle) bytes += bytes_of(panel);
    if (cycle != cycles.front() && bytes > most_bytes) left_out.push_back(cycle);
  }
  const auto fits = [&](const json& panel) {
    const std::optional<int> cycle = cycle_of(panel);
    return !cycle || std::find(left_out.begin(), left_out.end(), *cycle) == left_out.end();
  };
  json kept = json::array();
  std::copy_if(std::make_move_iterator(panels.begin()), std::make_move_iterator(panels.end()),
               std::back_inserter(kept), fits);
  share_bodies(kept);
  panels = std::move(kept);
  return left_out;
}

}  // namespace drawpoint::studies::detail
