// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <drawpoint/engine/base/eigen.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

/// A simulation state as bytes, written and read back in one fixed order, and hashes of exact bits.
///
/// Numbers are stored as they are in memory (little-endian, IEEE 754), so what is read back is the same to
/// the last bit. The reader trusts nothing: it checks the length before every read, refuses numbers that are
/// not finite and truth values other than 0 and 1, and a count must fit into the bytes that are left, so that
/// no damaged input makes it allocate more than its own size or read outside it. All its errors are
/// std::runtime_error and name the byte.
namespace drawpoint::engine {

static_assert(std::endian::native == std::endian::little, "states are stored little-endian");

/// Values with one representation per bit pattern: bool, fixed-width integers, enumerations of them, double.
template <class T>
concept StateScalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// 64-bit hash of words, one multiplication (FNV-1a's prime) and one shift per word: every bit of the input
/// reaches the result. For telling runs apart, not for security.
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

class StateWriter {
 public:
  template <StateScalar T>
  void put(T x) {
    bytes_.resize(bytes_.size() + sizeof(T));
    std::memcpy(bytes_.data() + bytes_.size() - sizeof(T), &x, sizeof(T));
  }
  template <int Rows, int Columns>
  void put(const Eigen::Matrix<double, Rows, Columns>& m) {
    static_assert(Rows > 0 && Columns > 0, "fixed sizes only");
    for (Eigen::Index k = 0; k < m.size(); ++k) put(m.data()[k]);
  }
  void put(const Eigen::Isometry3d& X) {
    put(Eigen::Matrix3d(X.linear()));
    put(Eigen::Vector3d(X.translation()));
  }
  void put(std::span<const std::byte> bytes) {
    put_count(bytes.size());
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void put_count(std::size_t count) { put(static_cast<std::uint64_t>(count)); }

  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class StateReader {
 public:
  explicit StateReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <StateScalar T>
  void get(T& x) {
    if (sizeof(T) > left()) fail("ends early");
    if constexpr (std::is_same_v<T, bool>) {
      const auto stored = static_cast<unsigned>(bytes_[at_]);
      if (stored > 1) fail("holds " + std::to_string(stored) + " where 0 or 1 must stand");
      x = stored == 1;
    } else {
      std::memcpy(&x, bytes_.data() + at_, sizeof(T));
    }
    if constexpr (std::is_floating_point_v<T>)
      if (!std::isfinite(x)) fail("holds a number that is not finite");
    at_ += sizeof(T);
  }
  template <int Rows, int Columns>
  void get(Eigen::Matrix<double, Rows, Columns>& m) {
    for (Eigen::Index k = 0; k < m.size(); ++k) get(m.data()[k]);
  }
  /// A rotation must be one, within what steps of a long run leave of it.
  void get(Eigen::Isometry3d& X) {
    Eigen::Matrix3d R;
    Eigen::Vector3d p;
    get(R);
    get(p);
    if (!((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < 1e-6 && R.determinant() > 0))
      fail("holds a pose whose rotation is none");
    X = Eigen::Isometry3d::Identity();
    X.linear() = R;
    X.translation() = p;
  }
  template <StateScalar T>
  T get() {
    T x;
    get(x);
    return x;
  }
  /// A number of items that take at least `bytes_each` > 0 bytes.
  std::size_t get_count(std::size_t bytes_each) {
    const auto count = get<std::uint64_t>();
    if (count > left() / bytes_each) fail("announces more than it holds");
    return static_cast<std::size_t>(count);
  }

  /// The next `count` bytes, to be read by themselves.
  std::span<const std::byte> get_bytes(std::size_t count) {
    if (count > left()) fail("ends early");
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }
  void expect_end() const {
    if (left() > 0) fail("goes on");
  }

  std::size_t left() const { return bytes_.size() - at_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("engine: the saved state " + what + " at byte " + std::to_string(at_) + " of " +
                             std::to_string(bytes_.size()) +
                             "; it is damaged or of another version: save it anew");
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

}  // namespace drawpoint::engine
