// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The runs of a study on disk, one line per run, written as each ends: after a crash or a cancelled evaluation
/// the same call goes on where it stopped.
///
/// Each line is a row of the table of evaluations.hpp and its checksum (FNV-1a, 64 bits, in hexadecimal); the
/// first line is that table's header. Line breaks and backslashes in reasons are written as `\n`, `\r` and `\\`.
/// Lines are only ever appended, each by one call of the system, so a killed process loses at most the runs
/// in flight; the disk is told to sync once a second, so a power cut loses a second more. A torn last line is
/// cut off when the file is opened; damage elsewhere is an error that names the line. One process at a time:
/// a second is refused (POSIX flock).

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/csv.hpp>
#include <drawpoint/doe/detail/hash.hpp>
#include <drawpoint/doe/evaluations.hpp>

namespace drawpoint::doe {

namespace detail {

inline std::string on_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\\')
      line += "\\\\";
    else if (c == '\n')
      line += "\\n";
    else if (c == '\r')
      line += "\\r";
    else
      line += c;
  }
  return line;
}

inline std::string from_one_line(std::string_view line) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '\\' || i + 1 == line.size()) {
      text += line[i];
      continue;
    }
    ++i;
    text += line[i] == 'n' ? '\n' : line[i] == 'r' ? '\r' : line[i];
  }
  return text;
}

/// Record, checksum, line break.
inline std::string journal_line(const CsvRecord& record) {
  std::string line = csv_line(record);
  line.pop_back();
  return line + "," + checksum(line) + "\n";
}

}  // namespace detail

class RunJournal {
 public:
  /// Opens the file, or begins it, and reads what it has. Throws std::runtime_error when it cannot be opened,
  /// is no file, is in use, belongs to another problem or is damaged before its last line.
  RunJournal(const Problem& problem, std::filesystem::path path)
      : problem_(problem), path_(path.string()), parser_(problem_, path) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail_by_system("open");
    try {
      require_file();
      if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
        fail("is in use by another process; wait for it to end or choose another file");
      const std::string text = content();
      const std::size_t sound = read(text);
      if (sound < text.size() && ::ftruncate(descriptor_, static_cast<off_t>(sound)) != 0)
        fail_by_system("shorten");
      if (sound == 0) append(detail::journal_line(detail::csv_header(problem_)));
    } catch (...) {
      ::close(descriptor_);
      throw;
    }
  }
  ~RunJournal() {
    ::fsync(descriptor_);
    ::close(descriptor_);
  }
  RunJournal(const RunJournal&) = delete;
  RunJournal& operator=(const RunJournal&) = delete;

  int size() const { return static_cast<int>(rows_.size()); }

  /// The runs that were there when the file was opened, in order of run and replicate.
  std::vector<Evaluation> rows() const {
    std::vector<Evaluation> all;
    for (const auto& [key, row] : rows_) all.push_back(row);
    return all;
  }

  /// The run that was planned as `row`, or nothing. Throws std::runtime_error when the journal has that run
  /// and replicate at another point or with another seed: it is of another design.
  const Evaluation* find(const Evaluation& row) const {
    const auto found = rows_.find({row.run, row.replicate});
    if (found == rows_.end()) return nullptr;
    if (found->second.x == row.x && found->second.seed == row.seed) return &found->second;
    fail("has run " + std::to_string(row.run) + ", replicate " + std::to_string(row.replicate) +
         " at another point or with another seed; it is of another design: repeat the call that began it, "
         "or choose another file");
  }

  /// Throws std::runtime_error when the disk refuses. Not to be called by several threads at once.
  void add(const Evaluation& row) {
    detail::CsvRecord record = detail::csv_row(row, problem_.responses.size());
    record.back() = detail::on_one_line(record.back());
    append(detail::journal_line(record));
    const auto now = std::chrono::steady_clock::now();
    if (now - synced_ < std::chrono::seconds(1)) return;
    if (::fsync(descriptor_) != 0) fail_by_system("write");
    synced_ = now;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("doe::RunJournal: \"" + path_ + "\" " + what);
  }

  [[noreturn]] void fail_by_system(const char* verb) const {
    throw std::runtime_error("doe::RunJournal: cannot " + std::string(verb) + " \"" + path_ + "\": " +
                             std::system_category().message(errno) + "; check the folder and the free space");
  }

  // A device may be read for ever.
  void require_file() const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) fail_by_system("look at");
    if (!S_ISREG(status.st_mode)) fail("is a device or a pipe; choose a file");
  }

  std::string content() const {
    std::string text;
    char buffer[1 << 16];
    for (ssize_t count; (count = ::read(descriptor_, buffer, sizeof buffer)) != 0;) {
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail_by_system("read");
      text.append(buffer, static_cast<std::size_t>(count));
    }
    return text;
  }

  /// The record of a line without its break, or nothing when its checksum does not fit.
  static std::optional<detail::CsvRecord> record_of(std::string_view line) {
    if (line.size() < 17 || line[line.size() - 17] != ',') return std::nullopt;
    const std::string_view body = line.substr(0, line.size() - 17);
    if (detail::checksum(body) != line.substr(line.size() - 16)) return std::nullopt;
    const std::string whole = std::string(body) + "\n";
    return detail::CsvReader(whole).next();
  }

  /// Fills rows_; returns how much of the text is sound, all but a torn last line.
  std::size_t read(const std::string& text) {
    std::size_t from = 0;
    for (int line = 1; from < text.size(); ++line) {
      const std::size_t end = text.find('\n', from);
      if (end == std::string::npos) return from;
      const auto record = record_of(std::string_view(text).substr(from, end - from));
      if (!record && end + 1 == text.size()) return from;
      if (!record)
        fail("line " + std::to_string(line) +
             " is damaged: its checksum does not fit; delete that line to "
             "run it again");
      if (line == 1) {
        parser_.check_header(*record);
      } else {
        Evaluation row = parser_.parse(*record, line);
        if (row.outcome.failed()) row.outcome = Failure{detail::from_one_line(row.outcome.reason())};
        rows_.insert_or_assign({row.run, row.replicate}, std::move(row));
      }
      from = end + 1;
    }
    return from;
  }

  void append(std::string_view text) {
    while (!text.empty()) {
      const auto written = ::write(descriptor_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail_by_system("write");
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  Problem problem_;
  std::string path_;
  detail::EvaluationParser parser_;
  int descriptor_ = -1;
  std::chrono::steady_clock::time_point synced_{};
  std::map<std::pair<std::int64_t, int>, Evaluation> rows_;
};

}  // namespace drawpoint::doe
