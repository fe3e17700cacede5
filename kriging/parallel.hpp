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

/// 0 means one a processor that this process may use.
inline int thread_count(int wanted) {
  return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Calls task(i) for i = 0..count-1, on the calling thread alone when `threads` is 1. A task must not throw.
template <class Task>
void for_each_task(int count, int threads, const Task& task) {
  const int helpers = std::min(threads, count) - 1;
  if (helpers <= 0) {
    for (int i = 0; i < count; ++i) task(i);
    return;
  }
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) task(i);
  };
  std::vector<std::jthread> pool;
  for (int i = 0; i < helpers; ++i) pool.emplace_back(work);
  work();
}

}  // namespace drawpoint::kriging::detail
