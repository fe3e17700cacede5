// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/first_failures.h>

#include <cctype>

namespace drawpoint::studies {
namespace {

/// The text without its numbers, which differ from run to run.
std::string shape_of(const std::string& text) {
  std::string shape;
  for (const char c : text) {
    const bool part_of_number =
        std::isdigit(static_cast<unsigned char>(c)) != 0 || (c == '.' && shape.ends_with('#'));
    if (!part_of_number)
      shape += c;
    else if (!shape.ends_with('#'))
      shape += '#';
  }
  return shape;
}

}  // namespace

void FirstFailures::failed(const std::string& reason) {
  if (off_) return;
  const std::string shape = shape_of(reason);
  if (count_ > 0 && shape != shape_) off_ = true;
  if (count_++ > 0) return;
  reason_ = reason;
  shape_ = shape;
}

}  // namespace drawpoint::studies
