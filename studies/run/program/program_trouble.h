// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What an external program throws in place of an outcome, where it gave none.

#include <stdexcept>
#include <string>

namespace drawpoint::studies {

struct ProgramTrouble : std::runtime_error {
  enum class Kind {
    crashed,     ///< in each attempt
    not_started  ///< no run of the study can be made
  };
  ProgramTrouble(Kind what_kind, const std::string& reason) : std::runtime_error(reason), kind(what_kind) {}
  Kind kind;
};

}  // namespace drawpoint::studies
