// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <drawpoint/engine/loading/log/cycle_samples.hpp>
#include <drawpoint/engine/loading/log/rainflow.hpp>
#include <drawpoint/engine/loading/log/run_measures.hpp>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace drawpoint::engine::loading {
namespace {

constexpr double least_drive = 0.05;  // of the set speed, below which there is no slip to speak of [m/s]

void require_measured_cycles(const LoadingLog& log) {
  if (log.cycles.empty())
    throw std::invalid_argument(
        "loading::run_measures: the log has no cycle; give the log of a run that loaded at least once");
}

double positive_number(const LoadingLog& log, const std::string& name, const std::string& unit) {
  const auto found = log.numbers.find(name);
  if (found == log.numbers.end() || !(found->second > 0))
    throw std::invalid_argument("loading::run_measures: the log names no " + name + " [" + unit +
                                "] above 0; give the log of a run of this version");
  return found->second;
}

double mean_over_cycles(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double per_tonne(double energy, double mass) {
  return mass > 0 ? energy / (mass / 1000) : std::numeric_limits<double>::infinity();
}

// A row's quantity, and 1 where the average over time counts the row, else 0.
using Pair = std::array<double, 2>;

// Time integrals per cycle.
std::vector<Pair> integrals(const LoadingLog& log,
                            const std::function<Pair(std::size_t row, std::size_t cycle)>& of_row) {
  require_measured_cycles(log);
  const CycleSamples samples(log);
  std::vector<Pair> sums(log.cycles.size(), {0, 0});
  for (std::size_t row = 0; row < samples.rows(); ++row) {
    const auto cycle = samples.cycle(row);
    if (!cycle) continue;
    const Pair values = of_row(row, *cycle);
    for (std::size_t k = 0; k < 2; ++k) sums[*cycle][k] += values[k] * samples.weight(row);
  }
  return sums;
}

double squared_distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                                   const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length = along.squaredNorm();
  const double s = length > 0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (a + s * along - p).squaredNorm();
}

// From the planned path without its last leg, on which the machine backs out.
double squared_distance_to_plan(const Eigen::Vector2d& p, const CycleRecord& cycle) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 2 < cycle.planned_x.size(); ++k)
    least = std::min(least, squared_distance_to_segment(p, {cycle.planned_x[k], cycle.planned_z[k]},
                                                        {cycle.planned_x[k + 1], cycle.planned_z[k + 1]}));
  return least;
}

void require_filter(const char* place, double lowpass_hz) {
  if (!(lowpass_hz >= 0))
    throw std::invalid_argument("loading::" + std::string(place) + ": lowpass_hz [Hz] is " +
                                std::to_string(lowpass_hz) + "; give 0 (none) or more");
}

// Forces of the bucket's two pins across their axis (x, z of the bucket), cycle after cycle.
std::array<std::vector<Eigen::Vector2d>, 2> pin_forces(const LoadingLog& log, double lowpass_hz) {
  const double spacing = positive_number(log, "pin_spacing", "m");
  const CycleSamples samples(log);
  LowPassedVector force(log, "hinge_G_force", lowpass_hz), torque(log, "hinge_G_torque", lowpass_hz);
  std::array<std::vector<Eigen::Vector2d>, 2> forces;
  for (std::size_t row = 0; row < samples.rows(); ++row) {
    const Eigen::Vector3d F = force.next(samples), M = torque.next(samples);
    if (!samples.cycle(row)) continue;
    const Eigen::Vector2d half(F.x() / 2, F.z() / 2), twist(-M.z() / spacing, M.x() / spacing);
    forces[0].emplace_back(half + twist);
    forces[1].emplace_back(half - twist);
  }
  return forces;
}

// Miner's sum of the forces' projections onto a direction [N^exponent].
double damage_along(const Eigen::Vector2d& direction, const std::vector<Eigen::Vector2d>& forces,
                    double exponent) {
  std::vector<double> history;
  history.reserve(forces.size());
  for (const Eigen::Vector2d& force : forces) history.push_back(direction.dot(force));
  return miner_sum(rainflow(history), exponent);
}

// Peaks by cycle of the magnitude of a low-passed vector that is logged by its components [kN].
std::vector<double> peaks_by_cycle(const LoadingLog& log, const std::string& name, double lowpass_hz) {
  require_measured_cycles(log);
  require_filter(("peak of " + name).c_str(), lowpass_hz);
  const CycleSamples samples(log);
  LowPassedVector force(log, name, lowpass_hz);
  std::vector<double> peaks(log.cycles.size());
  for (std::size_t row = 0; row < samples.rows(); ++row) {
    const double magnitude = force.next(samples).norm() / 1000;
    if (const auto cycle = samples.cycle(row)) peaks[*cycle] = std::max(peaks[*cycle], magnitude);
  }
  return peaks;
}

// Means by cycle of what `of_row` gives, over the time of the rows that it counts while the drive is set forward.
std::vector<double> means_while_driving(const LoadingLog& log,
                                        const std::function<Pair(std::size_t row)>& of_row) {
  const record::Table& s = log.signals;
  const std::size_t set = s.index("drive_set");
  std::vector<double> means;
  for (const auto& [sum, time] : integrals(log, [&](std::size_t row, std::size_t) -> Pair {
         return s.at(row, set) > least_drive ? of_row(row) : Pair{0, 0};
       }))
    means.push_back(time > 0 ? sum / time : 0);
  return means;
}

void require_plans(const LoadingLog& log) {
  for (const CycleRecord& cycle : log.cycles)
    if (cycle.planned_x.size() < 3 || cycle.planned_z.size() != cycle.planned_x.size())
      throw std::invalid_argument(
          "loading::tracking_error: a cycle has no planned path of three points or more; give the log of a "
          "simulated run");
}

}  // namespace

std::vector<double> cycle_time_by_cycle(const LoadingLog& log) {
  require_measured_cycles(log);
  std::vector<double> times;
  for (const CycleRecord& cycle : log.cycles) times.push_back(cycle.seconds());
  return times;
}

std::vector<double> solid_fill_by_cycle(const LoadingLog& log) {
  require_measured_cycles(log);
  const double full =
      positive_number(log, "density", "kg/m3") * positive_number(log, "bucket_struck_volume", "m3");
  std::vector<double> shares;
  for (const CycleRecord& cycle : log.cycles) shares.push_back(cycle.loaded_mass / full);
  return shares;
}

std::vector<double> energy_by_cycle(const LoadingLog& log) {
  const double radius = positive_number(log, "tyre_radius", "m");
  const record::Table& s = log.signals;
  const std::size_t torque = s.index("wheel_torque"), drive = s.index("drive_speed"),
                    lift_force = s.index("lift_force"), lift_speed = s.index("lift_speed"),
                    tilt_force = s.index("tilt_force"), tilt_speed = s.index("tilt_speed");
  const auto power = [&](std::size_t row, std::size_t) -> Pair {
    const auto positive = [&](std::size_t force, std::size_t speed) {
      return std::max(s.at(row, force) * s.at(row, speed), 0.0);
    };
    return {positive(torque, drive) / radius + positive(lift_force, lift_speed) +
                positive(tilt_force, tilt_speed),
            0};
  };
  std::vector<double> energy;
  for (const auto& [joules, unused] : integrals(log, power))
    energy.push_back((joules + log.cycles[energy.size()].left_out_energy) / 1000);
  return energy;
}

std::vector<double> energy_per_tonne_by_cycle(const LoadingLog& log) {
  std::vector<double> energy = energy_by_cycle(log);
  for (std::size_t k = 0; k < energy.size(); ++k) energy[k] = per_tonne(energy[k], log.cycles[k].loaded_mass);
  return energy;
}

std::vector<double> tracking_error_by_cycle(const LoadingLog& log) {
  require_plans(log);
  const record::Table& s = log.signals;
  const std::size_t x = s.index("tip_x"), z = s.index("tip_z"), stage = s.index("stage");
  const auto of_row = [&](std::size_t row, std::size_t cycle) -> Pair {
    if (s.at(row, stage) < 1 || s.at(row, stage) > 3) return {0, 0};
    return {squared_distance_to_plan({s.at(row, x), s.at(row, z)}, log.cycles[cycle]), 1};
  };
  std::vector<double> errors;
  for (const auto& [squares, time] : integrals(log, of_row))
    errors.push_back(time > 0 ? std::sqrt(squares / time) : 0);
  return errors;
}

std::vector<double> drive_lag_by_cycle(const LoadingLog& log) {
  const record::Table& s = log.signals;
  const std::size_t set = s.index("drive_set"), speed = s.index("drive_speed");
  return means_while_driving(log, [&](std::size_t row) -> Pair {
    return {1 - s.at(row, speed) / s.at(row, set), 1};
  });
}

std::vector<double> wheel_slip_by_cycle(const LoadingLog& log) {
  const record::Table& s = log.signals;
  const std::size_t rims = s.index("wheel_speed"), speed = s.index("drive_speed");
  return means_while_driving(log, [&](std::size_t row) -> Pair {
    if (!(s.at(row, rims) > least_drive)) return {0, 0};
    return {1 - s.at(row, speed) / s.at(row, rims), 1};
  });
}

std::vector<double> peak_bucket_force_by_cycle(const LoadingLog& log, double lowpass_hz) {
  return peaks_by_cycle(log, "bucket_force", lowpass_hz);
}

std::vector<double> peak_pin_force_by_cycle(const LoadingLog& log, double lowpass_hz) {
  return peaks_by_cycle(log, "hinge_G_force", lowpass_hz);
}

double pin_load_range(const LoadingLog& log, const PinFatigueOptions& options) {
  require_measured_cycles(log);
  require_filter("pin_load_range", options.lowpass_hz);
  if (!(options.exponent >= 1 && options.exponent <= 20))
    throw std::invalid_argument("loading::pin_load_range: exponent [1] is " +
                                std::to_string(options.exponent) + "; give 1 to 20 (3 for welds)");
  constexpr int directions = 12;  // over half a turn
  double worst = 0;
  for (const auto& pin : pin_forces(log, options.lowpass_hz))
    for (int k = 0; k < directions; ++k) {
      const double angle = std::numbers::pi * k / directions;
      worst = std::max(worst, damage_along({std::cos(angle), std::sin(angle)}, pin, options.exponent));
    }
  const double per_cycle = worst / static_cast<double>(log.cycles.size());
  return std::pow(per_cycle, 1 / options.exponent) / 1000;
}

double cycle_time(const LoadingLog& log) { return mean_over_cycles(cycle_time_by_cycle(log)); }
double solid_fill(const LoadingLog& log) { return mean_over_cycles(solid_fill_by_cycle(log)); }
double struck_fill(const LoadingLog& log) { return solid_fill(log) / (1 - loose_ore_porosity); }
double heaped_fill(const LoadingLog& log) {
  return struck_fill(log) * positive_number(log, "bucket_struck_volume", "m3") /
         positive_number(log, "bucket_heaped_volume", "m3");
}
double tracking_error(const LoadingLog& log) { return mean_over_cycles(tracking_error_by_cycle(log)); }
double wheel_slip(const LoadingLog& log) { return mean_over_cycles(wheel_slip_by_cycle(log)); }
double drive_lag(const LoadingLog& log) { return mean_over_cycles(drive_lag_by_cycle(log)); }
double peak_bucket_force(const LoadingLog& log, double lowpass_hz) {
  return mean_over_cycles(peak_bucket_force_by_cycle(log, lowpass_hz));
}
double peak_pin_force(const LoadingLog& log, double lowpass_hz) {
  return mean_over_cycles(peak_pin_force_by_cycle(log, lowpass_hz));
}

double energy_per_tonne(const LoadingLog& log) {
  const std::vector<double> energy = energy_by_cycle(log);
  double mass = 0;
  for (const CycleRecord& cycle : log.cycles) mass += cycle.loaded_mass;
  return per_tonne(std::accumulate(energy.begin(), energy.end(), 0.0), mass);
}

}  // namespace drawpoint::engine::loading
