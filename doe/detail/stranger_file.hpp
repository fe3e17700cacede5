// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Files that another program has left: nothing that lies there blocks its reader, is followed elsewhere or
/// fills the memory. Only a regular file is read.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

namespace drawpoint::doe::detail {

enum class Links { follow, refuse };

inline const char* kind_of_file(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  if (S_ISLNK(mode)) return "a symbolic link";
  return "a device";
}

/// An open regular file, or the reason why there is none.
class StrangerFile {
 public:
  explicit StrangerFile(const std::filesystem::path& file, Links links = Links::refuse) { open(file, links); }
  ~StrangerFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  StrangerFile(const StrangerFile&) = delete;
  StrangerFile& operator=(const StrangerFile&) = delete;

  bool missing() const { return missing_; }
  /// Why it cannot be read, behind its name: "is a directory, no file"; empty: it can.
  const std::string& fault() const { return fault_; }
  std::uintmax_t size() const { return size_; }

  /// The next bytes, 0 at the end and -1 with errno, as read(2).
  ssize_t read(char* to, std::size_t count) { return ::read(descriptor_, to, count); }

  /// Up to `most` bytes from `from` on. What cannot be read ends it.
  std::string text(std::uintmax_t from, std::size_t most) {
    std::string text(
        static_cast<std::size_t>(std::min<std::uintmax_t>(most, from < size_ ? size_ - from : 0)), '\0');
    std::size_t count = 0;
    for (ssize_t got = 1; count < text.size() && got > 0;) {
      got = ::pread(descriptor_, text.data() + count, text.size() - count, static_cast<off_t>(from + count));
      if (got > 0) count += static_cast<std::size_t>(got);
    }
    text.resize(count);
    return text;
  }

 private:
  void open(const std::filesystem::path& file, Links links) {
    struct stat status = {};
    if ((links == Links::follow ? ::stat(file.c_str(), &status) : ::lstat(file.c_str(), &status)) != 0)
      return refuse(errno);
    if (!S_ISREG(status.st_mode)) return refuse(status);
    // Whatever took its place in the meantime does not block either.
    const int flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
    descriptor_ = ::open(file.c_str(), flags | (links == Links::refuse ? O_NOFOLLOW : 0));
    if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) return refuse(errno);
    if (!S_ISREG(status.st_mode)) return refuse(status);
    size_ = static_cast<std::uintmax_t>(status.st_size);
  }

  void refuse(const struct stat& status) {
    fault_ = std::string("is ") + kind_of_file(status.st_mode) + ", no file";
  }

  void refuse(int error) {
    missing_ = error == ENOENT || error == ENOTDIR;
    fault_ = error == ELOOP ? "is a symbolic link, no file"
                            : std::string("cannot be read: ") + std::strerror(error);
  }

  int descriptor_ = -1;
  bool missing_ = false;
  std::string fault_;
  std::uintmax_t size_ = 0;
};

/// Whatever has this name goes: a file, a link, or a folder with all that is in it.
inline void clear_away(const std::filesystem::path& file) {
  std::error_code ignored;
  std::filesystem::remove_all(file, ignored);
}

}  // namespace drawpoint::doe::detail
