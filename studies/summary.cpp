// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/summary.hpp>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace drawpoint::studies {

std::string json_line(const Summary& summary) {
  nlohmann::ordered_json line = {{"study", summary.study},
                                 {"runs", summary.training + summary.validation},
                                 {"training", summary.training},
                                 {"validation", summary.validation},
                                 {"failed", summary.failed}};
  line["nrmse"] = nlohmann::ordered_json::object();
  for (const auto& [response, value] : summary.nrmse) {
    line["nrmse"][response] = std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  }
  line["front"] = summary.front;
  line["report"] =
      summary.report.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(summary.report.string());
  if (!summary.error.empty()) line["error"] = summary.error;
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string text(const Summary& summary) {
  std::string result = summary.study + ": " + std::to_string(summary.training) + " training and " +
                       std::to_string(summary.validation) + " validation runs, " +
                       std::to_string(summary.failed) + " failed\n";
  for (const auto& [response, value] : summary.nrmse) {
    char number[32];
    std::snprintf(number, sizeof number, std::isfinite(value) ? "%.4f" : "unknown", value);
    result += "  NRMSE of " + response + ": " + number + "\n";
  }
  if (!summary.report.empty()) {
    result += "Pareto front: " + std::to_string(summary.front) +
              " points\nreport: " + summary.report.string() + "\n";
  }
  return result;
}

}  // namespace drawpoint::studies
