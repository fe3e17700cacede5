// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/interrupt.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstddef>
#include <thread>
#include <utility>

namespace drawpoint::studies {
namespace {

constexpr std::array<int, 3> signals = {SIGINT, SIGTERM, SIGHUP};

// A signal handler reaches nothing but objects of static storage.
volatile std::sig_atomic_t requested_ = 0;
volatile std::sig_atomic_t at_once_ = 0;
std::string message_;
std::array<struct sigaction, signals.size()> before_;

extern "C" void on_signal(int) {
  requested_ = 1;
  if (at_once_ == 0) return;
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message_.data(), message_.size());
  _exit(130);
}

}  // namespace

InterruptGuard::InterruptGuard(std::string message) {
  message_ = std::move(message);
  requested_ = 0;
  at_once_ = 0;
  struct sigaction action = {};
  action.sa_handler = on_signal;  // without SA_RESTART: a waiting poll() returns
  for (std::size_t i = 0; i < signals.size(); ++i) {
    sigaction(signals[i], nullptr, &before_[i]);
    // nohup and a shell's background jobs ignore signals on purpose.
    if (before_[i].sa_handler != SIG_IGN) sigaction(signals[i], &action, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
}

bool ended_by_stop_signal(const doe::ProcessEnd& child) {
  if (!child.told.empty() || child.timed_out || !child.reply.empty()) return false;
  const int status = child.wait_status;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status)
                     : WIFEXITED(status) ? WEXITSTATUS(status) - 128
                                         : 0;
  return std::find(signals.begin(), signals.end(), signal) != signals.end();
}

bool soon(const std::function<bool()>& told) {
  constexpr std::chrono::milliseconds grace(1000), step(10);
  for (auto waited = std::chrono::milliseconds::zero(); waited < grace && !told(); waited += step)
    std::this_thread::sleep_for(step);
  return told();
}

bool InterruptGuard::requested() { return requested_ != 0; }

EndsAtOnce::EndsAtOnce() {
  at_once_ = 1;
  if (requested_ == 0) return;
  at_once_ = 0;
  throw Interrupted{};
}

EndsAtOnce::~EndsAtOnce() { at_once_ = 0; }

}  // namespace drawpoint::studies
