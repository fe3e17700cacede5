// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The cycles of a run on one page: panels that name a "cycle" are shown one cycle at a time, and those that
/// a page has no room for are left out.

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

namespace drawpoint::studies::detail {

/// Numbers of the cycles that panels name, in the order in which they first do.
std::vector<int> cycles_of(const nlohmann::json& panels);

/// The panels of one cycle and those that name none.
nlohmann::json panels_of_cycle(const nlohmann::json& panels, int cycle);

/// Leaves out the last cycles of checked panels (panels.h) until the others have at most so many bytes as text,
/// shapes and bodies of scenes aside, but never the first cycle; returns those left out. A scene whose shapes
/// and bodies are those of an earlier one has "bodies_of" in their place, the number of that panel from 0.
std::vector<int> fit_cycles(nlohmann::json& panels, std::size_t most_bytes);

}  // namespace drawpoint::studies::detail
