// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

/// Sorts pairs of numbers by the first, then by the second, and removes repeats: by counting, in linear time,
/// where there are many. Buffers are kept for the next time.
namespace drawpoint::engine::detail {

class PairSorter {
 public:
  using Pair = std::pair<int, int>;

  /// Numbers are 0 .. end-1.
  void sort(std::vector<Pair>& pairs, std::size_t end) {
    if (pairs.size() < few) {
      std::sort(pairs.begin(), pairs.end());
    } else {
      spare_.resize(pairs.size());
      distribute(pairs, spare_, end, [](const Pair& p) { return p.second; });
      distribute(spare_, pairs, end, [](const Pair& p) { return p.first; });
    }
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }

 private:
  static constexpr std::size_t few = 512;  // are sorted by comparing

  template <class Key>
  void distribute(const std::vector<Pair>& from, std::vector<Pair>& to, std::size_t end, const Key& key) {
    place_.assign(end + 1, 0);
    for (const auto& pair : from) ++place_[static_cast<std::size_t>(key(pair)) + 1];
    for (std::size_t k = 1; k <= end; ++k) place_[k] += place_[k - 1];
    for (const auto& pair : from) to[place_[static_cast<std::size_t>(key(pair))]++] = pair;
  }

  std::vector<Pair> spare_;
  std::vector<std::size_t> place_;
};

}  // namespace drawpoint::engine::detail
