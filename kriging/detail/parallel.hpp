// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Independent tasks on several threads. Tasks write to places of their own and are cut in a way that does
/// not depend on the number of threads, so results are equal bit for bit on any number.

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace drawpoint::kriging::detail {

/// A task without its type, so that the threads are compiled once.
struct AnyTask {
  const void* task;
  void (*call)(const void* task, int i);
};

inline void run_tasks(int count, int threads, const AnyTask& task) {
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) task.call(task.task, i);
  };
  std::vector<std::jthread> pool;
  for (int i = 1; i < threads; ++i) pool.emplace_back(work);
  work();
}

/// Calls task(i) for i = 0..count-1, on the calling thread alone when `threads` is 1. A task must not throw.
template <class Task>
void for_each_task(int count, int threads, const Task& task) {
  if (std::min(threads, count) > 1)
    return run_tasks(count, std::min(threads, count),
                     {&task, [](const void* any, int i) { (*static_cast<const Task*>(any))(i); }});
  for (int i = 0; i < count; ++i) task(i);
}

}  // namespace drawpoint::kriging::detail
