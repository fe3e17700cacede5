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

/// A system that shuts down, or somebody who ends all processes of a name, reaches a child and this process in
/// any order: true if the child was ended by SIGINT, SIGTERM or SIGHUP and `told`, whether this process got one
/// too, is true within a second. The child has not failed then.
bool ended_with_this_process(const doe::ProcessEnd& child, const std::function<bool()>& told);

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
