// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/sampling.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace drawpoint::studies {

namespace {

/// What nlohmann-json takes as one without a word may be 1e99.
int whole_number(const nlohmann::json& value, int least) {
  constexpr int most = 1'000'000'000;
  if (!value.is_number_integer() || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most)
    throw std::out_of_range("studies::Sampling: " + value.dump() + "; allowed are whole numbers from " +
                            std::to_string(least) + " to 1e9");
  return value.get<int>();
}

}  // namespace

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
  if (const StopNote& stopped = sampling.stopped; !stopped.why.empty()) {
    entry["stopped"] = stopped.why;
    entry["go_on"] = stopped.go_on;
    entry["enough"] = stopped.enough;
  }
  return entry.dump();
}

Sampling sampling_from(const std::string& text) {
  const auto entry = nlohmann::json::parse(text);
  Sampling sampling{.points = whole_number(entry.at("points"), 0),
                    .batch = whole_number(entry.at("batch"), 1),
                    .criteria = entry.at("criteria").get<std::string>(),
                    .target = entry.at("target").get<double>(),
                    .until = entry.value("until", ""),
                    .stopped = {.why = entry.value("stopped", ""),
                                .go_on = entry.value("go_on", "give the same command again"),
                                .enough = entry.value("enough", false)}};
  for (const auto& round : entry.at("rounds"))
    sampling.rounds.push_back({whole_number(round.at(0), 1), whole_number(round.at(1), 0)});
  return sampling;
}

}  // namespace drawpoint::studies
