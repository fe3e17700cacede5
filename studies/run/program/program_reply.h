// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a simulator in another language replies (external_program.hpp). It may be anything.

#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/problem.hpp>

#include <string>
#include <variant>

namespace drawpoint::studies {

/// How an attempt crashed: worth another one.
struct Crash {
  std::string reason;
};
using Attempt = std::variant<doe::Outcome, Crash>;

/// Takes {"values": {response: number}} or {"failure": text}; anything else is a crash whose reason says what it is.
Attempt reply_of(const std::string& text, const doe::Problem& problem);

}  // namespace drawpoint::studies
