// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// What somebody may have meant who typed a word that is not known.
namespace drawpoint::studies {

/// " (did you mean X?)" for the known word that the fewest letters put in, left out, changed or swapped make of the
/// typed one, at most one of three letters; empty where no word is so near.
std::string did_you_mean(const std::string& typed, const std::vector<std::string>& known);

}  // namespace drawpoint::studies
