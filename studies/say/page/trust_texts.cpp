// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/trust.h>
#include <drawpoint/studies/say/page/trust_texts.h>

#include <cmath>

namespace drawpoint::studies::detail {
namespace {

using nlohmann::json;

/// The error of the mean response first, that of single runs second where they are noisy: more cycles or
/// replicates help against their noise, more runs against the rest.
std::string error_sentence(const kriging::Validation& v, const kriging::MeanError& error,
                           const doe::Response& r) {
  if (!(error.noise > 0))
    return "is predicted with a typical error of " + number_with_unit(v.rmse, r.unit) + ", " +
           share_text(error);
  return "is predicted in the mean of many runs with a typical error of " +
         number_with_unit(error.rmse, r.unit) + ", " + share_text(error) + "; single runs scatter by " +
         number_with_unit(error.noise, r.unit) + " and are missed by " + number_with_unit(v.rmse, r.unit) +
         " (NRMSE " + percent(v.nrmse) + ")";
}

/// No better than fair while the interval reaches into poor.
std::string grade_of(const kriging::MeanError& error) {
  if (error.nrmse() > fair_error) return "poor";
  return error.nrmse() <= good_error && error.share(error.upper) <= fair_error ? "good" : "fair";
}

json grade(const ReportInput& input, std::size_t j) {
  const doe::Response& r = input.problem.responses[j];
  json verdict{{"response", pretty(r.name)}, {"grade", "unknown"}};
  if (j >= input.models.size()) {
    verdict["text"] = "no surrogate could be fitted";
  } else if (j >= input.mean_errors.size() || !std::isfinite(input.validations[j].nrmse)) {
    verdict["text"] = "was not checked on independent runs that differ";
  } else {
    const kriging::MeanError& error = input.mean_errors[j];
    verdict["grade"] = grade_of(error);
    verdict["text"] =
        error_sentence(input.validations[j], error, r) +
        (error.nrmse() > fair_error && !is_flat(input.flat, j) ? ": read trends, not values" : "");
  }
  if (is_flat(input.flat, j)) {
    verdict["grade"] = "flat";
    verdict["text"] =
        verdict["text"].get<std::string>() + "; its surrogate shows no difference between strategies";
  }
  return verdict;
}

}  // namespace

json trust(const ReportInput& input) {
  json all = json::array();
  for (std::size_t j = 0; j < input.problem.responses.size(); ++j)
    if (!doe::is_standard_error(input.problem, j)) all.push_back(grade(input, j));
  return all;
}

std::string share_text(const kriging::MeanError& error) {
  return percent(error.nrmse()) + " of the range seen (" + percent(error.share(error.lower)) + " to " +
         percent(error.share(error.upper)) + ")";
}

}  // namespace drawpoint::studies::detail
