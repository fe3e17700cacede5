// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A folder for this process alone, which goes away with it however it ends.
///
/// A shell waits for the end of a pipe that this process holds, which even SIGKILL cannot prevent, and
/// removes the folder then. Linux only.

#include <sys/types.h>

#include <filesystem>

namespace drawpoint::studies {

class Scratch {
 public:
  /// Throws std::runtime_error that names the folder for temporary files.
  Scratch();
  ~Scratch();  ///< when the folder is gone
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int pipe_ = -1;
  pid_t remover_ = -1;
};

}  // namespace drawpoint::studies
