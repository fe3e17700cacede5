// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/left_out.h>
#include <drawpoint/doe/detail/round_off.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace drawpoint::studies {
namespace {

constexpr double too_large = 1e100, too_many_medians = 1e12;

/// Median of the absolute values of one response, over the finite ones of the done runs; 0 where there are none.
double median_size(const std::vector<Run>& runs, Eigen::Index response) {
  std::vector<double> sizes;
  for (const Run& run : runs)
    if (run.status == Status::done && std::isfinite(run.y[response]))
      sizes.push_back(std::abs(run.y[response]));
  if (sizes.empty()) return 0.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

/// Why the value cannot be; empty: it can.
std::string fault_of(double value, const doe::Response& response, double median) {
  if (!std::isfinite(value)) return "is no finite number";
  const double inside = doe::detail::without_round_off(response, value);
  if (inside < response.lower || inside > response.upper) return "lies outside of its range";
  if (std::abs(value) >= too_large) return "has a size that no model takes";
  if (std::abs(value) > too_many_medians * std::max(median, 1.0))
    return "is more than 1e12 times the median size";
  return "";
}

void leave_out_one(Run& run, const std::string& why) {
  run.status = Status::failed;
  run.left_out = true;
  run.reason = "left out: " + why;
}

void leave_out_impossible(std::vector<Run>& runs, const doe::Problem& problem) {
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    const doe::Response& response = problem.responses[j];
    const double median = median_size(runs, column);
    for (Run& run : runs) {
      if (run.status != Status::done) continue;
      const std::string fault = fault_of(run.y[column], response, median);
      if (!fault.empty())
        leave_out_one(run, "\"" + response.name + "\" is " +
                               doe::detail::with_unit(run.y[column], response.unit) + ", which " + fault);
    }
  }
}

}  // namespace

void leave_out(std::vector<Run>& runs, const std::vector<Correction>& corrections,
               const doe::Problem& problem) {
  std::map<std::int64_t, std::string> excluded;
  for (const Correction& c : corrections) {
    if (c.what == exclude_word) excluded[c.run] = c.why;
    if (c.what == include_word) excluded.erase(c.run);
  }
  for (const auto& [id, why] : excluded)
    if (id >= 1 && id <= static_cast<std::int64_t>(runs.size()) &&
        has_ended(runs[static_cast<std::size_t>(id) - 1]))
      leave_out_one(runs[static_cast<std::size_t>(id) - 1], "excluded by hand: " + why);
  leave_out_impossible(runs, problem);
}

std::vector<std::string> left_out_texts(const std::vector<Run>& runs) {
  constexpr std::size_t most = 10;
  std::vector<std::string> texts;
  std::size_t more = 0;
  for (const Run& run : runs) {
    if (!run.left_out) continue;
    if (texts.size() < most)
      texts.push_back("Run " + std::to_string(run.id) + " is " + run.reason + ".");
    else
      ++more;
  }
  if (more > 0)
    texts.push_back(std::to_string(more) + " more runs are left out; the command export names them.");
  return texts;
}

}  // namespace drawpoint::studies
