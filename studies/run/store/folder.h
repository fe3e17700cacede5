// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The output folder of a study: where each file lies, that it can be written, and that one process works
/// on it.
///
///     DIR/study.db             the store
///     DIR/report.html          the report
///     DIR/replay_0001.html     the replay of a run, where the command replay has made it
///     DIR/shared/              from Study::prepare
///     DIR/shared.checksums     of its files
///     DIR/logs/run_0001.h5     run log, named by the run's id
///     DIR/logs/run_0001.txt    what the run printed, if anything
///     DIR/logs/unfinished/     logs of runs in flight
///     DIR/slurm/               what passes between `run --slurm` and its tasks
///     DIR/.lock                held while a command works
///
/// A file appears under its final name only when it is complete: it is written under another name beside it,
/// then renamed.

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>

namespace drawpoint::studies {

struct Folder {
  std::filesystem::path path;

  std::filesystem::path store() const { return path / "study.db"; }
  std::filesystem::path lock() const { return path / ".lock"; }
  std::filesystem::path report() const { return path / "report.html"; }
  /// replay_0001.html, of one cycle replay_0001_cycle_2.html
  std::filesystem::path replay(std::int64_t id, std::optional<int> cycle = {}) const;
  std::filesystem::path shared() const { return path / "shared"; }
  std::filesystem::path shared_checksums() const { return path / "shared.checksums"; }
  std::filesystem::path logs() const { return path / "logs"; }
  std::filesystem::path unfinished() const { return logs() / "unfinished"; }
  std::filesystem::path slurm() const { return path / "slurm"; }
  std::filesystem::path log(std::int64_t id) const;  ///< logs/run_0001.h5
  std::filesystem::path unfinished_log(std::int64_t id) const;
  std::filesystem::path printed(std::int64_t id) const;  ///< logs/run_0001.txt
};

/// Makes the folder with its subfolders and writes a probe file. Throws std::runtime_error that says what is
/// in the way: a file of that name, no permission, a read-only file system, a full disk.
void make_writable(const Folder& folder);

/// The file under a second name, by a link where the file system can. Throws
/// std::filesystem::filesystem_error.
void link_or_copy(const std::filesystem::path& file, const std::filesystem::path& to);

/// Free space [bytes] for this user on the file system of `path`; the largest number where it cannot be told.
std::uintmax_t free_space(const std::filesystem::path& path);

/// Below this much free space [bytes] a study does not start a run: its log and the store would not fit.
inline constexpr std::uintmax_t least_free_space = 1u << 20;

/// Holds DIR/.lock until destroyed; the system releases it when the process dies, however it dies.
class FolderLock {
 public:
  /// Throws std::runtime_error with the other process's number if the folder is taken.
  explicit FolderLock(const Folder& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// Who works in a folder.
struct FolderHolder {
  std::int64_t process = 0;
  std::time_t since = 0;
};

/// The process of this machine that holds DIR/.lock; nothing where there is none, or it cannot be told. Takes
/// no lock itself, so that nobody finds the folder taken by who only asks.
std::optional<FolderHolder> holder_of(const Folder& folder);

}  // namespace drawpoint::studies
