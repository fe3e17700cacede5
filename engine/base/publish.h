// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

extern "C" {
// ThreadSanitizer's run time; null without it.
void __tsan_acquire(void* address) __attribute__((weak));
void __tsan_release(void* address) __attribute__((weak));
}

/// Work handed to oneTBB and back, told to ThreadSanitizer.
///
/// oneTBB's library is not instrumented, so the sanitizer does not see that a task starts after it was given
/// and that the caller goes on after it ended. begin() on the caller, task() around each task and end() on
/// the caller say so, and no more than that: two tasks of one loop stay unordered, and what they do to each
/// other is still reported. Elsewhere all of it does nothing.
namespace drawpoint::engine::detail {

class HandOver {
 public:
  void begin() { release(start_); }
  void end() { acquire(end_); }

  template <class Work>
  void task(const Work& work) {
    acquire(start_);
    work();
    release(end_);
  }

 private:
  static void acquire(char& place) {
    if (__tsan_acquire) __tsan_acquire(&place);
  }
  static void release(char& place) {
    if (__tsan_release) __tsan_release(&place);
  }

  char start_ = 0, end_ = 0;
};

}  // namespace drawpoint::engine::detail
