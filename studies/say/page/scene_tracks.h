// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Checks where the bodies of a scene are, and packs it, which is most of a report's size.
///
/// Packed, a body has poses in some frames and goes evenly between them. All bodies' poses stand one after
/// the other: how many each body has, the frame of each (16 bits) and seven 16-bit integers, base64:
/// position = origin + scale·n, quaternion = n/32767, n = -32768 first for a body that hides. Positions keep
/// 1/65534 of the largest extent of the movement, half a millimetre in a 30 m scene.

#include <nlohmann/json.hpp>

namespace drawpoint::studies::detail {

/// "counts", "frames", "data", "origin", "scale" of a scene whose shapes and bodies are sound. Throws
/// std::invalid_argument, or what nlohmann throws, saying what is wrong.
nlohmann::json packed_tracks(const nlohmann::json& scene);

}  // namespace drawpoint::studies::detail
