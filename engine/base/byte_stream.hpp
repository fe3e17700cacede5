// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <drawpoint/engine/base/checks.hpp>
#include <drawpoint/engine/base/eigen.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// A simulation state as bytes, written and read back in one fixed order.
///
/// Numbers are stored as they are in memory (little-endian, IEEE 754), so what is read back is the same to
/// the last bit. The reader trusts nothing: it checks the length before every read, refuses numbers that are
/// not finite and truth values other than 0 and 1, and a count must fit into the bytes that are left, so that
/// no damaged input makes it allocate more than its own size or read outside it. All its errors are
/// std::runtime_error and name the thing and the byte.
namespace drawpoint::engine {

static_assert(std::endian::native == std::endian::little, "states are stored little-endian");

/// Values with one representation per bit pattern: bool, fixed-width integers, enumerations of them, double.
template <class T>
concept StreamScalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

class ByteWriter {
 public:
  template <StreamScalar T>
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

  const std::vector<std::byte>& bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class ByteReader {
 public:
  /// In errors, `place` says what is read, `advice` what to do.
  explicit ByteReader(std::span<const std::byte> bytes, std::string place = "engine: the saved state",
                      std::string advice = "it is damaged or of another version: save it anew")
      : bytes_(bytes), place_(std::move(place)), advice_(std::move(advice)) {}

  /// `what` names the value in errors, as "the margin of a pair".
  template <StreamScalar T>
  T get(const char* what = "a value") {
    T x = read<T>();
    if constexpr (std::is_floating_point_v<T>)
      if (!std::isfinite(x)) fail("holds " + std::string(what) + " that is not finite");
    return x;
  }
  template <StreamScalar T>
  void get(T& x) {
    x = get<T>();
  }
  template <int Rows, int Columns>
  void get(Eigen::Matrix<double, Rows, Columns>& m, const char* what = "a value") {
    for (Eigen::Index k = 0; k < m.size(); ++k) m.data()[k] = get<double>(what);
  }
  /// The rotation must be one, within what steps of a long run leave of it.
  void get(Eigen::Isometry3d& X) {
    X = Eigen::Isometry3d::Identity();
    X.linear() = get_rotation("a pose whose rotation");
    Eigen::Vector3d p;
    get(p);
    X.translation() = p;
  }
  Eigen::Vector3d get_vector(const char* what) {
    Eigen::Vector3d v;
    get(v, what);
    return v;
  }
  Eigen::Matrix3d get_rotation(const char* what) {
    Eigen::Matrix3d R;
    get(R, what);
    if (!detail::is_rotation(R)) fail("holds " + std::string(what) + " is no rotation matrix");
    return R;
  }
  /// An int from `lower` to `upper`.
  int get_int(const char* what, int lower, int upper) {
    const int value = read<int>();
    if (value < lower || value > upper)
      fail("holds " + std::to_string(value) + " for " + what + ", expected " + std::to_string(lower) +
           " to " + std::to_string(upper));
    return value;
  }
  /// A double that need not be finite.
  double get_any_double() { return read<double>(); }
  /// A number of items that take at least `bytes_each` > 0 bytes.
  std::size_t get_count(std::size_t bytes_each) {
    const auto count = read<std::uint64_t>();
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
    throw std::runtime_error(place_ + " " + what + " at byte " + std::to_string(at_) + " of " +
                             std::to_string(bytes_.size()) + "; " + advice_);
  }

 private:
  template <StreamScalar T>
  T read() {
    if (sizeof(T) > left()) fail("ends early");
    T x;
    if constexpr (std::is_same_v<T, bool>) {
      const auto stored = static_cast<unsigned>(bytes_[at_]);
      if (stored > 1) fail("holds " + std::to_string(stored) + " where 0 or 1 must stand");
      x = stored == 1;
    } else {
      std::memcpy(&x, bytes_.data() + at_, sizeof(T));
    }
    at_ += sizeof(T);
    return x;
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  std::string place_, advice_;
};

}  // namespace drawpoint::engine
