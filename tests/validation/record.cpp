// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <drawpoint/tests/validation/record.hpp>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace drawpoint::validation {
namespace {

std::string printed(double value, int digits) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

// With one digit more than the budget can tell apart.
std::string resolved(double value, double budget) {
  if (!std::isfinite(value) || value == 0) return printed(value, 3);
  const double orders = budget > 0 ? std::ceil(std::log10(std::abs(value) / budget)) : 13;
  return printed(value, static_cast<int>(std::clamp(orders + 2, 2.0, 15.0)));
}

// The columns of a row that say how it went; the same in both files.
double share_of_budget(const Comparison& c) {
  return c.budget > 0 ? std::abs(c.error) / c.budget : (c.error == 0 ? 0.0 : 1.0);
}

std::string row(const Comparison& c) {
  return "| " + c.quantity + " | " + c.unit + " | " + resolved(c.expected, c.budget) + " | " +
         resolved(c.measured, c.budget) + " | " + printed(c.error, 2) + " | " + printed(c.budget, 2) + " | " +
         c.source + " |\n";
}

std::string section(const Problem& problem, const std::vector<Comparison>& done) {
  std::string text = "### " + problem.title + "\n\n" + problem.simulated +
                     "\n\n| Compared | Unit | Expected | Measured | Error | Budget | Source |\n" +
                     "|---|---|---|---|---|---|---|\n";
  for (const Comparison& c : done) text += row(c);
  text += "\n";
  std::vector<std::string> told;
  for (const Comparison& c : done) {
    if (std::find(told.begin(), told.end(), c.budget_reason) != told.end()) continue;
    told.push_back(c.budget_reason);
    text += "* " + c.budget_reason + "\n";
  }
  return text + "\n";
}

std::string summary(const Problem& problem, const std::vector<Comparison>& done) {
  double worst = 0;
  for (const Comparison& c : done) worst = std::max(worst, share_of_budget(c));
  return "| " + problem.title + " | " + std::to_string(done.size()) + " | " + printed(worst, 2) + " | `" +
         problem.name + "_validation.cpp` |\n";
}

void replace(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::path draft = path;
  draft += ".draft";
  std::ofstream(draft, std::ios::binary) << text;
  if (std::filesystem::file_size(draft) != text.size())
    throw std::runtime_error("validation::record: could not write " + draft.string() + "; is the disk full?");
  std::filesystem::rename(draft, path);
}

void write(const Problem& problem, const std::vector<Comparison>& done) {
  const char* folder = std::getenv("DRAWPOINT_VALIDATION_TABLE");
  if (!folder) return;
  const std::string stem = std::to_string(static_cast<int>(problem.group)) + "." + problem.name;
  replace(std::filesystem::path(folder) / (stem + ".section"), section(problem, done));
  replace(std::filesystem::path(folder) / (stem + ".summary"), summary(problem, done));
}

}  // namespace

void record(const Problem& problem, Comparison comparison) {
  static std::vector<Comparison> done;
  if (std::isnan(comparison.error)) comparison.error = comparison.measured - comparison.expected;
  ASSERT_TRUE(std::isfinite(comparison.budget)) << problem.name << ": " << comparison.quantity;
  EXPECT_LE(std::abs(comparison.error), comparison.budget)
      << problem.name << ": " << comparison.quantity << " [" << comparison.unit << "]: expected "
      << printed(comparison.expected, 15) << ", measured " << printed(comparison.measured, 15)
      << ". Budget: " << comparison.budget_reason;
  done.push_back(comparison);
  write(problem, done);
}

}  // namespace drawpoint::validation
