// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// One lock for all uses of Ipopt in a process: its linear solver MUMPS keeps global state. It stands in doe
/// because kriging and pareto, which both use Ipopt, do not know each other.

#include <mutex>

namespace drawpoint::doe::detail {

inline std::mutex& ipopt_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace drawpoint::doe::detail
