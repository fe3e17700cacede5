// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a study says before all else: figures that tell whether its runs are worth a model at all.

#include <string>

namespace drawpoint::studies {

struct Headline {
  std::string name;  ///< as a response's: fill_factor
  std::string unit;  ///< "1" for a number
  double value = 0;  ///< not a number: unknown, and the note says why
  std::string note;  ///< what it means, in a few words
};

}  // namespace drawpoint::studies
