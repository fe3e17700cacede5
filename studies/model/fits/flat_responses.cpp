// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/flat_responses.h>
#include <drawpoint/studies/model/fits/words.h>

#include <algorithm>
#include <utility>

namespace drawpoint::studies {

std::vector<FlatResponse> flat_responses(const std::vector<kriging::TransformedModel>& models,
                                         const doe::Problem& problem) {
  std::vector<FlatResponse> flat;
  for (std::size_t j = 0; j < models.size(); ++j) {
    if (doe::is_standard_error(problem, j)) continue;
    const kriging::Signal signal = kriging::signal_of(models[j], problem);
    if (signal.flat) flat.push_back({j, problem.responses[j].goal, signal});
  }
  return flat;
}

bool is_flat(const std::vector<FlatResponse>& flat, std::size_t response) {
  return std::any_of(flat.begin(), flat.end(),
                     [response](const FlatResponse& f) { return f.response == response; });
}

doe::Problem without_flat(doe::Problem problem, const std::vector<FlatResponse>& flat) {
  for (const FlatResponse& f : flat)
    if (doe::is_objective(f.asked)) problem.responses[f.response].goal = doe::Goal::record;
  return problem;
}

doe::Problem as_asked(doe::Problem problem, const std::vector<FlatResponse>& flat) {
  for (const FlatResponse& f : flat) problem.responses[f.response].goal = f.asked;
  return problem;
}

std::string flat_text(const FlatResponse& flat, const doe::Problem& problem) {
  const std::string& unit = problem.responses[flat.response].unit;
  std::string text =
      "its model does not differ between strategies by clearly more than its own error (it varies by " +
      detail::number_with_unit(flat.signal.spread, unit) + ", its error is " +
      detail::number_with_unit(flat.signal.error, unit) + "); ";
  if (doe::is_objective(flat.asked)) text += "it is left out of the trade-off; ";
  return text + "quieter runs (more cycles or samples per run) or another response would be needed";
}

std::vector<std::pair<std::string, std::string>> texts_of(const std::vector<FlatResponse>& flat,
                                                          const doe::Problem& problem) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const FlatResponse& f : flat)
    texts.emplace_back(problem.responses[f.response].name, flat_text(f, problem));
  return texts;
}

std::string flat_objectives(const std::vector<FlatResponse>& flat, const doe::Problem& problem) {
  std::string names;
  for (const FlatResponse& f : flat)
    if (doe::is_objective(f.asked))
      names += (names.empty() ? "" : ", ") + detail::pretty(problem.responses[f.response].name);
  return names;
}

}  // namespace drawpoint::studies
