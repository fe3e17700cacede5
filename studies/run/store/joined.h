// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Lists as they stand in messages: "alpha, beta".

#include <functional>
#include <string>

namespace drawpoint::studies {

/// What `text_of` gives for each item, a member or a function, with `between` between two of them.
template <class Items, class Text = std::identity>
std::string joined(const Items& items, const Text& text_of = {}, const char* between = ", ") {
  std::string text;
  bool first = true;
  for (const auto& item : items) {
    if (!first) text += between;
    text += std::invoke(text_of, item);
    first = false;
  }
  return text;
}

}  // namespace drawpoint::studies
