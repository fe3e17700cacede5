// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/program/printed_text.h>
#include <drawpoint/studies/run/run_ends.h>
#include <drawpoint/studies/run/store/plain_text.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace drawpoint::studies {
namespace {

using nlohmann::json;

/// Nothing where the reply is none of ours.
std::optional<RunEnd> replied(const doe::ProcessEnd& end, const std::filesystem::path& printed) {
  const json reply = json::parse(end.reply, nullptr, false);
  if (!reply.is_object()) return {};
  if (reply.contains("failure")) {
    std::string reason = plain_text(reply["failure"].get<std::string>());
    if (reply.value("crashed", false)) reason += printed_last(printed);
    return RunEnd{doe::Failure{reason}, reply.value("not_started", false)};
  }
  if (!reply.contains("values") || end.timed_out) return {};
  const auto values = reply["values"].get<std::vector<double>>();
  return RunEnd{Eigen::VectorXd(
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())))};
}

}  // namespace

std::string reply_text(const doe::Outcome& outcome, std::optional<ProgramTrouble::Kind> trouble) {
  if (outcome.failed()) {
    json reply = {{"failure", plain_text(outcome.reason())}};
    if (trouble) reply[*trouble == ProgramTrouble::Kind::crashed ? "crashed" : "not_started"] = true;
    return reply.dump(-1, ' ', false, json::error_handler_t::replace);
  }
  const Eigen::VectorXd& y = outcome.values();
  return json{{"values", std::vector<double>(y.begin(), y.end())}}.dump();
}

RunEnd run_end(const doe::ProcessEnd& end, const std::filesystem::path& printed) {
  try {
    if (const auto known = replied(end, printed)) return *known;
  } catch (const json::exception&) {  // of other types than ours: no reply
  }
  return {doe::Failure{"the run's process " + doe::describe(end) + printed_last(printed)},
          !end.not_started.empty()};
}

doe::Outcome outcome_of(const doe::ProcessEnd& end, const std::filesystem::path& printed) {
  return run_end(end, printed).outcome;
}

}  // namespace drawpoint::studies
