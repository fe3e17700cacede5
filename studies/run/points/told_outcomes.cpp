// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/points/point_table.h>
#include <drawpoint/studies/run/points/told_outcomes.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace drawpoint::studies {
namespace {

struct TellingColumns {
  std::size_t run = 0;
  std::vector<std::size_t> responses;
  std::vector<std::optional<std::size_t>> variables;
  std::optional<std::size_t> status, reason, seconds;
};

TellingColumns telling_columns(const TableHeader& header, const doe::Problem& problem) {
  TellingColumns columns;
  const auto run = header.find_bare("run");
  if (!run) header.fail("there is no column \"run\"; keep the one that ask gives");
  columns.run = *run;
  columns.status = header.find_bare("status");
  columns.reason = header.find_bare("reason");
  columns.seconds = header.find("seconds", "s");
  const auto claim = [&](const std::string& name, const std::optional<std::size_t>& column) {
    for (const auto& taken : {run, columns.status, columns.reason})
      if (column && column == taken)
        header.fail("the column \"" + name + "\" is that of ask and tell; name the quantity with its unit");
    if (column && column == columns.seconds)
      columns.seconds.reset();  // a quantity of the study has that name
    return column;
  };
  for (const auto& r : problem.responses)
    columns.responses.push_back(*claim(r.name, header.column(r.name, r.unit)));
  for (const auto& v : problem.variables)
    columns.variables.push_back(claim(v.name, header.find(v.name, v.unit)));
  return columns;
}

/// One table for one study.
class Telling {
 public:
  Telling(const doe::Problem& problem, const std::vector<Run>& runs, bool replace)
      : problem_(problem), runs_(runs), replace_(replace) {}

  void start(const TableHeader& header) { columns_ = telling_columns(header, problem_); }

  void take(const doe::detail::CsvRecord& record, const TablePlace& place) {
    const std::string status = columns_.status ? record[*columns_.status] : "done";
    check_status(status, place);
    if (status != "done" && status != "failed") {
      ++told_.left_alone;
      return;
    }
    const Run& run = run_of(record, place);
    if (!seen_.insert(run.id).second)
      place.fail("run " + std::to_string(run.id) + " is told twice; leave one out");
    check_point(run, record, place);
    ToldOutcome outcome = outcome_of(run, status == "failed", record, place);
    if (has_ended(run) && is_same(run, outcome)) return;
    outcome.replaces = has_ended(run);
    if (outcome.replaces && !replace_) refuse_other(run, place);

    told_.outcomes.push_back(outcome);
  }

  /// New runs may stand beside those that are replaced.
  const Told& told(const TablePlace& end) const {
    const auto replaces = [](const ToldOutcome& outcome) { return outcome.replaces; };
    const std::vector<ToldOutcome>& all = told_.outcomes;
    if (replace_ && !all.empty() && std::none_of(all.begin(), all.end(), replaces))
      end.fail("no run of the table has a result that could be replaced; tell them without --replace");
    return told_;
  }

 private:
  const Run& run_of(const doe::detail::CsvRecord& record, const TablePlace& place) const {
    const double number = number_from(record[columns_.run], "run", place);
    if (number != std::floor(number) || number < 1 || number > static_cast<double>(runs_.size()))
      place.fail("\"run\" is " + doe::detail::number_text(number) + "; the study has runs 1 to " +
                 std::to_string(runs_.size()) + ", those that ask gives");
    return runs_[static_cast<std::size_t>(number) - 1];
  }

  void check_point(const Run& run, const doe::detail::CsvRecord& record, const TablePlace& place) const {
    for (std::size_t k = 0; k < problem_.variables.size(); ++k) {
      if (!columns_.variables[k]) continue;
      const doe::Variable& variable = problem_.variables[k];
      const double told = level_or_number_from(record[*columns_.variables[k]], variable, place),
                   asked = run.x[static_cast<Eigen::Index>(k)];
      // A spreadsheet may keep fewer digits.
      if (!(std::abs(told - asked) <= 1e-6 * (variable.upper - variable.lower)))
        place.fail("\"" + variable.name + "\" is " + doe::detail::with_unit(told, variable.unit) +
                   ", but run " + std::to_string(run.id) + " was asked at " +
                   doe::detail::with_unit(asked, variable.unit) + "; is it the table of another study?");
    }
  }

  ToldOutcome outcome_of(const Run& run, bool failed, const doe::detail::CsvRecord& record,
                         const TablePlace& place) const {
    ToldOutcome outcome{.run = run.id};
    if (columns_.seconds && !record[*columns_.seconds].empty())
      outcome.seconds = number_from(record[*columns_.seconds], "seconds", place);
    if (outcome.seconds < 0)
      place.fail("\"seconds\" is " + doe::detail::number_text(outcome.seconds) +
                 "; allowed are numbers from 0 on");
    if (failed) {
      if (columns_.reason) outcome.reason = record[*columns_.reason];
      if (outcome.reason.empty()) outcome.reason = "told to have failed";
      return outcome;
    }
    outcome.y.resize(static_cast<Eigen::Index>(columns_.responses.size()));
    for (std::size_t k = 0; k < columns_.responses.size(); ++k)
      outcome.y[static_cast<Eigen::Index>(k)] =
          response_from(record[columns_.responses[k]], problem_.responses[k], place);
    return outcome;
  }

  static bool is_same(const Run& run, const ToldOutcome& outcome) {
    const bool failed = outcome.y.size() == 0;
    return failed ? run.status == Status::failed && !run.left_out
                  : run.status == Status::done && run.y == outcome.y;
  }

  [[noreturn]] static void refuse_other(const Run& run, const TablePlace& place) {
    place.fail("run " + std::to_string(run.id) +
               " has ended otherwise before, and what is stored stays; leave the row out, or correct the run "
               "with --replace --why TEXT");
  }

  const doe::Problem& problem_;
  const std::vector<Run>& runs_;
  bool replace_;
  TellingColumns columns_;
  std::set<std::int64_t> seen_;
  Told told_;
};

}  // namespace

Told told_outcomes(const std::filesystem::path& file, const doe::Problem& problem,
                   const std::vector<Run>& runs, bool replace) {
  Telling telling(problem, runs, replace);
  const TablePlace end = read_table(
      file, "--file", [&](const TableHeader& header) { telling.start(header); },
      [&](const doe::detail::CsvRecord& record, const TablePlace& place) { telling.take(record, place); });
  return telling.told(end);
}

}  // namespace drawpoint::studies
