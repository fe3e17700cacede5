// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Comma-separated values as RFC 4180 has them: a field with a comma, a quote or a line break stands in
/// quotes, a quote inside is doubled. Numbers are written with the fewest digits that read back as the same
/// double.

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drawpoint::doe::detail {

using CsvRecord = std::vector<std::string>;

inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted += '"';
}

inline std::string csv_line(const CsvRecord& record) {
  std::string line;
  for (const std::string& field : record) {
    if (&field != &record.front()) line += ',';
    line += csv_field(field);
  }
  return line += '\n';
}

/// Takes records off the front of a text, one at a time.
class CsvReader {
 public:
  explicit CsvReader(std::string_view text) : rest_(text) {}

  /// Line on which the last record began, from 1.
  int line() const { return line_; }

  /// Why next() stopped before the end of the text; empty when nothing is wrong.
  const std::string& fault() const { return fault_; }

  /// The next record, or nothing at the end of the text or at a fault.
  std::optional<CsvRecord> next() {
    line_ = next_line_;
    if (rest_.empty() || !fault_.empty()) return std::nullopt;
    CsvRecord record(1);
    while (true) {
      if (rest_.empty()) return stop("the file ends inside a line");
      if (rest_.front() == '"' && record.back().empty()) {
        if (!quoted(record.back())) return std::nullopt;
        if (!rest_.empty() && rest_.find_first_of(",\r\n") != 0)
          return stop("text stands behind the closing quote of a field; double quotes inside of one");
      }
      if (rest_.empty()) return stop("the file ends inside a line");
      const char c = take();
      if (c == '\n') return record;
      if (c == '\r' && !rest_.empty() && rest_.front() == '\n') continue;
      if (c == ',') {
        record.emplace_back();
      } else {
        record.back() += c;
      }
    }
  }

 private:
  char take() {
    const char c = rest_.front();
    rest_.remove_prefix(1);
    if (c == '\n') ++next_line_;
    return c;
  }

  std::optional<CsvRecord> stop(const char* fault) {
    fault_ = fault;
    return std::nullopt;
  }

  /// A quoted field up to and with its closing quote.
  bool quoted(std::string& field) {
    take();
    while (!rest_.empty()) {
      const char c = take();
      if (c != '"') {
        field += c;
      } else if (!rest_.empty() && rest_.front() == '"') {
        field += take();
      } else {
        return true;
      }
    }
    fault_ = "the file ends inside a quoted field";
    return false;
  }

  std::string_view rest_;
  int line_ = 1, next_line_ = 1;
  std::string fault_;
};

/// The whole text as a number, or nothing.
template <class Number>
std::optional<Number> csv_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace drawpoint::doe::detail
