// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Figures of one loading cycle as panels of the report (study.hpp), and what they are made of. `who` begins
/// the caption: which cycle of which run.

#include <drawpoint/engine/loading/log/responses.hpp>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// Three decimals: millimetres, and the text of a number stays short.
nlohmann::json rounded(double value);
nlohmann::json rounded(const std::vector<double>& values);
std::string fixed(double value, int digits);

struct Rows {
  std::size_t first, last;  ///< half open
};
Rows rows_of(const engine::loading::LoadingLog& log, int cycle);
/// All values of a signal in one cycle: a line that leaves samples out hides its peaks.
std::vector<double> samples(const engine::loading::LoadingLog& log, const char* name, Rows rows);

/// In hinge G, its length as joint damage takes it: with the part about the pin, the tilt drive's, or without [kN m].
std::vector<double> hinge_torque(const engine::loading::LoadingLog& log, Rows rows,
                                 engine::loading::TorqueComponent component);

/// Planned and actual path of the cutting edge over the pile.
nlohmann::json path_panel(const engine::loading::LoadingLog& log, const engine::loading::CycleRecord& cycle,
                          const std::string& who, const std::string& title);

}  // namespace drawpoint::studies
