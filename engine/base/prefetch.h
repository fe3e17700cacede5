// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Asks for memory that is needed soon, so that it is there when its turn comes.
///
/// For data that lie far apart in the order of the work: asked for some hundred nanoseconds ahead, and a few
/// lines at a time, since the requests that a core keeps open are few. Changes no result. Call it where it is
/// inlined: GCC takes a function that only prefetches for one without effect and drops its calls.
namespace drawpoint::engine::detail {

[[gnu::always_inline]] inline void prefetch(const void* data, std::size_t bytes) {
  constexpr std::size_t line = 64;
  const char* const first = static_cast<const char*>(data);
  for (std::size_t k = 0; k < bytes; k += line) __builtin_prefetch(first + k);
  __builtin_prefetch(first + bytes - 1);  // the end may lie in a line of its own
}

}  // namespace drawpoint::engine::detail
