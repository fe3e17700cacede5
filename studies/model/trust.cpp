// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/run_noise.h>
#include <drawpoint/studies/model/trust.h>

#include <cmath>
#include <limits>

namespace drawpoint::studies::detail {

bool is_poor(const ModelledStudy& study, std::size_t response) {
  return !doe::is_standard_error(study.problem, response) && response < study.mean_errors.size() &&
         study.mean_errors[response].nrmse() > fair_error;
}

bool is_noisy(const ModelledStudy& study, std::size_t response) {
  return noise_leads(study.validations[response], study.mean_errors[response],
                     told_noise(study.headlines, study.problem.responses[response].name));
}

double scatter_of_run(const ModelledStudy& study, std::size_t j, const doe::Evaluation& run) {
  const double own = told_error(study.problem, j, run.outcome.values());
  if (own > 0) return own;
  const double told = told_noise(study.headlines, study.problem.responses[j].name);
  if (std::isfinite(told)) return told;
  if (j < study.mean_errors.size() && study.mean_errors[j].noise > 0) return study.mean_errors[j].noise;
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace drawpoint::studies::detail
