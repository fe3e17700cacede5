// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/scenario.hpp>
#include <vector>

/// The crash that gives the yield torque τ_y of joint_damage, at the user's own step, stiffness and filter.
///
/// The machine stands on a level floor with its bucket's edge on it, as at the start of a cycle, a rock that
/// nothing moves stands in its way; it gains its drive-in speed as in a cycle, if the run-up is long enough, and
/// drives into the rock, wheels and cylinders holding what they are set to. τ_y is the largest magnitude of the
/// whole torque in hinge G from the first touch on, the tilt drive's moment about the pin included, as in joint_damage.
/// What twists the bucket, F · y for a push F at y from the middle, grows with `offset`. The peak of a nearly rigid
/// impact grows with stiffness and as 1/Δt: a figure belongs to the settings that it was found with; the low-pass of
/// joint_damage takes most of that away. Cost: some seconds of machine without a pile, about 0.1 s of processor time
/// each. Deterministic. Source: Lindmark 2016, 145 kN m; place and size of the rock are not given there and are chosen
/// here.
namespace drawpoint::engine::loading {

struct YieldTestOptions {
  double rock_size = 1.0;  ///< longest dimension of the rock [m], 0.3 to 3
  double offset = 0;       ///< of the rock from the middle of the edge, to the left [m], within half a bucket
  double lowpass_hz = 20;  ///< corner, as in DamageOptions [Hz]; 0: no filter
  double run_up = 3;       ///< from edge to rock at the start [m]
  double after_touch = 1.0;  ///< that is looked at [s]
};

struct YieldTest {
  double touch_speed = 0;            ///< of the machine as it touches the rock [m/s]
  double peak = 0;                   ///< largest magnitude in hinge G [N m]
  double peak_twisting = 0;          ///< of its two components across the pin [N m]
  double unfiltered_peak = 0;        ///< as `peak`, without the low-pass [N m]
  std::vector<double> time, torque;  ///< from the touch on [s], low-passed magnitude [N m]
  std::vector<double> twisting;      ///< of the two components across the pin alone [N m]
};

/// Machine, speeds, materials and solver are the scenario's. Throws std::invalid_argument naming the value and what is
/// allowed; std::runtime_error if the machine does not come to the rock.
YieldTest yield_test(const Scenario& scenario, const YieldTestOptions& options = {});

}  // namespace drawpoint::engine::loading
