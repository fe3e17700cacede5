// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// JSON of other programs, in which no key of an object stands twice: readers differ in which of two values
/// they take.

#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {

/// Throws nlohmann::json::exception for what is no JSON, std::runtime_error that names a key that stands twice
/// in one object.
nlohmann::json strict_json(const std::string& text);

}  // namespace drawpoint::studies
