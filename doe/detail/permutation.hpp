// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Random order, every order equally likely (Fisher and Yates, from the last place down): n − 1 draws of the
/// stream for n items, the same for every kind of item.

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe::detail {

template <class T>
void shuffle(std::vector<T>& items, RandomStream& random) {
  for (int i = static_cast<int>(items.size()) - 1; i > 0; --i)
    std::swap(items[static_cast<std::size_t>(i)], items[static_cast<std::size_t>(random.below(i + 1))]);
}

/// 0 .. n − 1 in random order.
template <class Int = int>
std::vector<Int> permutation(Int n, RandomStream& random) {
  std::vector<Int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), Int{0});
  shuffle(order, random);
  return order;
}

}  // namespace drawpoint::doe::detail
