// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How many threads `threads` of an options struct means.

#include <algorithm>
#include <thread>

namespace drawpoint::doe::detail {

/// 0 means one per core that this process may use.
inline int thread_count(int threads) {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace drawpoint::doe::detail
