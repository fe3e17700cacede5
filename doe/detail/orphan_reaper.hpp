// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Kills process groups when the process that owns them is gone, however it went.
///
/// The kernel kills a child whose parent dies (PR_SET_PDEATHSIG), but not what the child has started. So a
/// small process of its own watches: it is told which groups there are, and when its socket closes or its
/// owner is no longer its parent, which even SIGKILL cannot prevent, it kills them and ends. What leaves its
/// process group is not reached. Linux only.

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::doe::detail {

class OrphanReaper {
 public:
  /// At most `groups` at a time. Throws std::runtime_error if the system gives no process or socket.
  explicit OrphanReaper(std::size_t groups) {
    std::vector<pid_t> watched(groups, 0);  // made here: after fork only plain system calls are safe
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) fail("no socket", errno);
    const pid_t owner = getpid();
    pid_ = fork();
    if (pid_ == 0) watch(ends[1], owner, watched);
    const int fork_error = errno;
    close(ends[1]);
    socket_ = ends[0];
    if (pid_ < 0) {
      close(socket_);
      fail("no process", fork_error);
    }
  }
  /// Requires that no group is left: the reaper, which somebody may have stopped, is killed.
  ~OrphanReaper() {
    close(socket_);
    kill(pid_, SIGKILL);
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  OrphanReaper(const OrphanReaper&) = delete;
  OrphanReaper& operator=(const OrphanReaper&) = delete;

  void add(pid_t group) const { tell(group); }
  void remove(pid_t group) const { tell(-group); }

 private:
  [[noreturn]] static void fail(const std::string& what, int error) {
    throw std::runtime_error("doe::ProcessPool: " + what + " to watch over processes: " +
                             std::strerror(error) + "; run fewer processes at a time");
  }

  // Whether it arrives does not matter: a reaper that is gone has no owner to outlive.
  void tell(pid_t message) const { (void)send(socket_, &message, sizeof message, MSG_NOSIGNAL); }

  /// In the child, with the terminal's signals ignored: its owner decides.
  [[noreturn]] static void watch(int socket, pid_t owner, std::vector<pid_t>& watched) {
    setpgid(0, 0);
    for (const int terminal : {SIGINT, SIGTERM, SIGHUP}) ::signal(terminal, SIG_IGN);
    prctl(PR_SET_NAME, "drawpoint-watch");
    if (dup2(socket, STDIN_FILENO) < 0) _exit(1);
    closefrom(STDERR_FILENO + 1);  // the owner's files, pipes and locks are not the reaper's
    constexpr int patience = 500;  // [ms] between two looks at the owner
    pollfd news{STDIN_FILENO, POLLIN, 0};
    pid_t message = 0;
    while (getppid() == owner) {
      if (poll(&news, 1, patience) <= 0) continue;
      const ssize_t count = read(STDIN_FILENO, &message, sizeof message);
      if (count < 0 && errno == EINTR) continue;
      if (count != sizeof message) break;
      pid_t* const end = watched.data() + watched.size();
      pid_t* const place = std::find(watched.data(), end, message > 0 ? 0 : -message);
      if (place != end) *place = std::max(message, 0);
    }
    for (const pid_t group : watched)
      if (group > 0) kill(-group, SIGKILL);
    _exit(0);
  }

  pid_t pid_ = -1;
  int socket_ = -1;
};

}  // namespace drawpoint::doe::detail
