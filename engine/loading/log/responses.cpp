// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/log/cycle_samples.hpp>
#include <drawpoint/engine/loading/log/hinge_torque.hpp>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/log/rock_left.hpp>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace drawpoint::engine::loading {
namespace {

using Eigen::Vector3d;

void require_cycles(const LoadingLog& log, const char* response) {
  if (log.cycles.empty())
    throw std::invalid_argument("loading::" + std::string(response) +
                                ": the log has no cycle; give the log of a run that loaded at least once");
}

void require_positive(const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw std::invalid_argument("loading::" + std::string(name) + " is " + std::to_string(value) +
                                "; give a finite value above 0");
}

double duration(const CycleRecord& cycle) {
  const double seconds = cycle.seconds();
  if (!(seconds > 0))
    throw std::invalid_argument("loading::production: a cycle lasts " + std::to_string(seconds) +
                                " s; a cycle's t_end [s] must be after its t_start [s]");
  return seconds;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double number_or_0(const LoadingLog& log, const char* name) {
  const auto found = log.numbers.find(name);
  return found == log.numbers.end() ? 0.0 : found->second;
}

/// Standard error of the mean of two values or more.
double error_of_mean(const std::vector<double>& values) {
  const double all = mean(values), k = static_cast<double>(values.size());
  double squares = 0;
  for (const double value : values) squares += (value - all) * (value - all);
  return std::sqrt(squares / (k - 1) / k);
}

/// The same where there may be one value, of as many as were wanted. The first cycle meets a fresh pile and loads more
/// than those after it in every run: that is no scatter, so from three cycles on the later ones alone tell it.
double error_of_cycles(const std::vector<double>& by_cycle, double wanted) {
  const double n = static_cast<double>(by_cycle.size());
  if (n >= 3) return error_of_mean({by_cycle.begin() + 1, by_cycle.end()}) * std::sqrt((n - 1) / n);
  if (n == 2) return error_of_mean(by_cycle);
  return wanted > 1 ? std::abs(by_cycle.front()) : 0.0;
}

double magnitude(const Vector3d& torque, TorqueComponent component) {
  return component == TorqueComponent::all ? torque.norm() : std::hypot(torque.x(), torque.z());
}

}  // namespace

TorqueComponent torque_component_named(const std::string& name) {
  if (name == "all") return TorqueComponent::all;
  if (name == "twisting") return TorqueComponent::twisting;
  throw std::invalid_argument("loading::torque_component_named: there is no part of the torque \"" + name +
                              "\"; choose all or twisting");
}

SpillLaw spill_law_named(const std::string& name) {
  if (name == "lost") return SpillLaw::lost;
  if (name == "before_front") return SpillLaw::before_front;
  throw std::invalid_argument("loading::spill_law_named: there is no spill \"" + name +
                              "\"; choose lost or before_front");
}

std::vector<double> production_by_cycle(const LoadingLog& log, const ProductionOptions& options) {
  require_cycles(log, "production");
  if (!(options.haul >= 0))
    throw std::invalid_argument("loading::production: haul is " + std::to_string(options.haul) +
                                " s; allowed are times from 0 s on");
  std::vector<double> rates;
  for (const CycleRecord& cycle : log.cycles)
    rates.push_back(cycle.loaded_mass / (duration(cycle) + options.haul));
  return rates;
}

double production(const LoadingLog& log, const ProductionOptions& options) {
  const std::vector<double> rates = production_by_cycle(log, options);
  if (options.mean == ProductionMean::of_ratios) return mean(rates);
  double mass = 0, time = 0;
  for (const CycleRecord& cycle : log.cycles) {
    mass += cycle.loaded_mass;
    time += duration(cycle) + options.haul;
  }
  return mass / time;
}

double relative_production_error(const LoadingLog& log, const ProductionOptions& options) {
  const std::vector<double> rates = production_by_cycle(log, options);
  const double all = mean(rates);
  if (rates.size() < 2 || !(all > 0)) return std::numeric_limits<double>::infinity();
  return error_of_mean(rates) / all;
}

double production_standard_error(const LoadingLog& log, const ProductionOptions& options) {
  if (options.mean != ProductionMean::of_ratios)
    throw std::invalid_argument(
        "loading::production_standard_error: of the ratio of sums it is not known; take the mean of ratios");
  return error_of_cycles(production_by_cycle(log, options), counted_cycles(log));
}

std::vector<double> joint_damage_by_cycle(const LoadingLog& log, const DamageOptions& options) {
  require_cycles(log, "joint_damage");
  require_positive("DamageOptions: tau_y [N m]", options.tau_y);
  if (!(options.lowpass_hz >= 0))
    throw std::invalid_argument("loading::DamageOptions: lowpass_hz [Hz] is " +
                                std::to_string(options.lowpass_hz) + "; give 0 (none) or more");
  const CycleSamples samples(log);
  const HingeTorque whole(log);
  LowPassedVector torque([&](std::size_t row) { return whole.at(row); }, options.lowpass_hz);
  std::vector<double> damage(log.cycles.size());
  for (std::size_t row = 0; row < samples.rows(); ++row) {
    const double excess = magnitude(torque.next(samples), options.component) / options.tau_y - 1;
    if (const auto cycle = samples.cycle(row)) damage[*cycle] += std::max(excess, 0.0) * samples.weight(row);
  }
  return damage;
}

double joint_damage(const LoadingLog& log, const DamageOptions& options) {
  const std::vector<double> damage = joint_damage_by_cycle(log, options);
  if (options.sum == DamageSum::per_cycle) return mean(damage);
  const double done = static_cast<double>(damage.size());
  return std::accumulate(damage.begin(), damage.end(), 0.0) * (counted_cycles(log) / done);
}

double joint_damage_standard_error(const LoadingLog& log, const DamageOptions& options) {
  const double of_mean = error_of_cycles(joint_damage_by_cycle(log, options), counted_cycles(log));
  return options.sum == DamageSum::per_cycle ? of_mean : of_mean * counted_cycles(log);
}

double rock_spill_standard_error(const LoadingLog& log, const SpillOptions& options) {
  return error_of_cycles(rock_spill_by_cycle(log, options), counted_cycles(log));
}

double counted_cycles(const LoadingLog& log) {
  return static_cast<double>(log.cycles.size()) + number_or_0(log, "lost_cycles") +
         number_or_0(log, "left_out_cycles");
}

std::vector<double> lost_mass_by_cycle(const LoadingLog& log) {
  require_cycles(log, "rock_spill");
  std::vector<double> lost;
  for (const CycleRecord& cycle : log.cycles) {
    double most = 0, last = std::numeric_limits<double>::quiet_NaN();
    for (const SceneFrame& frame : log.scene.frames) {
      if (frame.cycle != cycle.number) continue;
      last = frame.bucket_mass;
      most = std::max(most, last);
    }
    if (std::isnan(last))
      throw std::invalid_argument("loading::rock_spill: the log does not say what the bucket held in cycle " +
                                  std::to_string(cycle.number) +
                                  "; give a log of version 5 or later, read with its frames");
    lost.push_back(most - last);
  }
  return lost;
}

std::vector<double> rock_spill_by_cycle(const LoadingLog& log, const SpillOptions& options) {
  require_positive("SpillOptions: m_max [kg]", options.m_max);
  std::vector<double> shares;
  if (options.law == SpillLaw::lost)
    shares = lost_mass_by_cycle(log);
  else
    for (const RockLeft& left : rock_left_by_cycle(log)) shares.push_back(left.before_front);
  for (double& share : shares) share /= options.m_max;
  return shares;
}

double rock_spill(const LoadingLog& log, const SpillOptions& options) {
  return mean(rock_spill_by_cycle(log, options));
}

double fill_factor(const LoadingLog& log) {
  require_cycles(log, "fill_factor");
  const auto payload = log.numbers.find("payload");
  if (payload == log.numbers.end() || !(payload->second > 0))
    throw std::invalid_argument(
        "loading::fill_factor: the log names no payload [kg] above 0; give the log of a simulated run");
  std::vector<double> shares;
  for (const CycleRecord& cycle : log.cycles) shares.push_back(cycle.loaded_mass / payload->second);
  return mean(shares);
}

bool reached_goal(const CycleRecord& cycle, Stage stage) {
  for (const StageResult& result : cycle.stages)
    if (result.stage == stage) return result.reason == StageEnd::goal;
  return true;
}

double stall_share(const LoadingLog& log) {
  require_cycles(log, "stall_share");
  double stalls = 0;
  for (const CycleRecord& cycle : log.cycles) stalls += reached_goal(cycle, Stage::drive_in) ? 0 : 1;
  return stalls / static_cast<double>(log.cycles.size());
}

}  // namespace drawpoint::engine::loading
