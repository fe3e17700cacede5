// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points that the user of a folder has named, as the store keeps them.

#include <drawpoint/studies/mark.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// A JSON array of [name, [values]].
std::string to_text(const std::vector<Mark>& marks);
/// Throws nlohmann::json::exception for what is none.
std::vector<Mark> marks_from(const std::string& text);

/// "today=1.2,0.8", as --mark takes it, to the last digit.
std::string mark_text(const Mark& mark);

/// Returns the mark of this name, or the end of the list.
std::vector<Mark>::iterator mark_named(std::vector<Mark>& marks, const std::string& name);

/// Adds those of `more`; one of the same name takes the place of the one that is there.
std::vector<Mark> with_marks(std::vector<Mark> marks, const std::vector<Mark>& more);

}  // namespace drawpoint::studies
