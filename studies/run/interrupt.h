// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ctrl-C and its like (SIGINT, SIGTERM, SIGHUP) while a study runs.
///
/// While simulations run, the signal only sets a flag: the loop that waits for children sees it, ends them
/// and leaves in good order. While models are fitted nothing would look at a flag, and nothing can be lost:
/// there (EndsAtOnce) the signal prints the message on how to go on and ends the process. Both end with exit
/// code 130.

#include <drawpoint/doe/processes.hpp>

#include <chrono>
#include <functional>
#include <string>

namespace drawpoint::studies {

/// That processes have to end by themselves after a signal.
inline constexpr std::chrono::milliseconds time_to_end(2000);

/// Whether SIGINT, SIGTERM or SIGHUP ended a child that had not replied: as a signal, or as the exit code by
/// which programs that take it say so (128 + its number). A system that shuts down, or somebody who ends all
/// processes of a name, reaches the child and this process in any order; such a child has not failed.
bool ended_by_stop_signal(const doe::ProcessEnd& child);

/// Whether `told`, that this process got one too, is true within a second.
bool soon(const std::function<bool()>& told);

/// Thrown to leave a command after an interruption.
struct Interrupted {};

class InterruptGuard {
 public:
  /// `message` is printed to standard error when the process ends at once. One guard at a time.
  explicit InterruptGuard(std::string message);
  ~InterruptGuard();  ///< restores what was there before
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool requested();
};

/// While it lives, a signal ends the process with the guard's message and exit code 130: for work that looks
/// at no flag and loses nothing. Throws Interrupted if a signal came before.
class EndsAtOnce {
 public:
  EndsAtOnce();
  ~EndsAtOnce();
  EndsAtOnce(const EndsAtOnce&) = delete;
  EndsAtOnce& operator=(const EndsAtOnce&) = delete;
};

}  // namespace drawpoint::studies
