// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What single runs scatter by in the error of a model, where that is worth a word.

#include <drawpoint/kriging/score.hpp>
#include <drawpoint/studies/headline.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// Nothing where the noise is unknown, below a tenth of the error, or so small beside the range of the runs
/// that it is the least that a fit can have.
inline std::optional<kriging::ErrorWithoutNoise> telling_noise(const kriging::Validation& v) {
  const kriging::ErrorWithoutNoise parts = kriging::error_without_noise(v);
  const double range = v.observed.maxCoeff() - v.observed.minCoeff();
  if (!(parts.noise >= 0.1 * v.rmse && parts.noise >= 1e-4 * range)) return {};
  return parts;
}

/// What the study itself says that single runs of a response scatter by: its headline noise_of_RESPONSE, in
/// the response's unit; not a number where it has none.
inline double told_noise(const std::vector<Headline>& headlines, const std::string& response) {
  for (const Headline& h : headlines)
    if (h.name == "noise_of_" + response) return h.value;
  return std::numeric_limits<double>::quiet_NaN();
}

/// Whether single runs scatter by more than the model misses the mean of many, so that more runs of the kind
/// do not help; by what the study tells, or else by the model.
inline bool noise_leads(const kriging::Validation& v, double told) {
  if (std::isfinite(told)) return 2 * told * told > v.rmse * v.rmse;
  const auto parts = telling_noise(v);
  return parts && parts->noise > parts->rmse;
}

}  // namespace drawpoint::studies
