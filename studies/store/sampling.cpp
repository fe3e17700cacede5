// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/store/sampling.h>

#include <nlohmann/json.hpp>

namespace drawpoint::studies {

std::string to_text(const Sampling& sampling) {
  return nlohmann::json{{"points", sampling.points},
                        {"batch", sampling.batch},
                        {"criteria", sampling.criteria},
                        {"target", sampling.target}}
      .dump();
}

Sampling sampling_from(const std::string& text) {
  const auto entry = nlohmann::json::parse(text);
  return {.points = entry.at("points").get<int>(),
          .batch = entry.at("batch").get<int>(),
          .criteria = entry.at("criteria").get<std::string>(),
          .target = entry.at("target").get<double>()};
}

}  // namespace drawpoint::studies
