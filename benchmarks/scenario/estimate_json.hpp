// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "estimate.hpp"

/// An estimate in the results of a command, and in the table that it prints.
namespace drawpoint::benchmarks {

/// mean and half_width, which is null for a single value.
inline nlohmann::json as_json(const Estimate& e) {
  nlohmann::json out{{"mean", e.mean}, {"half_width", nullptr}};
  if (std::isfinite(e.half_width)) out["half_width"] = e.half_width;
  return out;
}

/// "1.2 +- 0.3"; the mean alone where the width is null, "-" where the mean is.
inline std::string plus_minus(const nlohmann::json& mean, const nlohmann::json& width, int digits) {
  if (mean.is_null()) return "-";
  char text[64];
  if (width.is_null())
    std::snprintf(text, sizeof text, "%.*f", digits, mean.get<double>());
  else
    std::snprintf(text, sizeof text, "%.*f +- %.*f", digits, mean.get<double>(), digits, width.get<double>());
  return text;
}

}  // namespace drawpoint::benchmarks
