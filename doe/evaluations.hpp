// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The table of evaluated runs: one row per run and replicate, failed ones with their reason.
///
/// On disk it is a CSV file with the header
/// `run,replicate,seed,status,<variable> [unit],...,<response> [unit],...,seconds,failure`;
/// status is "ok" or "failed"; a failed row has empty responses and its reason in `failure`. Every double
/// comes back from the file bit for bit. Writing is atomic; reading checks the header against the problem and
/// every field.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/doe/detail/csv.hpp>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/problem.hpp>

namespace drawpoint::doe {

struct Evaluation {
  std::int64_t run = 0;
  int replicate = 0;
  Seed seed = 0;
  Eigen::VectorXd x = {};  ///< d, natural units
  Outcome outcome = {};
  double seconds = 0.0;  ///< wall time of the call [s]
};

struct Evaluations {
  Problem problem;
  std::vector<Evaluation> rows = {};

  int failed() const {
    int count = 0;
    for (const Evaluation& row : rows) count += row.outcome.failed();
    return count;
  }

  /// Inputs of the successful rows, (rows - failed) x d.
  Eigen::MatrixXd X() const {
    Eigen::MatrixXd inputs(succeeded(), static_cast<Eigen::Index>(problem.variables.size()));
    Eigen::Index i = 0;
    for (const Evaluation& row : rows)
      if (!row.outcome.failed()) inputs.row(i++) = row.x;
    return inputs;
  }

  /// Values of one response in the successful rows, aligned with X(). Throws std::invalid_argument on an
  /// unknown name.
  Eigen::VectorXd y(std::string_view response) const {
    const int j = response_index(problem, response);
    Eigen::VectorXd values(succeeded());
    Eigen::Index i = 0;
    for (const Evaluation& row : rows)
      if (!row.outcome.failed()) values[i++] = row.outcome.values()[j];
    return values;
  }

  Eigen::VectorXd y(std::nullptr_t) const = delete;  // y(0): responses go by their names

  /// What the runs themselves know of the noise of one response, aligned with y(): the squares of its
  /// standard errors; empty where the problem names none. Throws as y().
  Eigen::VectorXd noise_variance(std::string_view response) const {
    const std::string& told =
        problem.responses[static_cast<std::size_t>(response_index(problem, response))].standard_error;
    if (told.empty()) return {};
    return y(told).cwiseAbs2();
  }

 private:
  Eigen::Index succeeded() const { return static_cast<Eigen::Index>(rows.size()) - failed(); }
};

namespace detail {

inline CsvRecord csv_header(const Problem& problem) {
  CsvRecord header{"run", "replicate", "seed", "status"};
  for (const Variable& v : problem.variables) header.push_back(v.name + " [" + v.unit + "]");
  for (const Response& r : problem.responses) header.push_back(r.name + " [" + r.unit + "]");
  header.insert(header.end(), {"seconds", "failure"});
  return header;
}

inline CsvRecord csv_row(const Evaluation& row, std::size_t responses) {
  CsvRecord record{std::to_string(row.run), std::to_string(row.replicate), std::to_string(row.seed),
                   row.outcome.failed() ? "failed" : "ok"};
  for (const double x : row.x) record.push_back(number_text(x));
  for (std::size_t j = 0; j < responses; ++j)
    record.push_back(row.outcome.failed() ? ""
                                          : number_text(row.outcome.values()[static_cast<Eigen::Index>(j)]));
  record.insert(record.end(), {number_text(row.seconds), row.outcome.reason()});
  return record;
}

/// Turns the records of one file into rows, and names file, line and column of the first fault.
class EvaluationParser {
 public:
  EvaluationParser(const Problem& problem, const std::filesystem::path& path)
      : problem_(problem), header_(csv_header(problem)), path_(path.string()) {}

  [[noreturn]] void fail(int line, const std::string& what) const {
    throw std::runtime_error("doe::read_csv: \"" + path_ + "\" line " + std::to_string(line) + ": " + what);
  }

  void check_header(const CsvRecord& record) const {
    if (record.size() != header_.size())
      fail(1, "the header has " + std::to_string(record.size()) + " columns, this problem has " +
                  std::to_string(header_.size()) + "; the file belongs to another problem");
    for (std::size_t i = 0; i < header_.size(); ++i)
      if (record[i] != header_[i])
        fail(1, "column " + std::to_string(i + 1) + " is \"" + record[i] + "\", this problem expects \"" +
                    header_[i] + "\"; the file belongs to another problem");
  }

  Evaluation parse(const CsvRecord& record, int line) const {
    if (record.size() != header_.size())
      fail(line, std::to_string(record.size()) + " fields, expected " + std::to_string(header_.size()));
    const auto d = static_cast<Eigen::Index>(problem_.variables.size());
    Evaluation row;
    row.run = number<std::int64_t>(record, 0, line);
    row.replicate = number<int>(record, 1, line);
    row.seed = number<Seed>(record, 2, line);
    row.x = numbers(record, 4, d, line);
    row.outcome = outcome(record, 4 + static_cast<std::size_t>(d), line);
    row.seconds = number<double>(record, record.size() - 2, line);
    return row;
  }

 private:
  template <class Number>
  Number number(const CsvRecord& record, std::size_t column, int line) const {
    if (const auto value = csv_number<Number>(record[column])) return *value;
    fail(line, "column \"" + header_[column] + "\": \"" + record[column] + "\" is not a number it can hold");
  }

  Eigen::VectorXd numbers(const CsvRecord& record, std::size_t first, Eigen::Index count, int line) const {
    Eigen::VectorXd values(count);
    for (Eigen::Index j = 0; j < count; ++j) {
      const std::size_t column = first + static_cast<std::size_t>(j);
      values[j] = number<double>(record, column, line);
      if (!std::isfinite(values[j]))
        fail(line, "column \"" + header_[column] + "\": " + record[column] + " is not finite");
    }
    return values;
  }

  Outcome outcome(const CsvRecord& record, std::size_t first, int line) const {
    const std::size_t responses = problem_.responses.size();
    if (record[3] == "ok") return numbers(record, first, static_cast<Eigen::Index>(responses), line);
    if (record[3] != "failed")
      fail(line, "column \"status\": \"" + record[3] + "\"; allowed is ok or failed");
    for (std::size_t column = first; column < first + responses; ++column)
      if (!record[column].empty())
        fail(line, "column \"" + header_[column] + "\": a failed run has no value");
    return Failure{record.back()};
  }

  const Problem& problem_;
  CsvRecord header_;
  std::string path_;
};

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad())
    throw std::runtime_error("doe::read_csv: cannot read \"" + path.string() +
                             "\"; check that it exists and is readable");
  return text;
}

}  // namespace detail

/// Writes the whole table, atomically. Throws std::runtime_error when the disk refuses; an existing file then
/// stands.
inline void write_csv(const Evaluations& evaluations, const std::filesystem::path& path) {
  check(evaluations.problem);
  std::string text = detail::csv_line(detail::csv_header(evaluations.problem));
  for (const Evaluation& row : evaluations.rows)
    text += detail::csv_line(detail::csv_row(row, evaluations.problem.responses.size()));
  write_file(path, text);
}

/// Reads what write_csv wrote. Throws std::runtime_error, with file, line and column, when the file cannot be
/// read, belongs to another problem or is damaged.
inline Evaluations read_csv(const Problem& problem, const std::filesystem::path& path) {
  check(problem);
  const std::string text = detail::read_text(path);
  detail::CsvReader reader(text);
  const detail::EvaluationParser parser(problem, path);
  Evaluations evaluations{problem, {}};
  const auto header = reader.next();
  if (!header) parser.fail(reader.line(), reader.fault().empty() ? "the file is empty" : reader.fault());
  parser.check_header(*header);
  while (const auto record = reader.next()) evaluations.rows.push_back(parser.parse(*record, reader.line()));
  if (!reader.fault().empty()) parser.fail(reader.line(), reader.fault());
  return evaluations;
}

}  // namespace drawpoint::doe
