// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/unevenness.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/nonstationarity.hpp>

#include <cstdint>

namespace drawpoint::studies {
namespace {

/// "alpha lies from 0.4 to 0.6", "run 3, 7 and 12 lie".
std::string uneven_place(const kriging::Stationarity& found, const doe::Problem& problem,
                         const std::vector<std::int64_t>& runs) {
  if (found.input >= 0) {
    const doe::Variable& v = problem.variables[static_cast<std::size_t>(found.input)];
    return v.name + " lies from " + detail::number(found.from) + " to " +
           detail::number_with_unit(found.to, v.unit);
  }
  std::vector<std::string> names;
  for (const auto run : found.runs) names.push_back(std::to_string(runs[static_cast<std::size_t>(run)]));
  return std::string(found.runs.size() == 1 ? "run " : "runs ") + detail::listed(names) +
         (found.runs.size() == 1 ? " lies" : " lie");
}

std::string uneven_sentence(const kriging::Stationarity& found, const doe::Problem& problem,
                            std::size_t response, const std::vector<std::int64_t>& runs,
                            bool on_its_own_scale) {
  const doe::Response& r = problem.responses[response];
  std::string text = "The " + r.name + " is not alike everywhere: where " +
                     uneven_place(found, problem, runs) + ", errors of the model are " +
                     detail::number(found.ratio) + " times as large as elsewhere, by its own error bars. ";
  if (found.jump) {
    const doe::Variable& v = problem.variables[static_cast<std::size_t>(found.jump->input)];
    text += "It jumps between " + v.name + " = " + detail::number(found.jump->after) + " and " +
            detail::number_with_unit(found.jump->before, v.unit);
    if (on_its_own_scale)
      text += ", by " + detail::number_with_unit(found.jump->size, r.unit) + " ± " +
              detail::number(2 * found.jump->standard_error);
    return text +
           ": a study on each side of the jump predicts better, and so does a variable that tells the "
           "sides apart.";
  }
  return text +
         "It jumps, bends sharply or is noisier there: error bars are too narrow there and too wide "
         "elsewhere. Adaptive runs (run --adaptive) go to such places.";
}

}  // namespace

std::vector<std::string> unevenness(const Models& fitted, const Tables& tables) {
  const std::vector<std::int64_t> runs = runs_with_values(tables.training);
  std::vector<std::string> sentences;
  for (std::size_t j = 0; j < fitted.models.size(); ++j) {
    if (doe::is_standard_error(tables.training.problem, j)) continue;
    const kriging::Stationarity found = kriging::check_stationarity(fitted.models[j].model());
    if (found.uneven)
      sentences.push_back(uneven_sentence(found, tables.training.problem, j, runs,
                                          fitted.models[j].transform().scale == kriging::Scale::linear));
  }
  return sentences;
}

}  // namespace drawpoint::studies
