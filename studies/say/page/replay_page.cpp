// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/say/page/cycles.h>
#include <drawpoint/studies/say/page/data.h>
#include <drawpoint/studies/say/page/page.h>
#include <drawpoint/studies/say/page/panels.h>
#include <drawpoint/studies/say/page/replay_page.h>
#include <drawpoint/doe/detail/atomic_file.hpp>

#include <stdexcept>

namespace drawpoint::studies {
namespace {

std::string name_of_run(const ReplayInput& input) { return "run " + std::to_string(input.run.run); }

nlohmann::json values_of(const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); }

nlohmann::json run_json(const ReplayInput& input, const std::vector<std::string>& cautions) {
  const doe::Outcome& outcome = input.run.outcome;
  return {
      {"run", input.run.run},        {"kind", input.kind},
      {"x", values_of(input.run.x)}, {"y", outcome.failed() ? nlohmann::json() : values_of(outcome.values())},
      {"reason", outcome.reason()},  {"cautions", cautions}};
}

/// What the page says of cycles that it has no room for; empty: it has them all.
std::string left_out_text(const std::vector<int>& cycles, const ReplayInput& input) {
  if (cycles.empty()) return "";
  const std::string first = std::to_string(cycles.front()), last = std::to_string(cycles.back());
  const bool one = cycles.size() == 1;
  return (one ? "Cycle " + first + " is" : "Cycles " + first + " to " + last + " are") +
         " left out, to keep this page below some " + std::to_string(input.most_bytes / 1'000'000) +
         " MB: " + (one ? "it has" : "each has") + " a page of its own with the command replay --run " +
         std::to_string(input.run.run) + " --cycle " + first + (one ? "." : " and so on.");
}

/// Panels that can be drawn, one at least.
nlohmann::json drawn_panels(const ReplayInput& input, std::vector<std::string>& cautions) {
  nlohmann::json panels = detail::without_repeated(detail::checked_panels(input.panels, cautions));
  if (!panels.empty()) return panels;
  std::string why;
  for (const std::string& caution : cautions) why += " " + caution;
  throw std::runtime_error("replay: the study draws no figure of the log of " + name_of_run(input) +
                           (why.empty() ? "; choose another run" : ":" + why));
}

}  // namespace

std::string replay_page(const ReplayInput& input) {
  std::vector<std::string> cautions;
  nlohmann::json panels = drawn_panels(input, cautions);
  const std::vector<int> left_out = detail::fit_cycles(panels, input.most_bytes);
  const nlohmann::json data = {{"study", input.study},
                               {"about", input.about},
                               {"command", input.command},
                               {"problem", detail::described(input.problem)},
                               {"replay", run_json(input, cautions)},
                               {"left_out", left_out_text(left_out, input)},
                               {"illustrations", std::move(panels)},
                               {"facts", input.facts}};
  return detail::page(input.study + ", " + name_of_run(input), data);
}

void write_replay(const std::filesystem::path& path, const ReplayInput& input) {
  doe::write_file(path, replay_page(input));
}

}  // namespace drawpoint::studies
