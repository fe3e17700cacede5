// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

/// Seeds 1, 2, ... shared among threads.
namespace drawpoint::benchmarks {

/// Calls act(seed) for 1 to `seeds`, `jobs` at a time. Seeds are claimed one after another; after an error no
/// other is begun, and the first error is thrown on.
inline void each_seed(int seeds, int jobs, const std::function<void(int seed)>& act) {
  std::atomic<int> next{1};
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&] {
    try {
      for (int seed = next++; seed <= seeds; seed = next++) act(seed);
    } catch (...) {
      const std::lock_guard lock(failing);
      if (!failure) failure = std::current_exception();
      next = seeds + 1;
    }
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < jobs; ++k) others.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace drawpoint::benchmarks
