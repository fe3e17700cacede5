// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <drawpoint/tests/house/sources.hpp>
#include <map>
#include <regex>
#include <set>
#include <sstream>

using namespace drawpoint::house;

namespace {

const std::filesystem::path root = DRAWPOINT_ROOT;

const std::string licence_lines =
    "// SPDX-FileCopyrightText: Drawpoint contributors\n// SPDX-License-Identifier: Apache-2.0\n";

std::vector<std::string> without_licence(const std::vector<Source>& all) {
  std::vector<std::string> found;
  for (const Source& source : all) {
    if (!source.text.starts_with(licence_lines)) found.push_back(source.path);
  }
  return found;
}

std::vector<std::string> headers_without_guard(const std::vector<Source>& all) {
  std::vector<std::string> found;
  for (const Source& source : all) {
    if (source.path.ends_with(".hpp") && source.text.find("\n#pragma once\n") == std::string::npos) {
      found.push_back(source.path);
    }
  }
  return found;
}

/// Lines of more characters than fit, as "path:line".
std::vector<std::string> wide_lines(const std::vector<Source>& all) {
  constexpr std::ptrdiff_t most = 120;
  std::vector<std::string> found;
  for (const Source& source : all) {
    std::istringstream lines(source.text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      const bool raw = line.find("R\"") != std::string::npos;
      const auto characters =
          std::count_if(line.begin(), line.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; });
      if (characters > most && !raw) found.push_back(source.path + ":" + std::to_string(number));
    }
  }
  return found;
}

std::vector<std::string> strangers(const std::set<std::string>& entries) {
  static const std::set<std::string> allowed{"engine",
                                             "doe",
                                             "kriging",
                                             "pareto",
                                             "python",
                                             "studies",
                                             "tests",
                                             "benchmarks",
                                             "cmake",
                                             "docs",
                                             "CMakeLists.txt",
                                             "README.md",
                                             "CHANGELOG.md",
                                             "CONTRIBUTING.md",
                                             "CITATION.cff",
                                             "SECURITY.md",
                                             "LICENSE",
                                             "run-study",
                                             "run-tests",
                                             ".clang-format",
                                             ".clang-tidy",
                                             "CMakePresets.json",
                                             ".ci",
                                             ".gitignore",
                                             ".gitattributes",
                                             ".github"};
  std::vector<std::string> found;
  std::set_difference(entries.begin(), entries.end(), allowed.begin(), allowed.end(),
                      std::back_inserter(found));
  return found;
}

/// Files of tests whose name stands in no CMakeLists.txt beside them: nothing builds them. The validation
/// suite lists its problems without the ending.
std::vector<std::string> unlisted_tests(const std::vector<Source>& all,
                                        const std::map<std::string, std::string>& lists) {
  static const std::regex test("(.*)/((\\w+)_(analytic|property|statistical|regression|validation))\\.cpp");
  std::vector<std::string> found;
  std::smatch part;
  for (const Source& source : all) {
    if (!std::regex_match(source.path, part, test)) continue;
    const std::string name = part[4] == "validation" ? part[3] : part[2];
    const auto list = lists.find(part[1]);
    const bool listed = list != lists.end() &&
                        std::regex_search(list->second, std::regex("\\b" + name + "(_validation)?\\b"));
    if (!listed) found.push_back(source.path);
  }
  return found;
}

/// By folder.
std::map<std::string, std::string> lists_of_tests() {
  std::map<std::string, std::string> lists;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "tests"))
    if (entry.path().filename() == "CMakeLists.txt")
      lists[entry.path().parent_path().lexically_relative(root).generic_string()] = read_text(entry.path());
  return lists;
}

// What git would put into a clone, at the top; in a tree that git does not know (a release archive), all
// there is.
std::set<std::string> top_level() {
  std::set<std::string> entries;
  const std::string command = "git -c safe.directory='*' -C '" + root.string() + "' ls-files 2>/dev/null";
  if (FILE* listing = popen(command.c_str(), "r")) {
    std::array<char, 4096> line{};
    while (std::fgets(line.data(), line.size(), listing)) {
      const std::string path(line.data());
      entries.insert(path.substr(0, path.find_first_of("/\n")));
    }
    pclose(listing);
  }
  if (!entries.empty()) return entries;
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    if (name != "build" && name != ".git") entries.insert(name);
  }
  return entries;
}

}  // namespace

TEST(Layout, EverySourceOpensWithItsLicence) {
  const std::vector<Source> all =
      sources(root, {"doe", "kriging", "pareto", "python", "engine", "studies", "tests", "benchmarks"});
  ASSERT_FALSE(all.empty());
  EXPECT_TRUE(without_licence(all).empty()) << joined(without_licence(all));
  EXPECT_TRUE(headers_without_guard(all).empty()) << joined(headers_without_guard(all));
}

TEST(Layout, NoLineIsWiderThanAPage) {
  const std::vector<Source> all =
      sources(root, {"doe", "kriging", "pareto", "python", "engine", "studies", "tests", "benchmarks"});
  EXPECT_TRUE(wide_lines(all).empty()) << joined(wide_lines(all));
}

TEST(Layout, TheTopLevelIsFixed) {
  const std::set<std::string> entries = top_level();
  EXPECT_TRUE(entries.count("CMakeLists.txt"));
  EXPECT_TRUE(strangers(entries).empty()) << "not allowed at the top: " << joined(strangers(entries));
}

TEST(Layout, EveryFileOfTestsIsBuilt) {
  const std::vector<Source> all = sources(root, {"tests"});
  ASSERT_FALSE(all.empty());
  EXPECT_TRUE(unlisted_tests(all, lists_of_tests()).empty()) << joined(unlisted_tests(all, lists_of_tests()));
}

TEST(Layout, TheChecksFindWhatIsWrong) {
  const std::vector<Source> tests = {
      {"tests/doe/a_analytic.cpp", ""}, {"tests/doe/b_property.cpp", ""}, {"tests/doe/own.cpp", ""}};
  EXPECT_EQ(unlisted_tests(tests, {{"tests/doe", "STEMS b_property aa_analytic"}}),
            std::vector<std::string>{"tests/doe/a_analytic.cpp"});
  EXPECT_EQ(unlisted_tests(tests, {}).size(), 2u);
  EXPECT_EQ(without_licence({{"a.cpp", "int a;\n"}, {"b.cpp", licence_lines}}),
            std::vector<std::string>{"a.cpp"});
  EXPECT_EQ(headers_without_guard({{"a.hpp", licence_lines}, {"b.cpp", licence_lines}}),
            std::vector<std::string>{"a.hpp"});
  EXPECT_EQ(wide_lines({{"a.hpp", std::string(120, 'x') + "\n" + std::string(121, 'x')}}),
            std::vector<std::string>{"a.hpp:2"});
  EXPECT_EQ(strangers({"doe", "notes.txt"}), std::vector<std::string>{"notes.txt"});
}
