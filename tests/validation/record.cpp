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
#include <set>
#include <stdexcept>
#include <vector>

namespace drawpoint::validation {
namespace {

std::string printed(double value, int digits) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

// With one digit more than the budget can tell apart; three where there is no budget.
std::string resolved(double value, double budget) {
  if (!std::isfinite(value) || value == 0) return printed(value, 3);
  const double orders = budget > 0 ? std::ceil(std::log10(std::abs(value) / budget)) : 1;
  return printed(value, static_cast<int>(std::clamp(orders + 2, 2.0, 15.0)));
}

double share_of_budget(const Comparison& c) {
  return c.budget > 0 ? std::abs(c.error) / c.budget : (c.error == 0 ? 0.0 : 1.0);
}

// The comparison that is nearest to its budget, then the headlines.
std::vector<Comparison> on_the_page(const std::vector<Comparison>& done) {
  const auto nearest = std::max_element(
      done.begin(), done.end(),
      [](const Comparison& a, const Comparison& b) { return share_of_budget(a) < share_of_budget(b); });
  std::vector<Comparison> shown{*nearest};
  for (auto c = done.begin(); c != done.end(); ++c)
    if (c->headline && c != nearest) shown.push_back(*c);
  return shown;
}

std::string rows(const Problem& problem, const std::vector<Comparison>& done) {
  std::string text, head = problem.title, test = "`" + problem.name + "_validation`";
  for (const Comparison& c : on_the_page(done)) {
    text += "| " + head + " | " + c.quantity + (c.unit == "1" ? "" : " [" + c.unit + "]") + " | " +
            resolved(c.expected, c.budget) + " | " + resolved(c.measured, c.budget) + " | " +
            printed(c.error, 2) + " | " + printed(c.budget, 2) + " | " + c.source + " | " + test + " |\n";
    head.clear();
    test.clear();
  }
  return text;
}

std::string words(const Problem& problem, const std::vector<Comparison>& done) {
  std::string text = "* **" + problem.title + ".** " + problem.simulated;
  std::set<std::string> said;
  for (const Comparison& c : on_the_page(done))
    if (said.insert(c.budget_reason).second) text += " *" + c.budget_reason + "*";
  return text + "\n";
}

std::string quoted(const std::string& text) {
  std::string cell = "\"";
  for (const char c : text) {
    cell += c;
    if (c == '"') cell += c;
  }
  return cell + "\"";
}

// In the order of the header that tests/validation/table writes.
std::string csv(const Problem& problem, const std::vector<Comparison>& done) {
  std::string text;
  for (const Comparison& c : done) {
    for (const std::string& cell : {problem.title, problem.name + "_validation", c.quantity, c.unit})
      text += quoted(cell) + ",";
    text += resolved(c.expected, c.budget) + "," + resolved(c.measured, c.budget) + "," +
            printed(c.error, 2) + "," + printed(c.budget, 2) + "," + printed(share_of_budget(c), 2) + "," +
            quoted(c.source) + "," + quoted(c.budget_reason) + "\n";
  }
  return text;
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
  replace(std::filesystem::path(folder) / (stem + ".rows"), rows(problem, done));
  replace(std::filesystem::path(folder) / (stem + ".words"), words(problem, done));
  replace(std::filesystem::path(folder) / (stem + ".csv"), csv(problem, done));
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
