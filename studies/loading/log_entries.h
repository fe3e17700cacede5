// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Single numbers and texts of a run log, which a log of another study may lack.

#include <map>
#include <stdexcept>
#include <string>

namespace drawpoint::studies {

/// Throws std::runtime_error that names what the log lacks.
template <class Value>
const Value& entry_of(const std::map<std::string, Value>& entries, const std::string& name) {
  const auto found = entries.find(name);
  if (found == entries.end())
    throw std::runtime_error("the log has no \"" + name + "\": it is of another study, or was changed");
  return found->second;
}

}  // namespace drawpoint::studies
