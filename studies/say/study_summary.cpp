// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/say/number_or_null.h>
#include <drawpoint/studies/say/study_summary.h>
#include <drawpoint/doe/problem.hpp>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace drawpoint::studies {
namespace {

std::string formatted(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string headline_text(const Headline& headline) {
  const std::string unit = headline.unit == "1" ? "" : " " + headline.unit;
  const std::string value =
      std::isfinite(headline.value) ? formatted("%.3g", headline.value) + unit : "unknown";
  return "  " + headline.name + " " + value + ": " + headline.note + "\n";
}

/// "40 training, 16 adaptive and 12 validation runs"
std::string runs_text(const Summary& summary) {
  std::vector<std::string> parts;
  for (const auto& [kind, count] : summary.ended)
    if (count > 0) parts.push_back(std::to_string(count) + " " + name_of(kind));
  if (parts.empty()) return "no runs";
  return detail::listed(parts) + " runs";
}

std::string front_text(const Summary& summary) {
  if (!summary.no_front.empty()) return "Pareto front: none, because " + summary.no_front;
  std::string line = "Pareto front: " + std::to_string(summary.front) +
                     (summary.front == 1 ? " point" : " points") + ", predicted";
  if (!summary.not_polished.empty()) line += ", not polished (" + summary.not_polished + ")";
  if (summary.confirmations.runs.empty())
    return line + "; simulate those that matter with the command " + summary.confirming;
  return line + "; simulated: " + text(summary.confirmations);
}

/// The error against the mean response stands first, where single runs are noisy.
std::string error_text(const Summary& summary, const std::string& response, double nrmse) {
  const auto share = [](double value) {
    return !std::isfinite(value) ? "unknown" : formatted(value < 1e-3 && value != 0 ? "%.1e" : "%.4f", value);
  };
  const std::string of_runs = "NRMSE of " + response + ": " + share(nrmse);
  const auto found = summary.mean_errors.find(response);
  if (found == summary.mean_errors.end() || !(found->second.noise > 0)) return "  " + of_runs + "\n";
  const kriging::MeanError& error = found->second;
  return "  error of the mean of " + response + ": " + share(error.nrmse()) + " of the range, " +
         share(error.share(error.lower)) + " to " + share(error.share(error.upper)) +
         " with 95 %; of single runs: " + share(nrmse) + " (NRMSE)\n";
}

nlohmann::ordered_json recommended_json(const Summary& summary) {
  if (summary.recommended.size() == 0) return {};
  nlohmann::ordered_json x = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < summary.problem.variables.size(); ++k)
    x[summary.problem.variables[k].name] = summary.recommended[static_cast<Eigen::Index>(k)];
  return x;
}

}  // namespace

nlohmann::ordered_json mean_error_json(const kriging::MeanError& error) {
  return {{"rmse", number_or_null(error.rmse)},
          {"lower", number_or_null(error.lower)},
          {"upper", number_or_null(error.upper)},
          {"nrmse", number_or_null(error.nrmse())},
          {"nrmse_lower", number_or_null(error.share(error.lower))},
          {"nrmse_upper", number_or_null(error.share(error.upper))},
          {"noise", number_or_null(error.noise)}};
}

nlohmann::ordered_json flat_json(const std::vector<std::pair<std::string, std::string>>& flat) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const auto& [response, text] : flat) all.push_back({{"response", response}, {"text", text}});
  return all;
}

nlohmann::ordered_json confirmed_json(const CheckedRuns& checked) {
  return {{"points", checked.runs.size()},
          {"values", checked.values},
          {"within", checked.within},
          {"failed", checked.failed},
          {"dominated", checked.dominated},
          {"breaking", checked.breaking},
          {"agree", !checked.runs.empty() && checked.last_round().agree()}};
}

std::string json_line(const Summary& summary) {
  nlohmann::ordered_json line = {{"study", summary.study}, {"runs", 0}};
  for (const Kind kind : all_kinds) {
    const auto found = summary.ended.find(kind);
    const int count = found == summary.ended.end() ? 0 : found->second;
    line[name_of(kind)] = count;
    line["runs"] = line["runs"].get<int>() + count;
  }
  line["failed"] = summary.failed;
  line["left_out"] = summary.left_out;
  line["unfinished"] = summary.unfinished;
  line["adaptive_wanted"] = summary.adaptive_wanted;
  if (!summary.until.empty()) line.update({{"until", summary.until}, {"until_met", summary.until_met}});
  if (const StopNote& stopped = summary.stopped; !stopped.why.empty())
    line.update({{"stopped", stopped.why}, {"go_on", stopped.go_on}});
  line["answer"] = summary.answer;
  line["recommended"] = recommended_json(summary);
  line["headlines"] = nlohmann::ordered_json::object();
  for (const Headline& headline : summary.headlines)
    line["headlines"][headline.name] = number_or_null(headline.value);
  line["findings"] = nlohmann::ordered_json::object();
  for (const Finding& finding : summary.findings) line["findings"][finding.id] = to_string(finding.verdict);
  line["nrmse"] = nlohmann::ordered_json::object();
  for (const auto& [response, value] : summary.nrmse) {
    line["nrmse"][response] = number_or_null(value);
  }
  line["mean_error"] = nlohmann::ordered_json::object();
  for (const auto& [response, error] : summary.mean_errors)
    line["mean_error"][response] = mean_error_json(error);
  line["flat"] = flat_json(summary.flat);
  line["front"] = summary.front;
  line["confirmed"] = confirmed_json(summary.confirmations);
  const pareto::Polishing& polishing = summary.polishing;
  line["certified"] = polishing.residual.size() > 0 ? nlohmann::ordered_json(polishing.certified())
                                                    : nlohmann::ordered_json();
  line["polishing_gain_percent"] = number_or_null(polishing.gain);
  if (!summary.not_polished.empty()) line["not_polished"] = summary.not_polished;
  line["report"] =
      summary.report.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(summary.report.string());
  if (!summary.error.empty()) line["error"] = summary.error;
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string text(const Summary& summary) {
  std::string result =
      summary.study + ": " + runs_text(summary) + ", " + std::to_string(summary.failed) + " failed";
  if (summary.unfinished > 0)
    result += "; " + std::to_string(summary.unfinished) + " more to be made (command run, or ask and tell)";
  const auto adaptive = summary.ended.find(Kind::adaptive);
  const int made = adaptive == summary.ended.end() ? 0 : adaptive->second;
  if (made < summary.adaptive_wanted)
    result += "; " + std::to_string(made) + " adaptive runs, " + std::to_string(summary.adaptive_wanted) +
              " adaptive points wanted";
  result += "\n";
  for (const std::string& sentence : summary.answer) result += sentence + "\n";
  for (const std::string& text : summary.thinned) result += "  " + text + "\n";
  for (const std::string& run : summary.left_out) result += "  caution: " + run + "\n";
  for (const Headline& headline : summary.headlines) result += headline_text(headline);
  for (const auto& [response, value] : summary.nrmse) result += error_text(summary, response, value);
  for (const auto& [response, why] : summary.flat) result += "  " + response + ": " + why + "\n";
  for (const Finding& f : summary.findings)
    result += "  " + f.id + " " + to_string(f.verdict) + ": " + f.claim + " (" + f.grounds + ")\n";
  if (!summary.report.empty()) {
    result += front_text(summary) + "\nreport: " + summary.report.string() + "\n";
  }
  if (!summary.until.empty())
    result += std::string(summary.until_met ? "reached: " : "not reached: ") + summary.until + "\n";
  const StopNote& stopped = summary.stopped;
  if (!stopped.why.empty() && !(stopped.enough && summary.until_met))  // which stands there already
    result += "stopped: " + stopped.why + "; to go on: " + stopped.go_on + "\n";
  return result;
}

}  // namespace drawpoint::studies
