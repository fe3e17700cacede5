// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "setting.hpp"

#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <string_view>

namespace drawpoint::benchmarks {
namespace {

// Takes a number of [low, high] and the mark after it off the front; whether it was there.
template <class T>
bool take(std::string_view& text, T low, T high, std::string_view mark, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !(value >= low && value <= high)) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (!text.starts_with(mark)) return false;
  text.remove_prefix(mark.size());
  return true;
}

}  // namespace

Setting setting_of(const std::string& text) {
  Setting s;
  double milliseconds = 0;
  std::string_view rest = text;
  const bool spare = text.find('+') != std::string::npos,
             tolerant = spare && text.find('~') != std::string::npos;
  const bool known = take(rest, 0.01, 10.0, "x", milliseconds) && take(rest, 1, 1000, "x", s.substeps) &&
                     take(rest, 1, 1'000'000, spare ? "+" : "", s.iterations) &&
                     (!spare || take(rest, 0, 1'000'000'000, tolerant ? "~" : "", s.iteration_budget)) &&
                     (!tolerant || take(rest, 0.0, 1.0, "", s.tolerance)) && rest.empty();
  if (!known)
    throw std::invalid_argument("a setting is \"" + text +
                                "\"; write STEPxSUBSTEPSxITERATIONS, with +BUDGET or +BUDGET~TOLERANCE after "
                                "it: a step of 0.01 to 10 ms, "
                                "1 to 1000 substeps, 1 to 1000000 iterations, iteration budget of 0 to 1e9 "
                                "and tolerance of 0 to 1, such as "
                                "10x16x1+20000~0.02");
  s.step = 1e-3 * milliseconds;
  return s;
}

std::string name_of(const Setting& s) {
  char text[96];
  std::snprintf(text, sizeof text, "%gx%dx%d", 1e3 * s.step, s.substeps, s.iterations);
  std::string name = text;
  if (s.iteration_budget > 0) name.append("+").append(std::to_string(s.iteration_budget));
  if (s.tolerance != Setting{}.tolerance) {
    std::snprintf(text, sizeof text, "~%g", s.tolerance);
    name.append(text);
  }
  return name;
}

engine::WorldOptions with(engine::WorldOptions options, const Setting& setting) {
  options.step = setting.step;
  options.solver.substeps = setting.substeps;
  options.solver.iterations = setting.iterations;
  options.solver.iteration_budget = setting.iteration_budget;
  options.solver.tolerance = setting.tolerance;
  return options;
}

}  // namespace drawpoint::benchmarks
