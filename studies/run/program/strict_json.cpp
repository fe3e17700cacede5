// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/program/strict_json.h>

#include <set>
#include <stdexcept>
#include <vector>

namespace drawpoint::studies {
namespace {

/// Without the name of the exception that stands before it in brackets.
std::string without_name(const std::string& message) {
  const auto end = message.find("] ");
  return message.starts_with('[') && end != std::string::npos ? message.substr(end + 2) : message;
}

}  // namespace

nlohmann::json strict_json(const std::string& text) {
  using nlohmann::json;
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto once = [&](int, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw std::runtime_error("is ambiguous: the key " + value.dump() + " stands twice in one object");
    return true;
  };
  try {
    return json::parse(text, once);
  } catch (const json::exception& e) {  // NaN and Infinity too, which some languages write as JSON
    throw std::runtime_error("is no JSON, whose numbers are finite: " + without_name(e.what()));
  }
}

}  // namespace drawpoint::studies
