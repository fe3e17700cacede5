// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

#include "estimate.hpp"

/// An estimate in the results of a command.
namespace drawpoint::benchmarks {

/// mean and half_width, which is null for a single value.
inline nlohmann::json as_json(const Estimate& e) {
  nlohmann::json out{{"mean", e.mean}, {"half_width", nullptr}};
  if (std::isfinite(e.half_width)) out["half_width"] = e.half_width;
  return out;
}

}  // namespace drawpoint::benchmarks
