// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <string>
#include <string_view>

/// The three responses of the loading study and what tells how far to trust them, pure functions of a run
/// log. All throw std::invalid_argument when the log lacks what they need.
///
/// production: c₁ = mean over cycles of M_i / (T_i + h) [kg/s], to be maximised; M the loaded mass, T from
/// the start of stage 1 to the end of stage 4, h the time of a cycle away from the pile, 0 in the source:
/// there a quick small load counts as much as a slow large one. The other aggregation is ΣM / Σ(T + h).
///
/// joint_damage: c₂ = (1/τ_y) Σ max(T_i − τ_y, 0) Δt [s]; T_i the magnitude of the whole torque in bucket hinge G, the
/// tilt drive's moment about the pin included (hinge_torque.hpp), or of its two components across the pin alone, which
/// twist the bucket. Summed over the cycles of the run; one that broke down, or was left out because the mean was known
/// (Scenario::precision), counts with the mean of the others. A sample stands for the time since the one before it in
/// the same cycle, a cycle's first sample for the time to the next.
/// Low-pass: y += (1 − exp(−2π f Δt)) (x − y) on each component, started anew with each cycle: a rigid
/// impact's peak grows as 1/Δt, and unfiltered it would make the response a function of the time step.
///
/// rock_spill: c₃ = mean over cycles of m / m_max [1]. m is the rock that the bucket held when it held most and no
/// longer holds at the end of the cycle, by the rocks whose centre is in its heap. SpillLaw::before_front, the source's
/// own: all rock before the pile's front (rock_left.hpp), which measures the scatter of the toe more than the strategy;
/// the log must then have been read with its scene.
///
/// Source: Lindmark 2016, equations 54-56; aggregation, filter and what was lost are ours.
namespace drawpoint::engine::loading {

enum class ProductionMean { of_ratios, ratio_of_sums };

struct ProductionOptions {
  ProductionMean mean = ProductionMean::of_ratios;
  double haul = 0;  ///< h: haul, dump and way back [s], >= 0
};

enum class TorqueComponent { all, twisting };
/// By name. Throws std::invalid_argument with the names.
TorqueComponent torque_component_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> torque_component_names = {"all", "twisting"};

enum class DamageSum { whole_run, per_cycle };

struct DamageOptions {
  double tau_y = 145e3;  ///< yield torque [N m]; Lindmark's calibration
  TorqueComponent component = TorqueComponent::all;
  double lowpass_hz = 20;  ///< corner [Hz]; 0: no filter
  DamageSum sum = DamageSum::whole_run;
};

enum class SpillLaw { lost, before_front };
/// By name. Throws std::invalid_argument with the names.
SpillLaw spill_law_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> spill_law_names = {"lost", "before_front"};

struct SpillOptions {
  double m_max = 10000;  ///< mass in front of the pile that would stop the work [kg]; only scales
  SpillLaw law = SpillLaw::lost;
};

/// Each response's share of every cycle, in order: M_i / (T_i + h) [kg/s]; Σ of the excess torque [s], whose
/// sum is the run's damage; m_i / m_max [1].
std::vector<double> production_by_cycle(const LoadingLog& log, const ProductionOptions& options = {});
std::vector<double> joint_damage_by_cycle(const LoadingLog& log, const DamageOptions& options = {});
std::vector<double> rock_spill_by_cycle(const LoadingLog& log, const SpillOptions& options = {});
/// m_lost [kg].
std::vector<double> lost_mass_by_cycle(const LoadingLog& log);

/// Loaded mass over the rated payload, mean over the cycles [1].
double fill_factor(const LoadingLog& log);
/// Whether a stage ended at its goal, not by time or a slow actuator; true for a stage that was left out.
bool reached_goal(const CycleRecord& cycle, Stage stage);
/// Share of the cycles whose drive-in did not [1].
double stall_share(const LoadingLog& log);

double production(const LoadingLog& log, const ProductionOptions& options = {});
/// Standard error of the mean production over that mean, by the scatter of the run's cycles alone [1]: of k
/// cycles it is known to 1/√(2(k − 1)) of itself. +∞ for one cycle and for a run that loaded nothing.
double relative_production_error(const LoadingLog& log, const ProductionOptions& options = {});
double joint_damage(const LoadingLog& log, const DamageOptions& options = {});
double rock_spill(const LoadingLog& log, const SpillOptions& options = {});

/// Standard errors of the three, in their units, by the scatter of the run's cycles alone: of k cycles known to
/// 1/√(2(k − 2)) of themselves, as the first, which meets a fresh pile and loads more in every run, shows nothing
/// of scatter; that of two cycles has this in it. They take cycles as independent. One cycle of one that was wanted
/// tells none: 0; one that is left of several tells as little: the response itself.
double production_standard_error(const LoadingLog& log, const ProductionOptions& options = {});  // of_ratios
double joint_damage_standard_error(const LoadingLog& log, const DamageOptions& options = {});
double rock_spill_standard_error(const LoadingLog& log, const SpillOptions& options = {});

/// Cycles that the run's sums are of: done, lost or left out [1].
double counted_cycles(const LoadingLog& log);

}  // namespace drawpoint::engine::loading
