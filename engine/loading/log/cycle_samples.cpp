// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/engine/loading/log/cycle_samples.hpp>
#include <numbers>

namespace drawpoint::engine::loading {

CycleSamples::CycleSamples(const LoadingLog& log)
    : log_(log),
      time_(log.signals.index("time")),
      cycle_(log.signals.has("cycle") ? log.signals.index("cycle") : time_),
      has_cycle_(log.signals.has("cycle")) {}

bool CycleSamples::begins(std::size_t row) const {
  return row == 0 || (has_cycle_ && log_.signals.at(row, cycle_) != log_.signals.at(row - 1, cycle_));
}

double CycleSamples::weight(std::size_t row) const {
  if (!begins(row)) return time(row) - time(row - 1);
  const bool alone = row + 1 >= rows() || begins(row + 1);
  return alone ? 0.0 : time(row + 1) - time(row);
}

std::optional<std::size_t> CycleSamples::cycle(std::size_t row) const {
  const bool first = begins(row);
  for (std::size_t k = 0; k < log_.cycles.size(); ++k) {
    const CycleRecord& cycle = log_.cycles[k];
    if ((first ? time(row) >= cycle.t_start : time(row) > cycle.t_start) && time(row) <= cycle.t_end)
      return k;
  }
  return {};
}

LowPassedVector::LowPassedVector(const LoadingLog& log, const std::string& name, double corner)
    : corner_(corner) {
  const record::Table& signals = log.signals;
  const std::array<std::size_t, 3> columns = {signals.index(name + "_x"), signals.index(name + "_y"),
                                              signals.index(name + "_z")};
  vector_ = [&signals, columns](std::size_t row) {
    return Eigen::Vector3d(signals.at(row, columns[0]), signals.at(row, columns[1]),
                           signals.at(row, columns[2]));
  };
}

const Eigen::Vector3d& LowPassedVector::next(const CycleSamples& samples) {
  const bool direct = samples.begins(row_) || corner_ == 0;
  const double share = direct ? 1.0 : -std::expm1(-2 * std::numbers::pi * corner_ * samples.weight(row_));
  value_ += share * (vector_(row_) - value_);
  ++row_;
  return value_;
}

}  // namespace drawpoint::engine::loading
