// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <drawpoint/tests/house/sources.hpp>
#include <set>

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

std::vector<std::string> strangers(const std::set<std::string>& entries) {
  static const std::set<std::string> allowed{"engine",
                                             "doe",
                                             "kriging",
                                             "pareto",
                                             "studies",
                                             "tests",
                                             "benchmarks",
                                             "cmake",
                                             "docs",
                                             "CMakeLists.txt",
                                             "README.md",
                                             "CHANGELOG.md",
                                             "CONTRIBUTING.md",
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
      sources(root, {"doe", "kriging", "pareto", "engine", "studies", "tests", "benchmarks"});
  ASSERT_FALSE(all.empty());
  EXPECT_TRUE(without_licence(all).empty()) << joined(without_licence(all));
  EXPECT_TRUE(headers_without_guard(all).empty()) << joined(headers_without_guard(all));
}

TEST(Layout, TheTopLevelIsFixed) {
  const std::set<std::string> entries = top_level();
  EXPECT_TRUE(entries.count("CMakeLists.txt"));
  EXPECT_TRUE(strangers(entries).empty()) << "not allowed at the top: " << joined(strangers(entries));
}

TEST(Layout, TheChecksFindWhatIsWrong) {
  EXPECT_EQ(without_licence({{"a.cpp", "int a;\n"}, {"b.cpp", licence_lines}}),
            std::vector<std::string>{"a.cpp"});
  EXPECT_EQ(headers_without_guard({{"a.hpp", licence_lines}, {"b.cpp", licence_lines}}),
            std::vector<std::string>{"a.hpp"});
  EXPECT_EQ(strangers({"doe", "notes.txt"}), std::vector<std::string>{"notes.txt"});
}
