// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "interrupt.hpp"

#include <csignal>
#include <stdexcept>

namespace drawpoint::benchmarks {
namespace {

// A signal handler reaches nothing but objects of static storage.
volatile std::sig_atomic_t requested = 0;
extern "C" void on_interrupt(int) { requested = 1; }

}  // namespace

void watch_for_interrupt() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

bool interrupted() { return requested != 0; }

void end_if_interrupted() {
  if (interrupted()) throw std::runtime_error("interrupted");
}

}  // namespace drawpoint::benchmarks
