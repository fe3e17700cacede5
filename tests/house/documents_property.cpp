// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/tests/house/sources.hpp>
#include <regex>
#include <sstream>

using namespace drawpoint::house;

namespace {

const std::filesystem::path root = DRAWPOINT_ROOT;

std::vector<std::filesystem::path> documents() {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(root)) found.push_back(entry.path());
  for (const std::string folder : {"docs", "tests", "benchmarks", "studies"}) {
    if (!std::filesystem::exists(root / folder)) continue;
    std::filesystem::recursive_directory_iterator entry(root / folder), end;
    for (; entry != end; ++entry) {
      if (entry->is_directory() && skipped(entry->path())) entry.disable_recursion_pending();
      found.push_back(entry->path());
    }
  }
  found.erase(
      std::remove_if(found.begin(), found.end(), [](const auto& path) { return path.extension() != ".md"; }),
      found.end());
  return found;
}

// The links of a Markdown text to files that are not there, seen from the folder it is in.
std::vector<std::string> dead_links(const std::string& text, const std::filesystem::path& folder) {
  static const std::regex link("\\]\\(([^)#\\s]+)(#[^)]*)?\\)");
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), link), end; match != end; ++match) {
    const std::string target = (*match)[1];
    const bool elsewhere = target.find("://") != std::string::npos || target.starts_with("mailto:");
    if (!elsewhere && !std::filesystem::exists(folder / target)) found.push_back(target);
  }
  return found;
}

// What the first match of the expression has in its brackets; empty without one.
std::string found_in(const std::filesystem::path& file, const std::string& expression) {
  const std::string text = read_text(file);
  std::smatch match;
  return std::regex_search(text, match, std::regex(expression)) ? match[1].str() : "";
}

}  // namespace

TEST(Documents, TheCitationNamesTheVersionOfTheProject) {
  const std::string version =
      found_in(root / "CMakeLists.txt", "project\\(Drawpoint VERSION ([0-9]+\\.[0-9]+\\.[0-9]+)");
  ASSERT_FALSE(version.empty());
  EXPECT_EQ(found_in(root / "CITATION.cff", "\nversion: (\\S+)\n"), version);
}

TEST(Documents, EveryLinkLeadsSomewhere) {
  const auto all = documents();
  ASSERT_FALSE(all.empty());
  for (const auto& document : all) {
    const auto dead = dead_links(read_text(document), document.parent_path());
    EXPECT_TRUE(dead.empty()) << document.lexically_relative(root) << " links to what is not there:\n"
                              << joined(dead);
  }
}

TEST(Documents, ADeadLinkIsFound) {
  EXPECT_EQ(
      dead_links("see [a](gone.md) and ![b](gone/b.png#x), not [c](https://example.org) or [d](README.md)",
                 root),
      (std::vector<std::string>{"gone.md", "gone/b.png"}));
}

// Finds what stands in the column, counted from 0, of the row of a Markdown table that begins with the word.
std::string cell_of(const std::string& page, const std::string& first, int column) {
  const std::regex row("\\n\\| " + first + "[^|]*((\\|[^|\\n]*)+)\\|\\n");
  std::smatch match;
  if (!std::regex_search(page, match, row)) return "";
  std::istringstream cells(match[1]);
  std::string cell;
  for (int k = 0; k <= column; ++k) std::getline(cells, cell, '|');
  return cell.empty() ? "" : cell.substr(1);
}

// What `export --what findings` wrote.
std::vector<std::pair<std::string, std::string>> verdicts_of(const std::filesystem::path& table) {
  static const std::regex row("\n(F[0-9]+),.*,(reproduced|not reproduced|unclear),");
  const std::string text = read_text(table);
  std::vector<std::pair<std::string, std::string>> verdicts;
  for (std::sregex_iterator match(text.begin(), text.end(), row), end; match != end; ++match)
    verdicts.emplace_back((*match)[1], (*match)[2]);
  return verdicts;
}

TEST(Documents, TheFindingsAreThoseOfTheKeptStudies) {
  const std::string page = read_text(root / "docs/explanation/findings.md");
  int column = 0;
  for (const char* study : {"lindmark2016", "drawpoint"}) {
    ++column;
    const auto verdicts = verdicts_of(root / "studies/results" / study / "findings.csv");
    EXPECT_EQ(verdicts.size(), 16u) << study;
    for (const auto& [finding, verdict] : verdicts)
      EXPECT_TRUE(cell_of(page, finding + " ", column).starts_with(verdict)) << finding << " of " << study;
  }
}

TEST(Documents, TheApiReferenceShowsTheProgramsOfTheCookbook) {
  const std::string reference = read_text(root / "docs/reference/api.dox");
  int programs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(root / "docs/cookbook")) {
    if (entry.path().extension() != ".cpp") continue;
    ++programs;
    const std::string name = entry.path().filename().string();
    EXPECT_NE(reference.find("\\example " + name + " "), std::string::npos)
        << name << " is no example of docs/reference/api.dox; add a line /** \\example " << name
        << " Title */";
  }
  EXPECT_GT(programs, 0);
}
