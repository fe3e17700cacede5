// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/options/mark_options.h>

#include <drawpoint/studies/commands/options/points.h>
#include <drawpoint/studies/commands/options/run_options.h>
#include <drawpoint/studies/run/store/marks.h>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace drawpoint::studies {
namespace {

/// A word beyond the variables is read as a number: check_marks says how many there are to be.
double value_of(const doe::Problem& problem, std::size_t k, const std::string& word,
                const std::string& text) {
  static const doe::Variable beyond{};
  const double value = typed_value(k < problem.variables.size() ? problem.variables[k] : beyond, word);
  if (std::isfinite(value)) return value;
  throw UsageError("--mark " + text + ": \"" + word + "\" is no number; give NAME=VALUE,VALUE,...");
}

/// What one --mark says: a point, or the name alone where that point is to be taken away.
Mark typed_mark(const doe::Problem& problem, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--mark " + text + ": no name; give NAME=" + names_of(problem));
  std::vector<double> x;
  std::istringstream words(text.substr(equals + 1));
  for (std::string word; std::getline(words, word, ',');)
    x.push_back(value_of(problem, x.size(), word, text));
  return {text.substr(0, equals), Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()))};
}

bool takes_away(const Mark& typed) { return typed.x.size() == 0; }

/// One of each name, all of them of the problem.
std::vector<Mark> typed_marks(const doe::Problem& problem, const Settings& settings) {
  std::vector<Mark> typed, points;
  for (std::size_t i = 0; i < settings.marks.size(); ++i) {
    const Mark mark = typed_mark(problem, settings.marks[i]);
    if (const auto same = mark_named(typed, mark.name); same != typed.end())
      throw UsageError("--mark " + settings.marks[static_cast<std::size_t>(same - typed.begin())] +
                       " and --mark " + settings.marks[i] +
                       ": one name, two points; give each point a name of its own");
    typed.push_back(mark);
    if (!takes_away(mark)) points.push_back(mark);
  }
  try {
    check_marks(problem, points);
  } catch (const std::invalid_argument& e) {
    throw UsageError("--mark: " + std::string(e.what()));
  }
  return typed;
}

/// "it has today and reference"
std::string names_of_marks(const std::vector<Mark>& marks) {
  if (marks.empty()) return "it has none";
  std::string names;
  for (const Mark& mark : marks) names += (names.empty() ? "it has " : ", ") + mark.name;
  return names;
}

[[noreturn]] void refuse_to_take_away(const Study& study, const std::vector<Mark>& stored,
                                      const Settings& settings, const std::string& name) {
  std::vector<Mark> declared = study.presentation.marks;
  if (mark_named(declared, name) != declared.end())
    throw UsageError("--mark " + name + "=: the study itself declares this mark; give --mark " + name + "=" +
                     names_of(study.problem) + " to put another point in its place");
  throw UsageError("--mark " + name + "=: the folder " + settings.out.string() +
                   " has no mark of this name to take away; " + names_of_marks(stored));
}

/// What the folder has, with what is typed.
std::vector<Mark> changed_marks(const Study& study, std::vector<Mark> stored, const Settings& settings) {
  for (const Mark& typed : typed_marks(study.problem, settings)) {
    if (!takes_away(typed)) {
      stored = with_marks(std::move(stored), {typed});
      continue;
    }
    const auto same = mark_named(stored, typed.name);
    if (same == stored.end()) refuse_to_take_away(study, stored, settings, typed.name);
    stored.erase(same);
  }
  return stored;
}

std::vector<Mark> stored_marks(const Folder& folder) {
  try {
    return Store::open(folder.store(), Access::read).marks();
  } catch (const std::exception&) {  // none yet, busy or damaged: whoever opens it next says so
    return {};
  }
}

/// Speaks of marks that were there before; what is new needs no word.
void say_what_changes(std::vector<Mark> before, std::vector<Mark> now, int messages) {
  for (const Mark& old : before) {
    const auto same = mark_named(now, old.name);
    if (same == now.end())
      dprintf(messages, "mark %s is taken away\n", mark_text(old).c_str());
    else if (same->x != old.x)
      dprintf(messages, "mark %s takes the place of %s\n", mark_text(*same).c_str(), mark_text(old).c_str());
  }
}

}  // namespace

void add_mark_option(CLI::App& command, const doe::Problem& problem, Settings& settings) {
  command
      .add_option("--mark", settings.marks,
                  "a point to show by its name: NAME=" + names_of(problem) +
                      ", which the folder keeps; NAME= takes it away. The one called reference is what the "
                      "recommendation is compared with and chosen to be no worse than; repeatable")
      ->allow_extra_args(false)
      ->group("Report");
}

void check_typed_marks(const Study& study, const Settings& settings) {
  if (!settings.marks.empty()) changed_marks(study, stored_marks(Folder{settings.out}), settings);
}

void keep_marks(Store& store, const Study& study, const Settings& settings, int messages) {
  if (settings.marks.empty()) return;
  const std::vector<Mark> stored = store.marks(), now = changed_marks(study, stored, settings);
  if (to_text(now) != to_text(stored)) store.set_marks(now);
  say_what_changes(with_marks(study.presentation.marks, stored), with_marks(study.presentation.marks, now),
                   messages);
}

}  // namespace drawpoint::studies
