// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tables for the terminal.

#include <string>
#include <vector>

namespace drawpoint::studies {

/// Rows of cells, the first row the heads: one line per row, columns left-aligned and two blanks apart. A row
/// may have fewer cells than the first. Widths count characters of UTF-8, not bytes.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace drawpoint::studies
