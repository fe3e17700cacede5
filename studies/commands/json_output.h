// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The one JSON object on the last line of standard output.

#include <cstdio>
#include <nlohmann/json.hpp>

namespace drawpoint::studies {

inline void print_json(const nlohmann::ordered_json& line) {
  std::printf("%s\n", line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

}  // namespace drawpoint::studies
