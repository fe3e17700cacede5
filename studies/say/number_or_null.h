// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// JSON has no number that is not finite.

#include <cmath>
#include <nlohmann/json.hpp>

namespace drawpoint::studies {

inline nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

}  // namespace drawpoint::studies
