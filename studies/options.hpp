// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Options that a study declares for itself: what holds for all its runs and is no variable, such as the
/// materials or the number of cycles. They are on the command line of run and evaluate, and they are part of
/// the stored study: a folder never mixes runs of different options.

#include <map>
#include <string>
#include <vector>

namespace drawpoint::studies {

struct StudyOption {
  std::string name = {};   ///< --NAME on the command line; lower case letters, digits, '-' and '_'
  std::string help = {};   ///< what it chooses, for --help and the report
  std::string value = {};  ///< default
  std::vector<std::string> choices = {};  ///< values there are; empty: whole numbers from `least` to `most`
  int least = 0, most = 0;
};

/// A value per option.
using OptionValues = std::map<std::string, std::string>;

/// The values there are, in words: "ore, waste" or "whole numbers from 1 to 9".
std::string allowed_values(const StudyOption& option);

/// What is wrong with a value, in words, or "".
std::string complaint(const StudyOption& option, const std::string& value);

/// A value per option: the one given, or the default. What is given for no option is left out.
OptionValues with_defaults(const std::vector<StudyOption>& options, const OptionValues& given);

/// The first difference in words ("option materials: calibrated there, lindmark2016 here"), or "". An option
/// that is missing on one side differs; `here` may leave out what it takes from there when `partly`.
std::string difference(const OptionValues& there, const OptionValues& here, bool partly);

/// Throws std::invalid_argument for a name that cannot be one, or that a command has already, and for a
/// default that is not allowed.
void check(const std::vector<StudyOption>& options);

}  // namespace drawpoint::studies
