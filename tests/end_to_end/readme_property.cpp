// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What README says to type: each study is there, and knows each option.

#include <drawpoint/tests/end_to_end/support.hpp>

#include <map>
#include <regex>
#include <sstream>

using namespace drawpoint::test;

namespace {

/// A command of a study in README: in an indented block or between backquotes.
struct Typed {
  std::string study;
  std::vector<std::string> options;
};

std::vector<Typed> commands_of(const std::string& page) {
  static const std::regex command("\\./run-study ([a-z_]+)([^`#\n]*)"), option("\\s(--[a-z][a-z-]*)");
  // A command between backquotes may go over the end of a line.
  const std::string text = std::regex_replace(page, std::regex("`\\./run-study\\s+"), "`./run-study ");
  std::vector<Typed> found;
  for (std::sregex_iterator match(text.begin(), text.end(), command), end; match != end; ++match) {
    Typed typed{(*match)[1], {}};
    const std::string rest = (*match)[2];
    for (std::sregex_iterator o(rest.begin(), rest.end(), option); o != end; ++o)
      typed.options.push_back((*o)[1]);
    found.push_back(typed);
  }
  return found;
}

class Readme : public StudyTest {};

}  // namespace

TEST_F(Readme, WhatItSaysToTypeIsThere) {
  const auto commands = commands_of(contents(README));
  ASSERT_GE(commands.size(), 8u);
  std::map<std::string, std::string> helps;
  for (const Typed& typed : commands) {
    if (!helps.contains(typed.study)) {
      const std::string program = std::string(STUDY_PROGRAMS) + "/" + typed.study;
      const bool needs_a_file = typed.study == "external_program";
      const Ended end = run((needs_a_file ? THROW_STUDY : program) + " --help-all");
      EXPECT_EQ(end.code, 0) << "README names the study " << typed.study << ": " << end.err;
      helps[typed.study] = end.out;
    }
    for (const std::string& option : typed.options)
      EXPECT_NE(helps[typed.study].find(option), std::string::npos)
          << "README gives " << typed.study << " the option " << option << ", which it does not have";
  }
}
