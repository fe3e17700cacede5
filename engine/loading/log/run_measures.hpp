// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <vector>

/// What a run costs and how it goes, beside its responses (responses.hpp): pure functions of the run log, one
/// value per cycle, in order. All throw std::invalid_argument naming what the log lacks (logs of older
/// versions lack tyre radius, bucket volumes, speed of the wheels and force on the bucket). A sample has the
/// weight that it has in joint_damage. Cost: one pass.
///
/// energy: ∫ Σ max(P, 0) dt over lift, tilt (P = force · speed) and drive (P = torque of the wheels / tyre's
/// free radius · speed of the body, so without what spinning wheels burn). Holding and braking recover
/// nothing. tracking error: √(∫ D² dt / ∫ dt) over stages 1 to 3, D the tip's distance from the planned path
/// up to the end of the curl, early or late. drive lag: mean over time of 1 − v / v_set while the drive is set
/// to more than 0.05 m/s, the share of the set speed that the body lacks, gaining speed included. wheel slip:
/// mean over time of 1 − v / v_w while the drive is set so and the tyres' rims run at v_w, more than 0.05 m/s;
/// tyres that roll do so at 0, within the few per cent by which a tyre's rolling radius is known. Both 0 for a
/// cycle that never drives forward. peak force on the bucket: largest magnitude of what rock and floor put on
/// it, on edge, plates and walls together, low-passed as the torque is in joint_damage. peak force in the pin:
/// of hinge G's force likewise; the bucket's own weight is in it. pin load range:
/// what fatigue sees of the bucket's hinge, unlike joint_damage, which sums the excess of its torque. The
/// hinge is two pins, `pin_spacing` apart, that share force F and off-axis torque M as two simple supports do
/// (left: F/2 and M_x / spacing, −M_z / spacing). The force across a pin's axis, in directions of the bucket
/// 15° apart, is counted over all cycles by rainflow.hpp and summed by Miner's rule; given is the range that
/// does the same damage once per loading cycle, in the worse pin and its worst direction. solid fill: volume
/// of the loaded rocks, without voids, over the bucket's struck volume; 1 − n for a level bucket of rock with
/// porosity n. struck fill: solid fill over that, with the porosity of loose_ore_porosity. heaped fill: the same over
/// the heaped volume, which is what a handbook's fill factor counts (Caterpillar Performance Handbook, 47th edition, of
/// rated bucket capacity): 0.80 to 0.95 in well blasted rock, 0.75 to 0.90 in average, 0.60 to 0.75 in poorly blasted
/// rock.
namespace drawpoint::engine::loading {

/// Porosity of the default rock in its mine's sizes, poured loosely (docs/decisions/0019)
/// [1].
inline constexpr double loose_ore_porosity = 0.41;

std::vector<double> cycle_time_by_cycle(const LoadingLog& log);        ///< [s]
std::vector<double> solid_fill_by_cycle(const LoadingLog& log);        ///< [1]
std::vector<double> energy_by_cycle(const LoadingLog& log);            ///< [kJ]
std::vector<double> energy_per_tonne_by_cycle(const LoadingLog& log);  ///< [kJ/t], +∞ if empty
std::vector<double> tracking_error_by_cycle(const LoadingLog& log);    ///< [m]
std::vector<double> drive_lag_by_cycle(const LoadingLog& log);         ///< [1]
std::vector<double> wheel_slip_by_cycle(const LoadingLog& log);        ///< [1]
std::vector<double> peak_bucket_force_by_cycle(const LoadingLog& log,
                                               double lowpass_hz = 20);  ///< [kN]; 0: no filter
std::vector<double> peak_pin_force_by_cycle(const LoadingLog& log,
                                            double lowpass_hz = 20);  ///< [kN]; 0: no filter

struct PinFatigueOptions {
  double exponent = 3;     ///< slope of the S-N line [1]; 3 for welds (EN 1993-1-9), 5 for machined steel
  double lowpass_hz = 20;  ///< corner [Hz]; 0: no filter
};
double pin_load_range(const LoadingLog& log, const PinFatigueOptions& options = {});  ///< [kN]

/// Measures of the whole run: the means over its cycles.
double cycle_time(const LoadingLog& log);
double solid_fill(const LoadingLog& log);
double struck_fill(const LoadingLog& log);
double heaped_fill(const LoadingLog& log);
double tracking_error(const LoadingLog& log);
double drive_lag(const LoadingLog& log);
double wheel_slip(const LoadingLog& log);
double peak_bucket_force(const LoadingLog& log, double lowpass_hz = 20);
double peak_pin_force(const LoadingLog& log, double lowpass_hz = 20);
/// ΣE / ΣM [kJ/t]: a cycle that comes back empty costs its energy. +∞ if nothing was loaded.
double energy_per_tonne(const LoadingLog& log);

}  // namespace drawpoint::engine::loading
