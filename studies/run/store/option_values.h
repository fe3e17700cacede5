// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the options of a study may be, are, and how two sets of them differ.

#include <drawpoint/studies/options.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// The values there are, in words: "ore, waste" or "whole numbers from 1 to 9".
std::string allowed_values(const StudyOption& option);

/// What is wrong with a value, in words, or "".
std::string complaint(const StudyOption& option, const std::string& value);

/// A value per option: the one given, or the default. What is given for no option is left out.
OptionValues with_defaults(const std::vector<StudyOption>& options, const OptionValues& given);

/// With the values of options that came to the study after these were stored: StudyOption::before, for options
/// of responses the default.
OptionValues with_later_ones(const std::vector<StudyOption>& options, OptionValues stored);

/// The first difference in words ("option materials: calibrated there, lindmark2016 here"), or "". An option
/// that is missing on one side differs; `here` may leave out what it takes from there when `partly`.
std::string difference(const OptionValues& there, const OptionValues& here, bool partly);

/// Throws std::invalid_argument with the names.
const Preset& preset_named(const std::vector<Preset>& presets, const std::string& name);
/// What is wrong with a preset's name, in words, or "".
std::string preset_complaint(const std::vector<Preset>& presets, const std::string& name);
/// Throws std::invalid_argument for a preset of options or values that the study does not have.
void check(const std::vector<Preset>& presets, const std::vector<StudyOption>& options);

/// "--materials lindmark2016 --cycles 30"
std::string options_text(const OptionValues& values);
/// The shortest that is typed for these values, such as "--preset lindmark2016 --cycles 4"; empty where all are the
/// defaults.
std::string typed_options(const std::vector<StudyOption>& options, const std::vector<Preset>& presets,
                          const OptionValues& values);

/// Throws std::invalid_argument for a name that cannot be one, or that a command has already, and for a
/// default that is not allowed.
void check(const std::vector<StudyOption>& options);

}  // namespace drawpoint::studies
