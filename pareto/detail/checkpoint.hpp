// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A search on disk: a text of one item per line.
///
/// First the format and its version, the search, the problem and the options that decide the result, one line
/// each, so that a file of another search is refused by the line that differs; the stopping rules are among
/// them, but may differ. After the line "state" the items of the search, a name and its numbers; numbers are
/// the shortest text that reads back as the same double. The last line is the checksum of all before it
/// (64-bit FNV-1a: against accidents, not against intent).

#include <Eigen/Core>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/enumerators.hpp>
#include <drawpoint/doe/run_journal.hpp>
#include <drawpoint/pareto/detail/population.hpp>
#include <drawpoint/pareto/detail/setting.hpp>

namespace drawpoint::pareto::detail {

inline constexpr std::string_view checkpoint_format = "drawpoint pareto checkpoint 1";

inline std::string line_of(const doe::Variable& v) {
  std::string line = "variable \"" + v.name + "\" " + doe::detail::with_unit(v.lower, v.unit) + " to " +
                     doe::detail::with_unit(v.upper, v.unit) + " " + std::string(to_string(v.kind));
  for (const std::string& level : v.levels) line += " \"" + level + "\"";
  return doe::detail::on_one_line(line);
}

inline std::string line_of(const doe::Response& r) {
  std::string line = "response \"" + r.name + "\" [" + r.unit + "] " + std::string(to_string(r.goal));
  if (doe::is_constraint(r.goal)) line += " " + doe::detail::number_text(r.limit);
  return doe::detail::on_one_line(line);
}

inline std::string text_of(const std::optional<int>& value) {
  return value ? std::to_string(*value) : "none";
}

inline std::string text_of(const Eigen::MatrixXd& values) {
  std::string text;
  for (const double value : values.reshaped()) text += doe::detail::number_text(value) + " ";
  return std::to_string(values.rows()) + " x " + std::to_string(values.cols()) + ", checksum " +
         doe::detail::checksum(text);
}

/// Options that all searches share and that decide where it starts: name and value.
inline Setting::Named sizes_and_start(const Setting& s) {
  Setting::Named options{{"population", std::to_string(s.population)},
                         {"children", std::to_string(s.children)},
                         {"seed", std::to_string(s.search.seed)}};
  if (s.search.start.rows() > 0) options.emplace_back("start", text_of(s.search.start));
  return options;
}

inline Setting::Named stopping_rules(const Stopping& stopping) {
  return {{"generations", std::to_string(stopping.generations)},
          {"evaluations", text_of(stopping.evaluations)},
          {"stall_generations", text_of(stopping.stall_generations)},
          {"stall_gain", doe::detail::number_text(stopping.stall_gain)}};
}

inline Setting::Named rates_of(const Rates& rates) {
  using doe::detail::number_text;
  return {{"crossover_probability", number_text(rates.crossover_probability)},
          {"crossover_index", number_text(rates.crossover_index)},
          {"mutation_probability", number_text(rates.mutation_probability)},
          {"mutation_index", number_text(rates.mutation_index)}};
}

/// Before the state of a checkpoint; the search that goes on from it must have the same.
struct HeadLine {
  std::string text;
  bool stopping_rule = false;  ///< its value may differ
};

inline std::vector<HeadLine> head_of(const doe::Problem& problem, const Setting& s) {
  std::vector<HeadLine> lines{{std::string(checkpoint_format)},
                              {"search " + s.place.substr(0, s.place.find(": "))}};
  for (const doe::Variable& v : problem.variables) lines.push_back({line_of(v)});
  for (const doe::Response& r : problem.responses) lines.push_back({line_of(r)});
  const auto add = [&](const Setting::Named& options, bool stopping_rule = false) {
    for (const auto& [name, value] : options)
      lines.push_back({"option " + name + " " + value, stopping_rule});
  };
  add(sizes_and_start(s));
  add(stopping_rules(s.search.stopping), true);
  add(rates_of(s.rates));
  add(s.own);
  return lines;
}

class CheckpointWriter {
 public:
  explicit CheckpointWriter(const std::vector<HeadLine>& head) {
    for (const HeadLine& line : head) text_ += line.text + "\n";
    text_ += "state\n";
  }

  /// The whole file.
  std::string text() const { return text_ + "checksum " + doe::detail::checksum(text_) + "\n"; }

  void item(const char* name, int value) { line(name, std::to_string(value)); }
  void item(const char* name, const std::string& value) { line(name, doe::detail::on_one_line(value)); }

  template <class Matrix>
  void item(const char* name, const Eigen::PlainObjectBase<Matrix>& values) {
    std::string text = std::to_string(values.rows()) + " " + std::to_string(values.cols());
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      for (Eigen::Index i = 0; i < values.rows(); ++i)
        text.append(" ").append(doe::detail::number_text(values(i, j)));
    line(name, text);
  }

  void item(const char* name, const std::vector<double>& values) {
    item(name, Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(),
                                                                 static_cast<Eigen::Index>(values.size()))));
  }

  void item(const char* name, const std::optional<StopReason>& reason) {
    line(name, reason ? std::string(to_string(*reason)) : "none");
  }

  void item(const char* name, const Population& p) {
    item(name, static_cast<int>(p.size()));
    item("U", p.U);
    item("responses", p.responses);
    item("Y", p.Y);
    item("violations", p.violations);
    item("failed", std::vector<double>(p.failed.begin(), p.failed.end()));
  }

 private:
  void line(const char* name, const std::string& rest) {
    text_.append(name).append(" ").append(rest).append("\n");
  }

  std::string text_;
};

/// Reads what the writer wrote, in the same order. All members throw std::runtime_error.
class CheckpointReader {
 public:
  CheckpointReader(const std::filesystem::path& path, const std::vector<HeadLine>& head)
      : path_(path.string()) {
    std::ifstream file(path, std::ios::binary);
    if (!file) fail("cannot be read; check the name and the permissions");
    text_.assign(std::istreambuf_iterator<char>(file), {});
    if (text_.substr(0, text_.find('\n')) != checkpoint_format)
      fail("is no checkpoint that this version reads: its first line is not \"" +
           std::string(checkpoint_format) + "\"");
    cut_checksum();
    for (const HeadLine& expected : head) compare(expected);
    if (const std::string found = next(); found != "state") refuse(found, "state");
    if (rules_differ_ && text_.find("\nasked 0 ", at_ - 1) != std::string::npos)
      fail(
          "is of a search that an earlier version ended, which kept no points to go on with; restore it with "
          "the stopping rules that ended it, or begin the search anew");
  }

  /// Whether a stopping rule of the file differs from that of the search.
  bool rules_differ() const { return rules_differ_; }

  void item(const char* name, int& value) {
    const std::string rest = after(name);
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error != std::errc() || end != rest.data() + rest.size()) damaged(name);
  }

  void item(const char* name, std::string& value) { value = doe::detail::from_one_line(after(name)); }

  template <class Matrix>
  void item(const char* name, Eigen::PlainObjectBase<Matrix>& values) {
    const std::string rest = after(name);
    const char *at = rest.data(), *const end = at + rest.size();
    Eigen::Index rows = 0, columns = 0;
    number(name, at, end, rows);
    number(name, at, end, columns);
    values.resize(rows, columns);
    for (Eigen::Index j = 0; j < columns; ++j)
      for (Eigen::Index i = 0; i < rows; ++i) number(name, at, end, values(i, j));
    if (at != end) damaged(name);
  }

  void item(const char* name, std::vector<double>& values) {
    Eigen::VectorXd numbers;
    item(name, numbers);
    values.assign(numbers.begin(), numbers.end());
  }

  void item(const char* name, std::optional<StopReason>& reason) {
    const std::string text = after(name);
    reason = doe::detail::enumerator_of<StopReason>(text);
    if (!reason && text != "none") damaged(name);
  }

  void item(const char* name, Population& p) {
    int size = 0;
    Eigen::MatrixXd U;
    std::vector<double> failed;
    item(name, size);
    item("U", U);
    p.U = U;
    item("responses", p.responses);
    item("Y", p.Y);
    item("violations", p.violations);
    item("failed", failed);
    p.failed.assign(failed.begin(), failed.end());
    if (p.size() != size) damaged(name);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("pareto::Search::restore: \"" + path_ + "\" " + what);
  }

  [[noreturn]] void damaged(const std::string& name) const {
    fail("is damaged at \"" + name + "\"; take an older copy or begin the search anew");
  }

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    const bool option = found.starts_with("option ") && expected.starts_with("option ");
    const bool search = expected.starts_with("search ");
    fail(std::string(option   ? "was made with other options"
                     : search ? "is of another search"
                              : "is of another problem") +
         ": it has \"" + found + "\" where this search has \"" + expected +
         "\"; restore it into the search that it is of");
  }

  /// Leaves the text without its last line.
  void cut_checksum() {
    const std::size_t last = text_.size() < 2 ? 0 : text_.rfind('\n', text_.size() - 2) + 1;
    const std::string line = text_.substr(last);
    if (!line.starts_with("checksum ") || line.back() != '\n')
      fail("is cut off: the checksum at its end is missing; take an older copy or begin the search anew");
    text_.resize(last);
    if (line != "checksum " + doe::detail::checksum(text_) + "\n")
      fail("is damaged: its checksum does not fit; take an older copy or begin the search anew");
  }

  void compare(const HeadLine& expected) {
    const std::string found = next();
    if (found == expected.text) return;
    const auto name = [](const std::string& line) { return line.substr(0, line.rfind(' ')); };
    if (!expected.stopping_rule || name(found) != name(expected.text)) refuse(found, expected.text);
    rules_differ_ = true;
  }

  std::string next() {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string::npos) return "";
    std::string line = text_.substr(at_, end - at_);
    at_ = end + 1;
    return line;
  }

  std::string after(const std::string& name) {
    const std::string line = next();
    if (!line.starts_with(name + " ")) damaged(name);
    return line.substr(name.size() + 1);
  }

  template <class Number>
  void number(const char* name, const char*& at, const char* end, Number& value) const {
    if (at != end && *at == ' ') ++at;
    const auto [behind, error] = std::from_chars(at, end, value);
    if (error != std::errc()) damaged(name);
    at = behind;
  }

  std::string path_, text_;
  std::size_t at_ = 0;
  bool rules_differ_ = false;
};

}  // namespace drawpoint::pareto::detail
