// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/frames/scratch.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

// A process that is being killed may still write: the folder is looked at again.
constexpr const char* remove_at_end =
    "trap '' INT TERM HUP; read line; for i in 1 2 3 4 5 6 7 8 9 10; do rm -rf -- \"$0\" 2>/dev/null; sleep "
    "0.1; [ -e \"$0\" ] || exit 0; done";

[[noreturn]] void no_scratch(const std::string& what, int error) {
  throw std::runtime_error("replay: cannot make " + what + " in " + fs::temp_directory_path().string() +
                           ": " + std::strerror(error) + "; name another folder in TMPDIR");
}

/// Its number, or -1 with errno. In a session of its own: the terminal's Ctrl-C does not reach it.
pid_t started_remover(const fs::path& folder, int end_of_pipe) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, end_of_pipe, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  std::string name = folder.string(), script = remove_at_end, shell = "sh", option = "-c";
  char* words[] = {shell.data(), option.data(), script.data(), name.data(), nullptr};
  pid_t pid = -1;
  errno = posix_spawn(&pid, "/bin/sh", &actions, &attributes, words, environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return errno == 0 ? pid : -1;
}

}  // namespace

Scratch::Scratch() {
  std::string name = (fs::temp_directory_path() / "drawpoint-frames-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) no_scratch("a folder", errno);
  path_ = name;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) == 0) {
    pipe_ = ends[1];
    remover_ = started_remover(path_, ends[0]);
    ::close(ends[0]);
  }
  if (remover_ >= 0) return;
  const int error = errno;
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (pipe_ >= 0) ::close(pipe_);
  no_scratch("a process that removes a folder", error);
}

Scratch::~Scratch() {
  ::close(pipe_);
  while (waitpid(remover_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace drawpoint::studies
