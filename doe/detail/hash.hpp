// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The checksum of text in files: FNV-1a, 64 bits (Fowler, Noll, Vo). It tells accidents, not intent: any
/// change of one byte changes it.

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

namespace drawpoint::doe::detail {

inline constexpr std::uint64_t fnv1a_of_nothing = 0xcbf29ce484222325ULL;

/// `hash`: of what stands before the text.
constexpr std::uint64_t fnv1a(std::string_view text, std::uint64_t hash = fnv1a_of_nothing) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

/// As 16 hexadecimal digits.
inline std::string hash_digits(std::uint64_t hash) {
  char digits[17] = "0000000000000000";
  char buffer[17];
  const auto end = std::to_chars(buffer, buffer + 16, hash, 16).ptr;
  std::copy(buffer, end, digits + 16 - (end - buffer));
  return {digits, 16};
}

/// FNV-1a as 16 hexadecimal digits.
inline std::string checksum(std::string_view text) { return hash_digits(fnv1a(text)); }

}  // namespace drawpoint::doe::detail
