// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <drawpoint/engine/base/atomic_file.hpp>
#include <stdexcept>
#include <string>
#include <system_error>

namespace drawpoint::engine {
namespace {

// A temporary file that removes itself unless it was renamed to its target.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target)
      : target_(target.string()), path_(unique_path(target_)) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("create a file beside");
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::span<const std::byte> bytes) {
    constexpr std::size_t piece = 1u << 30;  // Linux writes at most 2 GiB in one call
    while (!bytes.empty()) {
      const auto written = ::write(descriptor_, bytes.data(), std::min(bytes.size(), piece));
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail("write");
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  }

  const std::string& path() const { return path_; }

  void finish() {
    if (::fsync(descriptor_) != 0) fail("write");
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail("write");
  }

  void replace_target() {
    if (std::rename(path_.c_str(), target_.c_str()) != 0) fail("replace");
    path_.clear();
  }

 private:
  static std::string unique_path(const std::string& target) {
    static std::atomic<unsigned> serial{0};
    return target + "." + std::to_string(::getpid()) + "-" + std::to_string(serial++) + ".tmp";
  }

  [[noreturn]] void fail(const char* verb) {
    const std::string reason = std::system_category().message(errno);
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
    ::unlink(path_.c_str());
    throw std::runtime_error("engine: cannot " + std::string(verb) + " \"" + target_ + "\": " + reason +
                             "; the file is as it was; check the folder and the free space");
  }

  std::string target_, path_;
  int descriptor_ = -1;
};

// The rename itself survives a power cut only with the folder synced. Some file systems cannot; the data is
// safe all the same.
void sync_folder(const std::filesystem::path& target) {
  const std::filesystem::path parent = target.parent_path();
  const int folder = ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  ::fsync(folder);
  ::close(folder);
}

}  // namespace

void write_atomically(const std::filesystem::path& target, std::span<const std::byte> bytes,
                      const std::function<void(const std::filesystem::path&)>& check) {
  TemporaryFile file(target);
  file.write(bytes);
  file.finish();
  if (check) check(file.path());
  file.replace_target();
  sync_folder(target);
}

}  // namespace drawpoint::engine
