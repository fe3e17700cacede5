// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Child processes, several at a time, each with a private channel for its reply.
///
/// A child is started by fork and exec in a process group of its own (a Ctrl-C in the terminal reaches the
/// parent only, which then decides), with one thread (OMP_NUM_THREADS and its like are 1), with nothing on
/// standard input, with standard output and error in a file, and with file descriptor 3 as the reply channel,
/// which takes 16 MiB at most: who writes more is killed.
/// It is killed by the kernel if the thread that started it dies, and what it has started too
/// (orphan_reaper.hpp), unless that left its process group. Linux only. One thread at a time may use a
/// pool. process_pool.hpp makes a black box of it.

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/orphan_reaper.hpp>
#include <drawpoint/doe/detail/start_process.hpp>

namespace drawpoint::doe {

/// One child process to start.
struct Process {
  std::int64_t id = 0;
  std::string executable = {};              ///< a path, or a name to look for in the PATH
  std::vector<std::string> arguments = {};  ///< without the program name
  /// File for what the child prints, removed if it stays empty; no name: where this process prints.
  std::filesystem::path output = "/dev/null";
  double time_limit = 0.0;                    ///< [s] before it is killed; 0 means none
  std::filesystem::path input = "/dev/null";  ///< file for its standard input
  bool errors_apart = false;  ///< standard error goes where this process prints, whatever `output` is
};

/// How a child ended.
struct ProcessEnd {
  std::int64_t id = 0;
  std::string reply = {};  ///< all that it wrote to descriptor 3
  int wait_status = 0;     ///< as from waitpid
  bool timed_out = false;  ///< killed because of its time limit
  double time_limit = 0.0;
  double seconds = 0.0;          ///< wall time
  std::string told = {};         ///< in place of wait_status, where there is none: how it ended, in words
  std::string not_started = {};  ///< why the system could not start it, in its words; empty: it was started
};

/// The system has no process or no file descriptor for one more child.
struct NoProcess : std::runtime_error {
  using std::runtime_error::runtime_error;
};

namespace detail {

inline std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (auto& word : words) result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

inline std::vector<std::string> single_threaded_environment() {
  const std::vector<std::string> threads = {"OMP_NUM_THREADS=", "OPENBLAS_NUM_THREADS=", "MKL_NUM_THREADS="};
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const auto begins = [&](const std::string& name) { return text.compare(0, name.size(), name) == 0; };
    if (std::none_of(threads.begin(), threads.end(), begins)) result.push_back(text);
  }
  for (const auto& name : threads) result.push_back(name + "1");
  return result;
}

inline void remove_if_empty(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return;  // /dev/null
  if (std::filesystem::file_size(file, ignored) == 0 && !ignored) std::filesystem::remove(file, ignored);
}

inline NoProcess cannot_start(const std::string& what, int error) {
  return NoProcess("doe::ProcessPool: " + what + ": " + std::strerror(error) +
                   "; run fewer processes at a time");
}

inline constexpr std::size_t largest_reply = std::size_t{16} << 20;

}  // namespace detail

/// "ended by signal SIGSEGV (Segmentation fault)", "ended with exit code 3", ...
inline std::string describe(const ProcessEnd& end) {
  if (!end.not_started.empty()) return "could not be started: " + end.not_started;
  if (!end.told.empty()) return end.told;
  if (end.timed_out) {
    char text[64];
    std::snprintf(text, sizeof text, "stopped after %.3g s, its time limit", end.time_limit);
    return text;
  }
  if (WIFSIGNALED(end.wait_status)) {
    const int signal = WTERMSIG(end.wait_status);
    const char* name = sigabbrev_np(signal);
    const char* words = sigdescr_np(signal);
    std::string text = "ended by signal " + (name ? "SIG" + std::string(name) : std::to_string(signal));
    if (words) text += " (" + std::string(words) + ")";
    if (signal == SIGKILL) text += ", often because memory ran out";
    return text;
  }
  const int code = WEXITSTATUS(end.wait_status);
  return "ended with exit code " + std::to_string(code) +
         (code == 127 ? ", a shell's for a program that it does not find" : "");
}

class ProcessPool {
 public:
  /// Throws std::runtime_error as start.
  explicit ProcessPool(int jobs) : jobs_(jobs), reaper_(static_cast<std::size_t>(std::max(jobs, 1))) {
    assert(jobs >= 1);
  }
  ~ProcessPool() { terminate(std::chrono::milliseconds(0)); }  ///< kills what still runs
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  bool full() const { return running() >= jobs_; }
  int running() const { return static_cast<int>(children_.size()); }

  /// Starts a child. Requires !full(). Throws NoProcess if the system gives no process or pipe.
  void start(const Process& process) {
    assert(!full());
    std::vector<std::string> words = {process.executable};
    words.insert(words.end(), process.arguments.begin(), process.arguments.end());
    std::vector<std::string> settings = detail::single_threaded_environment();
    auto arguments = detail::pointers(words);
    auto environment = detail::pointers(settings);
    int ends[2];
    detail::SharedTrouble trouble = detail::shared_trouble();
    if (!trouble || pipe2(ends, O_CLOEXEC) != 0) throw detail::cannot_start("no pipe for a process", errno);
    const pid_t parent = getpid();
    const pid_t pid = fork();
    if (pid == 0)
      detail::become(arguments.data(), environment.data(),
                     {process.input.c_str(), process.output.c_str(), process.errors_apart, ends[1]}, parent,
                     trouble.get());
    const int fork_error = errno;
    close(ends[1]);
    if (pid < 0) {
      close(ends[0]);
      throw detail::cannot_start("cannot start a process", fork_error);
    }
    setpgid(pid, pid);  // also here: whichever of the two comes first
    reaper_.add(pid);
    fcntl(ends[0], F_SETFL, O_NONBLOCK);
    children_.push_back({process.id, pid, ends[0], std::move(trouble), process.executable, process.output,
                         Clock::now(), process.time_limit});
  }

  /// Children that have ended since the last call, in order of id; waits at most `patience` for the first
  /// one. Returns early, maybe with nothing, when a signal arrives.
  std::vector<ProcessEnd> wait(std::chrono::milliseconds patience) {
    std::vector<ProcessEnd> ends;
    collect(ends);
    if (ends.empty() && !children_.empty()) {
      read_replies(patience);
      enforce_time_limits();
      collect(ends);
    }
    std::sort(ends.begin(), ends.end(), [](const ProcessEnd& a, const ProcessEnd& b) { return a.id < b.id; });
    return ends;
  }

  /// Asks all children to end (SIGTERM), kills those that still run after `grace`. Their results are dropped.
  void terminate(std::chrono::milliseconds grace) {
    for (const Child& child : children_) kill(-child.pid, SIGTERM);
    const auto deadline = Clock::now() + grace;
    std::vector<ProcessEnd> dropped;
    while (!children_.empty() && Clock::now() < deadline) {
      collect(dropped);
      if (!children_.empty()) poll(nullptr, 0, 5);
    }
    for (const Child& child : children_) kill(-child.pid, SIGKILL);
    while (!children_.empty()) {
      collect(dropped);
      if (!children_.empty()) poll(nullptr, 0, 1);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  struct Child {
    std::int64_t id;
    pid_t pid;
    int reply_descriptor;
    detail::SharedTrouble trouble;
    std::string program;
    std::filesystem::path output;
    Clock::time_point started;
    double time_limit;
    std::string reply = {};
    bool timed_out = false;
    bool reply_closed = false;
    bool says_too_much = false;

    double seconds() const { return std::chrono::duration<double>(Clock::now() - started).count(); }

    void read_reply() {
      char buffer[4096];
      ssize_t count = 0;
      while (!says_too_much && (count = read(reply_descriptor, buffer, sizeof buffer)) > 0) {
        reply.append(buffer, static_cast<std::size_t>(count));
        says_too_much = reply.size() > detail::largest_reply;
      }
      reply_closed = count == 0;
    }

    ProcessEnd end(int status) {
      ProcessEnd end{id, says_too_much ? "" : std::move(reply), status, timed_out, time_limit, seconds()};
      if (says_too_much) end.told = "was stopped, for its reply is longer than 16 MiB";
      if (trouble->step != detail::StartTrouble::none)
        end.not_started = detail::why_not_started(program, *trouble);
      return end;
    }
  };

  void read_replies(std::chrono::milliseconds patience) {
    std::vector<pollfd> open_replies;
    std::vector<Child*> owners;
    bool one_is_ending = false;
    for (Child& child : children_) {
      one_is_ending = one_is_ending || child.reply_closed || child.says_too_much;
      if (child.reply_closed || child.says_too_much) continue;
      open_replies.push_back({child.reply_descriptor, POLLIN, 0});
      owners.push_back(&child);
    }
    // A closed reply means that the child is about to end: look again soon.
    const auto wait = one_is_ending ? std::min(patience, std::chrono::milliseconds(2)) : patience;
    if (poll(open_replies.data(), open_replies.size(), static_cast<int>(wait.count())) <= 0) return;
    for (std::size_t i = 0; i < owners.size(); ++i)
      if (open_replies[i].revents != 0) owners[i]->read_reply();
  }

  void enforce_time_limits() {
    for (Child& child : children_) {
      if (child.says_too_much) kill(-child.pid, SIGKILL);
      if (child.time_limit <= 0.0 || child.timed_out || child.seconds() < child.time_limit) continue;
      child.timed_out = true;
      kill(-child.pid, SIGKILL);
    }
  }

  void collect(std::vector<ProcessEnd>& ends) {
    const auto ended = [&](Child& child) {
      siginfo_t info{};
      const int options = WEXITED | WNOHANG | WNOWAIT;  // until it is waited for, its number is no other's
      if (waitid(P_PID, static_cast<id_t>(child.pid), &info, options) != 0 || info.si_pid != child.pid)
        return false;
      kill(-child.pid, SIGKILL);  // whatever the child itself has left behind
      reaper_.remove(child.pid);
      int status = 0;
      waitpid(child.pid, &status, 0);
      child.read_reply();
      close(child.reply_descriptor);
      detail::remove_if_empty(child.output);
      ends.push_back(child.end(status));
      return true;
    };
    children_.erase(std::remove_if(children_.begin(), children_.end(), ended), children_.end());
  }

  int jobs_;
  detail::OrphanReaper reaper_;
  std::vector<Child> children_;
};

}  // namespace drawpoint::doe
