// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A text file that is either the old one or the whole new one, whatever happens: the text goes to a
/// temporary file in the same folder, is synced to the disk, and is renamed over the target (POSIX). Disk
/// full, a read-only folder or a killed process leave the old file as it was.

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace drawpoint::doe {

namespace detail {

/// A temporary file that removes itself unless it was renamed to its target.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target)
      : target_(target.string()), path_(unique_path(target_)) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("create a file beside");
  }
  ~TemporaryFile() {
    ::close(descriptor_);
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view text) {
    while (!text.empty()) {
      const auto written = ::write(descriptor_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail("write");
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  /// For another program that writes it.
  const std::string& path() const { return path_; }

  void replace_target() {
    if (::fsync(descriptor_) != 0) fail("write");
    if (std::rename(path_.c_str(), target_.c_str()) != 0) fail("replace");
    path_.clear();
  }

 private:
  static std::string unique_path(const std::string& target) {
    static std::atomic<unsigned> serial{0};
    return target + "." + std::to_string(::getpid()) + "-" + std::to_string(serial++) + ".tmp";
  }

  [[noreturn]] void fail(const char* verb) const {
    const std::string reason = std::system_category().message(errno);
    throw std::runtime_error("doe::write_file: cannot " + std::string(verb) + " \"" + target_ + "\": " +
                             reason + "; the file is as it was; check the folder and the free space");
  }

  std::string target_, path_;
  int descriptor_ = -1;
};

}  // namespace detail

/// Throws std::runtime_error with the system's reason when the file cannot be written; the old file then
/// still stands.
inline void write_file(const std::filesystem::path& path, std::string_view text) {
  detail::TemporaryFile file(path);
  file.write(text);
  file.replace_target();
}

}  // namespace drawpoint::doe
