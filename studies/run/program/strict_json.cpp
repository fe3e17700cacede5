// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/program/strict_json.h>

#include <set>
#include <stdexcept>
#include <vector>

namespace drawpoint::studies {

nlohmann::json strict_json(const std::string& text) {
  using nlohmann::json;
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto once = [&](int, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw std::runtime_error("the key " + value.dump() + " stands twice in one object");
    return true;
  };
  return json::parse(text, once);
}

}  // namespace drawpoint::studies
