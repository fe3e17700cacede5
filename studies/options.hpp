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
  /// Decides what Logs::responses makes of a log, and nothing in the simulation: `rerun-responses` may
  /// change it.
  bool of_responses = false;
  /// What runs were made with before the option came to the study: folders of before go on, and count as made
  /// with this. Empty: they are another study's.
  std::string before = {};
};

/// A value per option.
using OptionValues = std::map<std::string, std::string>;

/// Values of several options under one name, for --preset NAME. An option that is given too has the value given.
struct Preset {
  std::string name = {};
  std::string help = {};  ///< what it sets, for --help
  OptionValues values = {};
};

}  // namespace drawpoint::studies
