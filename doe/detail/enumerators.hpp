// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Enumerators read back from text, for files that hold their names.
///
/// The names are those of to_string(Enum), a switch without default that ends in "unknown": the compiler
/// warns (-Wswitch) of an enumerator that it lacks, and what it has is read here. The enumerators count from
/// 0 without gaps.

#include <optional>
#include <string_view>

namespace drawpoint::doe::detail {

/// The enumerator whose to_string is `name`; empty when there is none.
template <class Enum>
std::optional<Enum> enumerator_of(std::string_view name) {
  for (int k = 0; to_string(static_cast<Enum>(k)) != "unknown"; ++k)
    if (to_string(static_cast<Enum>(k)) == name) return static_cast<Enum>(k);
  return {};
}

}  // namespace drawpoint::doe::detail
