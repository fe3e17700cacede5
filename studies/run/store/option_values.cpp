// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/joined.h>
#include <drawpoint/studies/run/store/option_values.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <stdexcept>

namespace drawpoint::studies {
namespace {

constexpr std::array taken = {"runs",    "validation",   "replicates",   "jobs",       "seed",
                              "out",     "json",         "time-limit",   "x",          "log",
                              "shared",  "retry-failed", "help",         "version",    "result-descriptor",
                              "import",  "adaptive",     "batch",        "criteria",   "target",
                              "hours",   "slurm",        "slurm-option", "run",        "points",
                              "rounds",  "from",         "what",         "format",     "file",
                              "with",    "limit",        "all",          "keep-going", "no-spot-check",
                              "why",     "replace",      "slurm-array",  "until",      "budget",
                              "against", "output",       "no-logs",      "preset",     "mark",
                              "count",   "confirm"};

bool whole_number_within(const std::string& text, int least, int most) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value >= least && value <= most;
}

bool is_allowed(const StudyOption& option, const std::string& value) {
  if (option.choices.empty()) return whole_number_within(value, option.least, option.most);
  return std::find(option.choices.begin(), option.choices.end(), value) != option.choices.end();
}

bool can_be_a_name(const std::string& name) {
  const auto plain = [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '-' || c == '_';
  };
  return !name.empty() && std::islower(static_cast<unsigned char>(name[0])) != 0 &&
         std::all_of(name.begin(), name.end(), plain) &&
         std::find(taken.begin(), taken.end(), name) == taken.end();
}

std::string value_in(const OptionValues& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? "none" : found->second;
}

}  // namespace

std::string allowed_values(const StudyOption& option) {
  if (option.choices.empty())
    return "whole numbers from " + std::to_string(option.least) + " to " + std::to_string(option.most);
  return joined(option.choices);
}

std::string complaint(const StudyOption& option, const std::string& value) {
  if (is_allowed(option, value)) return "";
  return "\"" + value + "\" is not one of the values of --" + option.name +
         "; allowed: " + allowed_values(option);
}

OptionValues with_defaults(const std::vector<StudyOption>& options, const OptionValues& given) {
  OptionValues values;
  for (const auto& option : options) {
    const auto found = given.find(option.name);
    values[option.name] = found == given.end() ? option.value : found->second;
  }
  return values;
}

OptionValues with_later_ones(const std::vector<StudyOption>& options, OptionValues stored) {
  for (const auto& option : options) {
    if (option.of_responses) stored.emplace(option.name, option.value);
    if (!option.before.empty()) stored.emplace(option.name, option.before);
  }
  return stored;
}

std::string difference(const OptionValues& there, const OptionValues& here, bool partly) {
  OptionValues all = here;
  if (!partly) all.insert(there.begin(), there.end());
  for (const auto& [name, ignored] : all) {
    const std::string a = value_in(there, name), b = value_in(here, name);
    if (a != b) return "option " + name + ": " + a + " there, " + b + " here";
  }
  return "";
}

void check(const std::vector<StudyOption>& options) {
  for (const auto& option : options) {
    if (!can_be_a_name(option.name))
      throw std::invalid_argument(
          "studies::Study: \"" + option.name +
          "\" cannot name an option; use lower case letters, digits, '-' and '_', and "
          "no name of an option that all studies have");
    const std::string wrong = complaint(option, option.value);
    if (!wrong.empty()) throw std::invalid_argument("studies::Study: default of an option: " + wrong);
    if (option.before.empty()) continue;
    const std::string never = complaint(option, option.before);
    if (!never.empty()) throw std::invalid_argument("studies::Study: value before an option came: " + never);
  }
}

const Preset& preset_named(const std::vector<Preset>& presets, const std::string& name) {
  for (const Preset& preset : presets)
    if (preset.name == name) return preset;
  throw std::invalid_argument("studies: " + preset_complaint(presets, name));
}

std::string preset_complaint(const std::vector<Preset>& presets, const std::string& name) {
  for (const Preset& preset : presets)
    if (preset.name == name) return "";
  return "\"" + name + "\" is not one of the values of --preset; allowed: " + joined(presets, &Preset::name);
}

void check(const std::vector<Preset>& presets, const std::vector<StudyOption>& options) {
  for (const Preset& preset : presets)
    for (const auto& [name, value] : preset.values) {
      const auto option = std::find_if(options.begin(), options.end(),
                                       [&name = name](const auto& o) { return o.name == name; });
      const std::string place = "studies::Study: preset \"" + preset.name + "\" sets ";
      if (option == options.end())
        throw std::invalid_argument(place + "\"" + name + "\", which is none of the study's options");
      if (const std::string wrong = complaint(*option, value); !wrong.empty())
        throw std::invalid_argument(place + "what is not allowed: " + wrong);
    }
}

std::string options_text(const OptionValues& values) {
  std::string text;
  for (const auto& [name, value] : values) text += (text.empty() ? "--" : " --") + name + " " + value;
  return text;
}

std::string typed_options(const std::vector<StudyOption>& options, const std::vector<Preset>& presets,
                          const OptionValues& values) {
  const auto besides = [&](const OptionValues& given) {
    const OptionValues without = with_defaults(options, given);
    OptionValues differing;
    for (const auto& [name, value] : values)
      if (value_in(without, name) != value) differing[name] = value;
    return differing;
  };
  OptionValues least = besides({});
  std::string text;
  for (const Preset& preset : presets)
    if (const OptionValues differing = besides(preset.values); differing.size() + 1 < least.size()) {
      least = differing;
      text = "--preset " + preset.name;
    }
  return text + (text.empty() || least.empty() ? "" : " ") + options_text(least);
}

}  // namespace drawpoint::studies
