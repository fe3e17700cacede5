// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a tree of commands and options says of itself: its man page, and what may be typed next. The tree is
/// the one that parses the command line, so neither can say anything else than --help.

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace drawpoint::studies {

struct ManPage {
  std::string title;                  ///< such as drawpoint-formula_demo
  std::string synopsis;               ///< what is typed before a command
  std::string version;                ///< of Drawpoint
  std::string command = "COMMAND";    ///< what one of the tree's commands is called
  std::string commands = "COMMANDS";  ///< and several
};

/// The source of a man page, section 1: about, commands with their options, exit codes, the app's footer.
std::string man_page(const CLI::App& app, const ManPage& page);

/// The values that an option has, by its name without dashes; empty where any may be given.
using OptionChoices = std::function<std::vector<std::string>(const std::string& option)>;

/// What the last of `words`, which may be empty, can become: commands, long options of the command typed
/// before it (of `run` where there is none), or the values of the option before it. Nothing: a file, perhaps.
/// Bash takes "--what=front" for three words; so it may stand here.
std::vector<std::string> completions(const CLI::App& app, std::vector<std::string> words,
                                     const OptionChoices& choices);

}  // namespace drawpoint::studies
