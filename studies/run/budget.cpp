// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/budget.h>
#include <drawpoint/studies/run/settings.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace drawpoint::studies {

double budget_seconds(const std::string& text) {
  static constexpr std::array<std::pair<const char*, double>, 4> units = {
      {{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}, {"d", 86400.0}}};
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const std::string what = "\"" + text + "\"";
  if (end == text.c_str() || !std::isfinite(number) || number <= 0.0)
    throw UsageError(what + " is no time above 0; give 90s, 30min, 2h or 1d");
  std::string unit = end;
  unit.erase(0, unit.find_first_not_of(' '));
  for (const auto& [name, seconds] : units)
    if (unit == name) return number * seconds;
  throw UsageError(what + (unit.empty() ? " has no unit" : " has the unknown unit \"" + unit + "\"") +
                   "; there are s, min, h and d: give 90s, 30min, 2h or 1d");
}

Budget::Budget(const std::string& text) : text_(text) {
  if (!text.empty()) budget_seconds(text);  // refused at once
}

double Budget::seconds_left() const {
  if (text_.empty()) return std::numeric_limits<double>::infinity();
  return budget_seconds(text_) -
         std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Budget::run_ended(double seconds) {
  seconds_in_runs_ += seconds;
  ++runs_;
}

double Budget::mean_seconds() const { return runs_ > 0 ? seconds_in_runs_ / runs_ : 0.0; }

bool Budget::has_room() const { return seconds_left() > mean_seconds(); }

}  // namespace drawpoint::studies
