// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Rows in rising order of a number each, equal ones as they stood.
///
/// A double without NaN is turned into 64 bits in the same order. Many of those are sorted byte by byte from
/// the last (radix sort): for 20 000 rows a sixth of the time of comparisons. A byte that all numbers share
/// costs nothing, so numbers with many ties take a pass or two. Of a few hundred rows the two leading bytes
/// of what they differ in settle nearly every pair, and insertion the others. Few rows are compared.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace drawpoint::pareto::detail {

struct KeyedRow {
  std::uint64_t key;
  int row;
};

/// a < b exactly where rising_bits(a) < rising_bits(b); 0 and -0 are equal.
inline std::uint64_t rising_bits(double value) {
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  const auto bits = std::bit_cast<std::uint64_t>(value + 0.0);
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

/// By the bytes of the keys from `first` on, 0 the last one.
template <std::size_t first>
void radix_sort(std::vector<KeyedRow>& rows) {
  constexpr std::size_t bytes = 8 - first, values = 256;
  const auto byte_of = [](std::uint64_t key, std::size_t b) { return (key >> (8 * (first + b))) & 0xff; };
  std::array<std::array<std::uint32_t, values>, bytes> counts{};
  for (const KeyedRow& r : rows)
    for (std::size_t b = 0; b < bytes; ++b) ++counts[b][byte_of(r.key, b)];
  std::vector<KeyedRow> next(rows.size());
  for (std::size_t b = 0; b < bytes; ++b) {
    auto& place = counts[b];
    if (place[byte_of(rows.front().key, b)] == rows.size()) continue;
    std::uint32_t before = 0;
    for (std::uint32_t& count : place) {
      const std::uint32_t own = count;
      count = before;
      before += own;
    }
    for (const KeyedRow& r : rows) next[place[byte_of(r.key, b)]++] = r;
    rows.swap(next);
  }
}

/// Keys become their distances to the lowest one, shifted so that the highest fills 64 bits.
inline void spread_keys(std::vector<KeyedRow>& rows) {
  std::uint64_t lowest = rows.front().key, highest = lowest;
  for (const KeyedRow& r : rows) {
    lowest = std::min(lowest, r.key);
    highest = std::max(highest, r.key);
  }
  const int zeros = highest > lowest ? std::countl_zero(highest - lowest) : 0;
  for (KeyedRow& r : rows) r.key = (r.key - lowest) << zeros;
}

/// Near O(n) where few rows are out of order.
inline void insertion_sort(std::vector<KeyedRow>& rows) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const KeyedRow row = rows[i];
    std::size_t k = i;
    for (; k > 0 && rows[k - 1].key > row.key; --k) rows[k] = rows[k - 1];
    rows[k] = row;
  }
}

/// Equal keys keep their order. Keys may be replaced by others in the same order.
inline void sort_by_key(std::vector<KeyedRow>& rows) {
  constexpr std::size_t radix_rows = 64, all_bytes_rows = 512;  // from here on it is the quicker one
  if (rows.size() >= all_bytes_rows) {
    radix_sort<0>(rows);
  } else if (rows.size() >= radix_rows) {
    spread_keys(rows);
    radix_sort<6>(rows);
    insertion_sort(rows);
  } else {
    std::stable_sort(rows.begin(), rows.end(),
                     [](const KeyedRow& a, const KeyedRow& b) { return a.key < b.key; });
  }
}

}  // namespace drawpoint::pareto::detail
