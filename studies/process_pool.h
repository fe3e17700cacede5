// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Child processes, several at a time, each with a private channel for its reply.
///
/// A child is started by fork and exec in a process group of its own (a Ctrl-C in the terminal reaches the
/// parent only, which then decides), with one thread (OMP_NUM_THREADS and its like are 1), with standard
/// output and error in a file, and with file descriptor 3 as the reply channel. It is killed by the kernel if
/// the parent dies. Linux only.

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// One child process to start.
struct Job {
  std::int64_t id = 0;
  std::string executable = {};
  std::vector<std::string> arguments = {};  ///< without the program name
  std::filesystem::path output = {};        ///< file for what the child prints; removed if it stays empty
  double time_limit = 0.0;                  ///< [s] before it is killed; 0 means none
};

/// How a child ended.
struct JobEnd {
  std::int64_t id = 0;
  std::string reply;       ///< all that it wrote to descriptor 3
  int wait_status = 0;     ///< as from waitpid
  bool timed_out = false;  ///< killed because of its time limit
  double time_limit = 0.0;
  double seconds = 0.0;  ///< wall time
};

/// "ended by signal SIGSEGV (Segmentation fault)", "ended with exit code 3", ...
std::string describe(const JobEnd& end);

class ProcessPool {
 public:
  explicit ProcessPool(int jobs);
  ~ProcessPool();  ///< kills what still runs
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  bool full() const { return static_cast<int>(children_.size()) >= jobs_; }
  int running() const { return static_cast<int>(children_.size()); }

  /// Starts a child. Requires !full(). Throws std::runtime_error if the system gives no process or pipe.
  void start(const Job& job);

  /// Children that have ended since the last call, in order of id; waits at most `patience` for the first
  /// one. Returns early, maybe with nothing, when a signal arrives.
  std::vector<JobEnd> wait(std::chrono::milliseconds patience);

  /// Asks all children to end (SIGTERM), kills those that still run after `grace`. Their results are dropped.
  void terminate(std::chrono::milliseconds grace);

 private:
  struct Child {
    std::int64_t id;
    pid_t pid;
    int reply_descriptor;
    std::string reply;
    std::filesystem::path output;
    std::chrono::steady_clock::time_point started;
    double time_limit;
    bool timed_out = false;
    bool reply_closed = false;
  };

  void collect(std::vector<JobEnd>& ends);
  void read_replies(std::chrono::milliseconds patience);
  void enforce_time_limits();

  int jobs_;
  std::vector<Child> children_;
};

}  // namespace drawpoint::studies
