// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/process_pool.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace drawpoint::studies {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int reply_channel = 3;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (auto& word : words) result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> single_threaded_environment() {
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

/// Between fork and exec: only calls that are safe after fork. 127 is the shell's code for "could not start".
[[noreturn]] void become(char** arguments, char** environment, const char* output, int reply, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // the parent died before the line above took effect
  setpgid(0, 0);
  const int nothing = open("/dev/null", O_RDONLY);
  const int file = open(output, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (nothing < 0 || file < 0) _exit(127);
  if (dup2(nothing, STDIN_FILENO) < 0 || dup2(file, STDOUT_FILENO) < 0 || dup2(file, STDERR_FILENO) < 0)
    _exit(127);
  if (reply == reply_channel) {
    fcntl(reply, F_SETFD, 0);
  } else if (dup2(reply, reply_channel) < 0) {
    _exit(127);
  }
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  std::signal(SIGPIPE, SIG_DFL);
  execve(arguments[0], arguments, environment);
  _exit(127);
}

void remove_if_empty(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::file_size(file, ignored) == 0 && !ignored) std::filesystem::remove(file, ignored);
}

}  // namespace

std::string describe(const JobEnd& end) {
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
  if (WEXITSTATUS(end.wait_status) == 127) return "could not be started";
  return "ended with exit code " + std::to_string(WEXITSTATUS(end.wait_status));
}

ProcessPool::ProcessPool(int jobs) : jobs_(jobs) { assert(jobs >= 1); }

ProcessPool::~ProcessPool() { terminate(milliseconds(0)); }

void ProcessPool::start(const Job& job) {
  assert(!full());
  std::vector<std::string> words = {job.executable};
  words.insert(words.end(), job.arguments.begin(), job.arguments.end());
  std::vector<std::string> settings = single_threaded_environment();
  auto arguments = pointers(words);
  auto environment = pointers(settings);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("studies: no pipe for a run: ") + std::strerror(errno) +
                             "; try fewer --jobs");
  }
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) become(arguments.data(), environment.data(), job.output.c_str(), ends[1], parent);
  const int fork_error = errno;
  close(ends[1]);
  if (pid < 0) {
    close(ends[0]);
    throw std::runtime_error(std::string("studies: cannot start a process: ") + std::strerror(fork_error) +
                             "; try fewer --jobs");
  }
  setpgid(pid, pid);  // also here: whichever of the two comes first
  fcntl(ends[0], F_SETFL, O_NONBLOCK);
  children_.push_back({job.id, pid, ends[0], {}, job.output, Clock::now(), job.time_limit});
}

std::vector<JobEnd> ProcessPool::wait(milliseconds patience) {
  std::vector<JobEnd> ends;
  collect(ends);
  if (ends.empty() && !children_.empty()) {
    read_replies(patience);
    enforce_time_limits();
    collect(ends);
  }
  std::sort(ends.begin(), ends.end(), [](const JobEnd& a, const JobEnd& b) { return a.id < b.id; });
  return ends;
}

void ProcessPool::read_replies(milliseconds patience) {
  std::vector<pollfd> open_replies;
  std::vector<Child*> owners;
  bool one_is_ending = false;
  for (auto& child : children_) {
    one_is_ending = one_is_ending || child.reply_closed;
    if (child.reply_closed) continue;
    open_replies.push_back({child.reply_descriptor, POLLIN, 0});
    owners.push_back(&child);
  }
  // A closed reply means that the child is about to end: look again soon.
  const auto wait = one_is_ending ? std::min(patience, milliseconds(2)) : patience;
  if (poll(open_replies.data(), open_replies.size(), static_cast<int>(wait.count())) <= 0) return;
  for (std::size_t i = 0; i < owners.size(); ++i) {
    if (open_replies[i].revents == 0) continue;
    char buffer[4096];
    ssize_t count = 0;
    while ((count = read(owners[i]->reply_descriptor, buffer, sizeof buffer)) > 0) {
      owners[i]->reply.append(buffer, static_cast<std::size_t>(count));
    }
    owners[i]->reply_closed = count == 0;
  }
}

void ProcessPool::enforce_time_limits() {
  for (auto& child : children_) {
    if (child.time_limit <= 0.0 || child.timed_out || seconds_since(child.started) < child.time_limit)
      continue;
    child.timed_out = true;
    kill(-child.pid, SIGKILL);
  }
}

void ProcessPool::collect(std::vector<JobEnd>& ends) {
  const auto ended = [&](Child& child) {
    int status = 0;
    if (waitpid(child.pid, &status, WNOHANG) != child.pid) return false;
    char buffer[4096];
    ssize_t count = 0;
    while ((count = read(child.reply_descriptor, buffer, sizeof buffer)) > 0) {
      child.reply.append(buffer, static_cast<std::size_t>(count));
    }
    close(child.reply_descriptor);
    kill(-child.pid, SIGKILL);  // whatever the child itself has left behind
    remove_if_empty(child.output);
    ends.push_back({child.id, std::move(child.reply), status, child.timed_out, child.time_limit,
                    seconds_since(child.started)});
    return true;
  };
  children_.erase(std::remove_if(children_.begin(), children_.end(), ended), children_.end());
}

void ProcessPool::terminate(milliseconds grace) {
  for (const auto& child : children_) kill(-child.pid, SIGTERM);
  const auto deadline = Clock::now() + grace;
  std::vector<JobEnd> dropped;
  while (!children_.empty() && Clock::now() < deadline) {
    collect(dropped);
    if (!children_.empty()) poll(nullptr, 0, 5);
  }
  for (const auto& child : children_) kill(-child.pid, SIGKILL);
  while (!children_.empty()) {
    collect(dropped);
    if (!children_.empty()) poll(nullptr, 0, 1);
  }
}

}  // namespace drawpoint::studies
