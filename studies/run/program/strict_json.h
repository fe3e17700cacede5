// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// JSON of other programs, in which no key of an object stands twice: readers differ in which of two values
/// they take.

#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {

/// Throws std::runtime_error that says where the text is no JSON, or names a key that stands twice in one object; a
/// sentence's end, as in "its reply is no JSON: ...".
nlohmann::json strict_json(const std::string& text);

}  // namespace drawpoint::studies
