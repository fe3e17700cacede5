// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Stored runs as the tables that the toolkit takes.

#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/doe/evaluations.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// The runs that ended, failed ones among them, in order of id; of thousands some (thinning.h).
struct Tables {
  doe::Evaluations training;              ///< what models are fitted to: all but the validation runs
  doe::Evaluations validation;            ///< independent of the models
  std::vector<std::string> thinned = {};  ///< a sentence per table that has not all runs
};

Tables tables_of(const std::vector<Run>& runs, const doe::Problem& problem);

/// Numbers of the runs that have not failed, in the order of the rows of X(), y() and Validation.
std::vector<std::int64_t> runs_with_values(const doe::Evaluations& table);

}  // namespace drawpoint::studies
