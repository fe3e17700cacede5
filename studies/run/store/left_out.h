// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which runs of a store no model, front or figure sees: those that somebody has excluded, and those with a value
/// that cannot be.
///
/// A value cannot be where it is not finite, where it lies beyond the range of its response, where it has a size
/// of 1e100 or more, whose square overflows, and where it is above 1e12 times the median size of its response, or
/// of one unit where that is more: beside it the others would keep four digits of sixteen in any sum.

#include <drawpoint/studies/run/store/store.h>

#include <string>
#include <vector>

namespace drawpoint::studies {

// Correction::what.
inline constexpr const char *exclude_word = "exclude", *include_word = "include", *replace_word = "replace";

/// Makes them failed ones whose reason says why they are left out.
void leave_out(std::vector<Run>& runs, const std::vector<Correction>& corrections,
               const doe::Problem& problem);

/// The values of a run before a correction; none where it had none.
std::vector<double> values_before(const Correction& correction);

/// A line per run that is left out, at most ten and how many more; for cautions.
std::vector<std::string> left_out_texts(const std::vector<Run>& runs);

}  // namespace drawpoint::studies
