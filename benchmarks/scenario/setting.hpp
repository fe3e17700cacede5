// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/world.hpp>
#include <string>

/// A choice of step and work of the solver, in one word: STEPxSUBSTEPSxSWEEPS, with +SPARE for spare work.
/// "10x16x1+20000" is 10 ms, 16 substeps of at least one sweep, and more up to 20 000 sweeps times points.
namespace drawpoint::benchmarks {

struct Setting {
  double step = 0;  ///< [s]
  int substeps = 1, sweeps = 1, spare_work = 0;
};

/// Throws std::invalid_argument with the text, the form and the ranges: 0.01 to 10 ms, up to 1000 substeps,
/// 1e6 sweeps, 1e9 spare work.
Setting setting_of(const std::string& text);
std::string name_of(const Setting& setting);

/// The options with this step and work; all else stays.
engine::WorldOptions with(engine::WorldOptions options, const Setting& setting);

}  // namespace drawpoint::benchmarks
