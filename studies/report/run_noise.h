// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What single runs scatter by in the error of a model, where that is worth a word.

#include <drawpoint/kriging/score.hpp>

#include <optional>

namespace drawpoint::studies {

/// Nothing where the noise is unknown, below a tenth of the error, or so small beside the range of the runs
/// that it is the least that a fit can have.
inline std::optional<kriging::ErrorWithoutNoise> telling_noise(const kriging::Validation& v) {
  const kriging::ErrorWithoutNoise parts = kriging::error_without_noise(v);
  const double range = v.observed.maxCoeff() - v.observed.minCoeff();
  if (!(parts.noise >= 0.1 * v.rmse && parts.noise >= 1e-4 * range)) return {};
  return parts;
}

/// Whether single runs scatter by more than the model misses the mean of many: more runs of the kind do not help.
inline bool noise_leads(const kriging::Validation& v) {
  const auto parts = telling_noise(v);
  return parts && parts->noise > parts->rmse;
}

}  // namespace drawpoint::studies
