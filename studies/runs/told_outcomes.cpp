// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/runs/point_table.h>
#include <drawpoint/studies/runs/told_outcomes.h>

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
  Telling(const doe::Problem& problem, const std::vector<Run>& runs) : problem_(problem), runs_(runs) {}

  void start(const TableHeader& header) { columns_ = telling_columns(header, problem_); }

  void take(const doe::detail::CsvRecord& record, const TablePlace& place) {
    const std::string status = columns_.status ? field_of(record, *columns_.status, place) : "done";
    if (status != "done" && status != "failed") {
      ++told_.left_alone;
      return;
    }
    const Run& run = run_of(record, place);
    if (!seen_.insert(run.id).second)
      place.fail("run " + std::to_string(run.id) + " is told twice; leave one out");
    check_point(run, record, place);
    const ToldOutcome outcome = outcome_of(run, status == "failed", record, place);
    if (run.status == Status::planned || run.status == Status::running)
      told_.outcomes.push_back(outcome);
    else
      check_same(run, outcome, place);
  }

  const Told& told() const { return told_; }

 private:
  const Run& run_of(const doe::detail::CsvRecord& record, const TablePlace& place) const {
    const double number = number_from(field_of(record, columns_.run, place), "run", place);
    if (number != std::floor(number) || number < 1 || number > static_cast<double>(runs_.size()))
      place.fail("\"run\" is " + doe::detail::number_text(number) + "; the study has runs 1 to " +
                 std::to_string(runs_.size()) + ", those that ask gives");
    return runs_[static_cast<std::size_t>(number) - 1];
  }

  void check_point(const Run& run, const doe::detail::CsvRecord& record, const TablePlace& place) const {
    for (std::size_t k = 0; k < problem_.variables.size(); ++k) {
      if (!columns_.variables[k]) continue;
      const doe::Variable& variable = problem_.variables[k];
      const double told =
                       level_or_number_from(field_of(record, *columns_.variables[k], place), variable, place),
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
    if (columns_.seconds && !field_of(record, *columns_.seconds, place).empty())
      outcome.seconds = number_from(record[*columns_.seconds], "seconds", place);
    if (outcome.seconds < 0)
      place.fail("\"seconds\" is " + doe::detail::number_text(outcome.seconds) +
                 "; allowed are numbers from 0 on");
    if (failed) {
      if (columns_.reason) outcome.reason = field_of(record, *columns_.reason, place);
      if (outcome.reason.empty()) outcome.reason = "told to have failed";
      return outcome;
    }
    outcome.y.resize(static_cast<Eigen::Index>(columns_.responses.size()));
    for (std::size_t k = 0; k < columns_.responses.size(); ++k)
      outcome.y[static_cast<Eigen::Index>(k)] =
          response_from(field_of(record, columns_.responses[k], place), problem_.responses[k], place);
    return outcome;
  }

  void check_same(const Run& run, const ToldOutcome& outcome, const TablePlace& place) const {
    const bool failed = outcome.y.size() == 0;
    if (failed ? run.status == Status::failed : run.status == Status::done && run.y == outcome.y) return;
    place.fail("run " + std::to_string(run.id) +
               " has ended otherwise before, and what is stored stays; leave the row out");
  }

  const doe::Problem& problem_;
  const std::vector<Run>& runs_;
  TellingColumns columns_;
  std::set<std::int64_t> seen_;
  Told told_;
};

}  // namespace

Told told_outcomes(const std::filesystem::path& file, const doe::Problem& problem,
                   const std::vector<Run>& runs) {
  Telling telling(problem, runs);
  read_table(
      file, "--file", [&](const TableHeader& header) { telling.start(header); },
      [&](const doe::detail::CsvRecord& record, const TablePlace& place) { telling.take(record, place); });
  return telling.told();
}

}  // namespace drawpoint::studies
