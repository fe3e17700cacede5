// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Many points in four or more objectives: comparisons of small whole numbers, eight points at a time.
///
/// Dominance asks only for order, so each objective may be replaced by its rank among the points (equal
/// values share one): 16 bits for up to 32 767 points, and one instruction compares eight of them. A
/// front is an array of blocks of eight points, within a block objective by objective; what is free in the
/// last block holds a number that never dominates. Cost m n log n for the ranks, m k/8 block steps to scan k
/// points.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include <drawpoint/pareto/detail/rising_order.hpp>

namespace drawpoint::pareto::detail {

/// Y: n x m without NaN. Ranks from 0, below the largest T.
template <class T>
Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> ranks_of(const Eigen::MatrixXd& Y) {
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> ranks(Y.rows(), Y.cols());
  std::vector<KeyedRow> rows(static_cast<std::size_t>(Y.rows()));
  for (Eigen::Index j = 0; j < Y.cols(); ++j) {
    for (int i = 0; i < static_cast<int>(rows.size()); ++i)
      rows[static_cast<std::size_t>(i)] = {rising_bits(Y(i, j)), i};
    sort_by_key(rows);
    T rank = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (k > 0 && rows[k].key != rows[k - 1].key) ++rank;
      ranks(rows[k].row, j) = rank;
    }
  }
  return ranks;
}

/// Eight or four ranks in one register: GCC's and Clang's own vectors, which any machine has.
template <class T>
struct RankVector;

template <>
struct RankVector<std::int16_t> {
  typedef std::int16_t Vector __attribute__((vector_size(16)));
};

template <>
struct RankVector<std::int32_t> {
  typedef std::int32_t Vector __attribute__((vector_size(16)));
};

/// All points of a front, the latest block looked at first, for it is the likeliest to dominate. The first
/// objective is not compared: whoever asks comes later in its order. T: the type of the ranks.
template <class T>
class BlockFront {
 public:
  explicit BlockFront(Eigen::Index m) : compared_(static_cast<std::size_t>(m) - 1) {}

  bool dominates(const T* p) const {
    const std::size_t length = compared_ * width;
    for (std::size_t first = values_.size(); first > 0; first -= length)
      if (block_dominates(&values_[first - length], p + 1)) return true;
    return false;
  }

  void add(const T* p) {
    const std::size_t lane = size_++ % width;
    if (lane == 0) values_.resize(values_.size() + compared_ * width, std::numeric_limits<T>::max());
    T* block = &values_[values_.size() - compared_ * width];
    for (std::size_t j = 0; j < compared_; ++j) block[j * width + lane] = p[j + 1];
  }

 private:
  static constexpr std::size_t width = 16 / sizeof(T);
  using Vector = typename RankVector<T>::Vector;

  bool block_dominates(const T* block, const T* p) const {
    Vector covers = ~Vector{}, q;
    for (std::size_t j = 0; j < compared_; ++j) {
      std::memcpy(&q, block + j * width, sizeof q);
      covers &= ~(q > p[j]);
    }
    std::array<std::uint64_t, 2> words;
    std::memcpy(words.data(), &covers, sizeof words);
    return (words[0] | words[1]) != 0;
  }

  std::size_t compared_, size_ = 0;
  std::vector<T> values_;
};

}  // namespace drawpoint::pareto::detail
