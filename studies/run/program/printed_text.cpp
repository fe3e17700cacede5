// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/program/printed_text.h>
#include <drawpoint/studies/run/store/plain_text.h>
#include <drawpoint/doe/detail/stranger_file.hpp>

#include <cstddef>
#include <cstdint>

namespace drawpoint::studies {
namespace {

constexpr std::size_t most_read = std::size_t{64} << 10, most_shown = 300;

/// The last of the program's own, without blanks around it. A carriage return ends a line, too, as in bars of progress.
std::string last_line(std::string text) {
  for (;;) {
    const std::size_t last = text.find_last_not_of(" \t\r\n");
    if (last == std::string::npos) return "";
    const std::size_t before = text.find_last_of("\r\n", last),
                      begin = before == std::string::npos ? 0 : before + 1;
    const std::size_t from = text.find_first_not_of(" \t", begin);
    std::string line = text.substr(from, last + 1 - from);
    if (!line.starts_with(attempt_begins)) return line;
    text.resize(begin);
  }
}

}  // namespace

std::string printed_last(const std::filesystem::path& printed) {
  doe::detail::StrangerFile file(printed);
  if (!file.fault().empty() || file.size() == 0) return "";
  const std::uintmax_t from = file.size() > most_read ? file.size() - most_read : 0;
  const std::string text = file.text(from, most_read), line = plain_text(last_line(text), most_shown);
  const std::string name = " (logs/" + printed.filename().string() + ")";
  if (!line.empty()) return printed_last_begins + ('"' + line) + '"' + name;
  return text.find(attempt_begins) == std::string::npos ? "; it printed blank lines" + name : "";
}

std::string without_log_name(const std::string& reason) {
  const std::size_t name = reason.rfind(" (logs/");
  return name != std::string::npos && reason.ends_with(')') ? reason.substr(0, name) : reason;
}

}  // namespace drawpoint::studies
