// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <drawpoint/tests/end_to_end/support.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

using namespace drawpoint::test;

// The program `drawpoint`, and what it and the studies say of themselves: one tree of options says it all, so
// man pages and completions name what --help names.

namespace {

class Front : public StudyTest {
 protected:
  std::vector<std::string> lines(const std::string& arguments) {
    std::istringstream text(run(std::string(DRAWPOINT) + " " + arguments).out);
    std::vector<std::string> all;
    for (std::string line; std::getline(text, line);) all.push_back(line);
    return all;
  }

  /// The long options that `arguments --help` names at the head of a line, and those of every study.
  std::vector<std::string> options_in_help(const std::string& arguments) {
    static const std::regex option("^ +(?:-\\w,)?(--[a-z][a-z-]*)");
    std::vector<std::string> names;
    for (const std::string& line : lines(arguments + " --help")) {
      std::smatch match;
      if (std::regex_search(line, match, option)) names.push_back(match[1]);
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
  }

  std::string told(const std::string& arguments) { return run(std::string(DRAWPOINT) + " " + arguments).out; }
};

using Lines = std::vector<std::string>;

}  // namespace

TEST_F(Front, ListsTheStudiesWithWhatTheyAreAbout) {
  const std::string text = told("");
  EXPECT_TRUE(contains(text, "A loading cycle as a formula")) << text;
  EXPECT_TRUE(contains(text, "Loading strategies of an LHD")) << text;
  EXPECT_TRUE(contains(text, "simulator is a program in any language")) << text;
  EXPECT_EQ(text, told("--help"));
}

TEST_F(Front, SaysWhatTheStudiesAreMadeOf) {
  const std::string all = told("--version");
  for (const char* name :
       {"Drawpoint", "Eigen", "Ipopt", "SQLite", "cpp-httplib", "Simbody", "FCL", "Highway", "HDF5"})
    EXPECT_TRUE(std::regex_search(all, std::regex("(^|\n)" + std::string(name) + " [0-9]+\\.[0-9.]+\n")))
        << name << " in:\n"
        << all;
  EXPECT_TRUE(std::regex_search(all, std::regex("\ncommit ([0-9a-f]{12,}|unknown)\n"))) << all;
  const std::string formula = told("formula_demo --version");
  EXPECT_TRUE(contains(formula, "Ipopt")) << formula;
  EXPECT_FALSE(contains(formula, "Simbody")) << formula;
  EXPECT_EQ(formula, told("external_program --version"));
}

TEST_F(Front, StartsAStudyWithItsWords) {
  EXPECT_TRUE(contains(told("formula_demo evaluate --x=1,0.5,0.5,0.5 --seed 7"), "production"));
  const Ended wrong = run(std::string(DRAWPOINT) + " formula_demo run --rums 5");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_TRUE(contains(wrong.err, "--rums (did you mean --runs?); see drawpoint formula_demo --help"))
      << wrong.err;
  EXPECT_TRUE(contains(run(std::string(DRAWPOINT) + " formula_demo confrim").err, "(did you mean confirm?)"));
  EXPECT_FALSE(
      contains(run(std::string(DRAWPOINT) + " formula_demo run --frobnicate 5").err, "did you mean"));
  EXPECT_TRUE(contains(run(std::string(DRAWPOINT) + " external_program").err,
                       "drawpoint external_program throw.json confirm"));
}

TEST_F(Front, AnUnknownStudyIsRefused) {
  const Ended ended = run(std::string(DRAWPOINT) + " formula_dem");
  EXPECT_EQ(ended.code, 2);
  EXPECT_TRUE(
      contains(ended.err,
               "there is no study \"formula_dem\" (did you mean formula_demo?); drawpoint --help lists them"))
      << ended.err;
}

TEST_F(Front, CompletesStudiesCommandsOptionsAndValues) {
  EXPECT_EQ(lines("complete form"), Lines{"formula_demo"});
  EXPECT_EQ(lines("complete --v"), Lines{"--version"});
  EXPECT_EQ(lines("complete formula_demo re"), (Lines{"recommend", "report", "replay", "rerun-responses"}));
  EXPECT_EQ(lines("complete formula_demo --ru"), Lines{"--runs"}) << "of run, which may be left out";
  EXPECT_EQ(lines("complete formula_demo export --format ''"), (Lines{"csv", "json", "hdf5"}));
  EXPECT_EQ(lines("complete formula_demo export --format = j"), Lines{"json"}) << "as bash splits it";
  EXPECT_EQ(lines("complete formula_demo export --file ''"), Lines{}) << "a file";
  EXPECT_EQ(lines("complete lhd_loading --materials = l"), Lines{"lindmark2016"});
  EXPECT_EQ(lines("complete external_program " THROW_JSON " sta"), Lines{"status"});
  EXPECT_EQ(lines("complete external_program thr"), Lines{}) << "a file";
}

// The law: what completes, and what the man page names, is what --help names, command by command.
TEST_F(Front, HelpCompletionAndManPageNameTheSameOptions) {
  for (const std::string study : {"formula_demo", "lhd_loading"}) {
    const std::string page = told(study + " man-page");
    const Lines commands = lines("complete " + study + " ''");
    EXPECT_EQ(commands.size(), 21u);
    for (const std::string& command : commands) {
      Lines options = options_in_help(study + " " + command);
      EXPECT_EQ(lines("complete " + study + " " + command + " --"), options) << study << " " << command;
      for (const std::string& option : options)
        EXPECT_TRUE(contains(page, std::regex_replace(option, std::regex("-"), "\\-"))) << option;
      EXPECT_TRUE(contains(page, ".SS " + std::regex_replace(command, std::regex("-"), "\\-"))) << command;
    }
  }
  EXPECT_TRUE(contains(told("external_program man-page"), ".B drawpoint external_program STUDY.json"));
  EXPECT_TRUE(contains(told("man-page"), "drawpoint \\- Explores machine designs"));
}

TEST_F(Front, BashCompletesByWhatTheProgramsSay) {
  const Ended ended = run(
      "bash -c 'source " COMPLETION "; COMP_WORDS=(" DRAWPOINT
      " formula_demo export --what = r); COMP_CWORD=5; _drawpoint; echo \"${COMPREPLY[@]}\"; complete -p'");
  EXPECT_EQ(ended.out, "runs\ncomplete -o bashdefault -o default -F _drawpoint drawpoint\n") << ended.err;
}
