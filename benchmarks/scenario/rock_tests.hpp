// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/granular/calibration/rock_sample.hpp>
#include <functional>
#include <string>
#include <vector>

/// The tests of rock by name, what each measures, and what is published about it.
///
/// A published range is one for blasted rock, rockfill or coarse waste rock; it is for other rock than ours, with
/// fines, so what lies in it is plausible, and what lies outside needs a reason. Grades: "read" in the source or
/// in a text that quotes it, "recalled" from the literature and not read again.
namespace drawpoint::benchmarks {

struct MeasuredQuantity {
  std::string key, title;    ///< the title names the unit
  int digits = 1;            ///< after the point
  double low = 0, high = 0;  ///< published, `high` may be infinite; none when both are 0
  std::string source = {};
};

struct RockTestRun {
  engine::granular::RunStatus status = engine::granular::RunStatus::completed;
  int rocks = 0;
  std::vector<double> values;  ///< in the order of the quantities
};

/// What a user may choose beside the sample.
struct RockTestOptions {
  engine::granular::RunOptions run;
  int rocks = 300;             ///< of a poured heap
  double stress = 50e3;        ///< of the shear box [Pa]
  double edge_friction = 0.5;  ///< of rock on the edge [1]
  bool rough_walls = false;    ///< beside and behind the bank of the edge
};

struct RockTest {
  std::string name, what;
  std::vector<MeasuredQuantity> quantities;
  std::function<RockTestRun(const engine::granular::RockSample&, const RockTestOptions&)> run;
};

/// repose, ledge, tilt, density, shear, penetration, edge.
const std::vector<RockTest>& rock_tests();
/// Throws std::invalid_argument with the names there are.
const RockTest& rock_test_named(const std::string& name);

}  // namespace drawpoint::benchmarks
