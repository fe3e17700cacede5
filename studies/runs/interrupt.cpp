// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/runs/interrupt.h>

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
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

bool InterruptGuard::requested() { return requested_ != 0; }

EndsAtOnce::EndsAtOnce() {
  at_once_ = 1;
  if (requested_ == 0) return;
  at_once_ = 0;
  throw Interrupted{};
}

EndsAtOnce::~EndsAtOnce() { at_once_ = 0; }

}  // namespace drawpoint::studies
