// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/folder.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

std::string numbered(const char* what, std::int64_t id) {
  char name[40];
  std::snprintf(name, sizeof name, "%s_%04lld", what, static_cast<long long>(id));
  return name;
}

std::string stem(std::int64_t id) { return numbered("run", id); }

[[noreturn]] void refuse(const fs::path& place, int error) {
  std::string advice = "choose another folder with --out";
  if (error == ENOSPC || error == EDQUOT) advice = "free some space, or choose another disk with --out";
  if (error == EACCES || error == EPERM || error == EROFS)
    advice = "allow writing there, or choose another folder with --out";
  throw std::runtime_error("studies: cannot write in " + place.string() + ": " + std::strerror(error) + "; " +
                           advice);
}

void make_folder(const fs::path& path) {
  std::error_code error;
  if (fs::is_symlink(path, error) && !fs::exists(path, error))
    throw std::runtime_error("studies: " + path.string() + " is a link to " +
                             fs::read_symlink(path, error).string() +
                             ", which is not there; make that folder, or choose another one with --out");
  fs::create_directories(path, error);
  if (error) refuse(path, error.value());
  if (!fs::is_directory(path, error)) refuse(path, ENOTDIR);
}

/// Permissions, quotas and full disks show for certain only in a real write that has reached the disk.
void write_probe(const fs::path& folder) {
  const fs::path probe = folder / (".probe-" + std::to_string(getpid()));
  const int file = open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) refuse(folder, errno);
  const std::string block(4096, '\n');
  errno = 0;
  const bool written =
      write(file, block.data(), block.size()) == static_cast<ssize_t>(block.size()) && fsync(file) == 0;
  const int error = written ? 0 : (errno != 0 ? errno : ENOSPC);
  close(file);
  unlink(probe.c_str());
  if (error != 0) refuse(folder, error);
}

}  // namespace

fs::path Folder::replay(std::int64_t id, std::optional<int> cycle) const {
  const std::string of_cycle = cycle ? "_cycle_" + std::to_string(*cycle) : "";
  return path / (numbered("replay", id) + of_cycle + ".html");
}
fs::path Folder::log(std::int64_t id) const { return logs() / (stem(id) + ".h5"); }
fs::path Folder::unfinished_log(std::int64_t id) const { return unfinished() / (stem(id) + ".h5"); }
fs::path Folder::printed(std::int64_t id) const { return logs() / (stem(id) + ".txt"); }

void make_writable(const Folder& folder) {
  make_folder(folder.path);
  write_probe(folder.path);
  make_folder(folder.unfinished());
  write_probe(folder.unfinished());
  if (free_space(folder.path) < least_free_space) refuse(folder.path, ENOSPC);
}

void link_or_copy(const fs::path& file, const fs::path& to) {
  std::error_code cannot;
  fs::create_hard_link(file, to, cannot);
  if (cannot) fs::copy_file(file, to);
}

std::uintmax_t free_space(const fs::path& path) {
  std::error_code error;
  const auto space = fs::space(path, error);
  return error ? std::numeric_limits<std::uintmax_t>::max() : space.available;
}

FolderLock::FolderLock(const Folder& folder) {
  const fs::path file = folder.lock();
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (descriptor_ < 0) refuse(file, errno);
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    if (error != EWOULDBLOCK) {
      close(descriptor_);
      refuse(file, error);
    }
    char holder[32] = {};
    const bool known = read(descriptor_, holder, sizeof holder - 1) > 0;
    close(descriptor_);
    throw std::runtime_error("studies: another process" +
                             (known ? " (number " + std::string(holder) + ")" : std::string()) +
                             " is working in " + folder.path.string() +
                             "; wait for it, stop it, or choose another folder with --out");
  }
  const std::string number = std::to_string(getpid());
  if (ftruncate(descriptor_, 0) != 0 || write(descriptor_, number.data(), number.size()) < 0) {
    const int error = errno;
    close(descriptor_);
    refuse(file, error);
  }
}

FolderLock::~FolderLock() { close(descriptor_); }

std::optional<FolderHolder> holder_of(const Folder& folder) {
  const fs::path file = folder.lock();
  struct stat status = {};
  std::int64_t process = 0;
  if (stat(file.c_str(), &status) != 0 || !(std::ifstream(file) >> process)) return std::nullopt;
  // "1: FLOCK  ADVISORY  WRITE 30397 fe:00:10952907 0 EOF": process, device and inode
  const std::string inode = ":" + std::to_string(status.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, mode, access, place;
    std::int64_t holder = 0;
    if (words >> number >> kind >> mode >> access >> holder >> place && kind == "FLOCK" &&
        holder == process && place.ends_with(inode))
      return FolderHolder{process, status.st_mtime};
  }
  return std::nullopt;
}

}  // namespace drawpoint::studies
