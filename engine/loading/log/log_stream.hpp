// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <filesystem>

/// A log that grows on the disk while its run goes on, without what is there being written again.
///
/// What the run has done when the log is first kept stands in the log's own file, what follows in files beside
/// it, FILE.part0002 and so on. Each is a loading log of its own, written once, whole or not at all, and
/// checked when read; read_log joins them. A run that is killed leaves all that was kept. When the run ends its
/// own file becomes the whole log, which says that nothing follows, and the others go.
namespace drawpoint::engine::loading {

class LogStream {
 public:
  /// What an earlier run left, killed, becomes one file first (join_parts). An empty path: nothing is written.
  /// Throws std::runtime_error if the disk refuses, as all here.
  explicit LogStream(std::filesystem::path path);
  /// Writes what the log has beyond what was kept.
  void keep(const LoadingLog& log);
  /// The whole log in its own file, which is that alone then.
  void finish(const LoadingLog& log);

 private:
  std::filesystem::path path_;
  int parts_ = 0;
  std::size_t values_ = 0, cycles_ = 0, frames_ = 0, knots_ = 0;  // kept
};

/// Makes one file of what a killed run has left: the log with all that was kept, which says that nothing follows.
/// Parts beside a log that says so already, or that cannot be read, are removed.
void join_parts(const std::filesystem::path& path);

/// The file of a part of the log at `path`, by its number from 2: FILE.part0002.
std::filesystem::path part_path(const std::filesystem::path& path, int number);

/// One file of a stream. `goes_on`: parts may follow.
void write_part(const std::filesystem::path& path, const LoadingLog& log, bool goes_on);

/// Adds what was kept next; numbers, texts, message and bodies are as they were then.
void append(LoadingLog& log, LoadingLog&& next);

}  // namespace drawpoint::engine::loading
