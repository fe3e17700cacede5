// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Texts of other programs, such as the reason of a failed run, made harmless for terminals, tables and pages.

#include <cstddef>
#include <string>
#include <string_view>

namespace drawpoint::studies {

/// The most bytes that are kept of a reason.
inline constexpr std::size_t most_of_reason = 2000;

/// UTF-8 in which nothing commands a terminal: control characters but line feed and tab are shown by their
/// pictures (␛ for escape), and the replacement character stands for C1 controls, for marks that turn the
/// direction of writing, and for what is no UTF-8. Cut behind `most` bytes, with a word on how long it was.
std::string plain_text(std::string_view text, std::size_t most = most_of_reason);

}  // namespace drawpoint::studies
