// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/store/sampling.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace drawpoint::studies {

std::string to_text(const Sampling& sampling) {
  if (!std::isfinite(sampling.target))
    throw std::invalid_argument(
        "studies::Sampling: target is not finite; give an error of the mean over the range, or 0 for none");
  nlohmann::json entry = {{"points", sampling.points},
                          {"batch", sampling.batch},
                          {"criteria", sampling.criteria},
                          {"target", sampling.target},
                          {"rounds", nlohmann::json::array()}};
  for (const ConfirmationRound& round : sampling.rounds)
    entry["rounds"].push_back({round.first, round.named});
  if (!sampling.until.empty()) entry["until"] = sampling.until;
  if (!sampling.stopped.empty()) entry["stopped"] = sampling.stopped;
  return entry.dump();
}

Sampling sampling_from(const std::string& text) {
  const auto entry = nlohmann::json::parse(text);
  Sampling sampling{.points = entry.at("points").get<int>(),
                    .batch = entry.at("batch").get<int>(),
                    .criteria = entry.at("criteria").get<std::string>(),
                    .target = entry.at("target").get<double>(),
                    .until = entry.value("until", ""),
                    .stopped = entry.value("stopped", "")};
  for (const auto& round : entry.at("rounds"))
    sampling.rounds.push_back({round.at(0).get<std::int64_t>(), round.at(1).get<int>()});
  return sampling;
}

}  // namespace drawpoint::studies
