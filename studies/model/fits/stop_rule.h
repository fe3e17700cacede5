// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Errors of models at which a study has what it wants, as they are typed:
///
///     nrmse(production) < 0.08 and mean_error(spill) < 0.1
///
/// nrmse is the RMSE of single runs over the range of the validation runs, noise included; mean_error that of
/// the mean of many runs (kriging/mean_error.hpp). Both are known where there are validation runs.

#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/doe/problem.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

enum class ErrorMeasure { nrmse, mean_error };

struct StopCondition {
  ErrorMeasure measure = ErrorMeasure::nrmse;
  std::size_t response = 0;  ///< of the problem
  double bound = 0.0;        ///< the error is below, a share of the range, in (0, 1]
};

using StopRule = std::vector<StopCondition>;

/// No conditions where the text is empty. Throws UsageError that names what is not known and what there is.
StopRule stop_rule_from(const std::string& text, const doe::Problem& problem);

struct StopState {
  bool met = false;       ///< every condition is; false without one
  std::string text = {};  ///< "nrmse(cost) 0.12, wanted < 0.1"; says so where noise alone exceeds the bound
};

/// Returns the error of the mean of many runs as a share of the range, and its upper end with 95 % where noise hides
/// it: an estimate of 0 says that it is too small to tell, not that there is none.
double error_that_counts(const kriging::MeanError& error);

/// Validations and errors of the means, one of each per response, or none: then nothing is met.
StopState stop_state(const StopRule& rule, const doe::Problem& problem,
                     const std::vector<kriging::Validation>& validations,
                     const std::vector<kriging::MeanError>& mean_errors);

}  // namespace drawpoint::studies
