// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/marks.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace drawpoint::studies {
namespace {

std::string names_of_variables(const doe::Problem& problem) {
  std::string names;
  for (const auto& variable : problem.variables) names += (names.empty() ? "" : ",") + variable.name;
  return names;
}

double number_of(const std::string& word, const std::string& text) {
  std::size_t end = 0;
  try {
    const double value = std::stod(word, &end);
    if (end == word.size()) return value;
  } catch (const std::exception&) {
  }
  throw UsageError("--mark " + text + ": \"" + word + "\" is no number; give NAME=VALUE,VALUE,...");
}

Mark mark_of(const doe::Problem& problem, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--mark " + text + ": no name; give NAME=" + names_of_variables(problem));
  std::vector<double> x;
  std::istringstream words(text.substr(equals + 1));
  for (std::string word; std::getline(words, word, ',');) x.push_back(number_of(word, text));
  return {text.substr(0, equals), Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()))};
}

}  // namespace

void add_mark_option(CLI::App& command, const doe::Problem& problem, Settings& settings) {
  command
      .add_option("--mark", settings.marks,
                  "a point to show by its name: NAME=" + names_of_variables(problem) +
                      "; the one called reference is what the recommendation is compared with and chosen to "
                      "be no worse than; repeatable")
      ->allow_extra_args(false)
      ->group("Report");
}

void add_marks(Study& study, const Settings& settings) {
  for (const std::string& text : settings.marks) {
    Mark mark = mark_of(study.problem, text);
    const auto same = std::find_if(study.marks.begin(), study.marks.end(),
                                   [&](const Mark& other) { return other.name == mark.name; });
    if (same == study.marks.end())
      study.marks.push_back(std::move(mark));
    else
      *same = std::move(mark);
  }
  try {
    check_marks(study.problem, study.marks);
  } catch (const std::invalid_argument& e) {
    if (settings.marks.empty()) throw;
    throw UsageError("--mark: " + std::string(e.what()));
  }
}

}  // namespace drawpoint::studies
