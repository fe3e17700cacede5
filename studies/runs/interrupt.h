// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ctrl-C and its like (SIGINT, SIGTERM, SIGHUP) while a study runs.
///
/// While simulations run, the signal only sets a flag: the loop that waits for children sees it, ends them
/// and leaves in good order. While models are fitted nothing would look at a flag, and nothing can be lost:
/// there the signal prints the message on how to go on and ends the process. Both end with exit code 130.

#include <string>

namespace drawpoint::studies {

/// Thrown to leave a command after an interruption.
struct Interrupted {};

class InterruptGuard {
 public:
  /// `message` is printed to standard error when the process ends at once. One guard at a time.
  explicit InterruptGuard(std::string message);
  ~InterruptGuard();  ///< restores what was there before
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// From here on a signal ends the process with the message and exit code 130.
  void end_at_once();

  static bool requested();
};

}  // namespace drawpoint::studies
