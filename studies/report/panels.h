// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Checks the panels of a report and packs the scenes' poses, which are most of a report's size.
///
/// Packed, a pose is seven 16-bit integers, base64: position = origin + scale·n, quaternion = n/32767, n =
/// -32768 first for an absent body. Positions keep 1/65534 of the largest extent of the movement, half a
/// millimetre in a 30 m scene.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drawpoint::studies::detail {

/// The panels that can be drawn; a sentence for each that cannot goes to cautions.
nlohmann::json checked_panels(const nlohmann::json& panels, std::vector<std::string>& cautions);

}  // namespace drawpoint::studies::detail
