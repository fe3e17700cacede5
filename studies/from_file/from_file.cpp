// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A study from a file, whose simulator is a program in any language: docs/tutorials/first-study.md.

#include <drawpoint/studies/from_file/study_file.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace drawpoint;

namespace {

constexpr const char* about =
    "A study from a JSON file, whose simulator is a program in any language: docs/tutorials/first-study.md.";

constexpr const char* usage =
    R"(usage: %s STUDY.json [COMMAND] [OPTIONS]

Makes the runs of the study that STUDY.json describes: each starts the file's command, a program in any
language, with a request to read and a reply to write. docs/tutorials/first-study.md shows both files.

  %s throw.json --runs 40 --validation 10   # plan, run, fit, report
  %s throw.json confirm                     # simulate what the front promises
  %s throw.json --help                      # all commands and options
  %s open throw.drawpoint FOLDER            # a study that somebody shares, with its STUDY.json
)";

int run_study(std::vector<std::string> words, const studies::Study& study) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  return studies::run(static_cast<int>(argv.size()), argv.data(), study);
}

/// What the program says of itself before it has a study.
int of_any_study(const std::string& program, const std::vector<std::string>& question) {
  const studies::Study any{.name = "NAME",
                           .problem = {.variables = {{"VALUE", "1", 0, 1}}, .responses = {{"RESPONSE", "1"}}},
                           .black_box = [](const Eigen::VectorXd&) { return doe::Failure{"no study"}; },
                           .about = about,
                           .simulator = {.leading_words = {"STUDY.json"}}};
  std::vector<std::string> words{program, "STUDY.json"};
  words.insert(words.end(), question.begin(), question.end());
  return run_study(std::move(words), any);
}

/// The first word that is no option and not the folder behind --out; empty: there is none.
std::string first_of_no_option(const std::vector<std::string>& words, std::size_t from) {
  for (std::size_t i = from; i < words.size(); ++i) {
    if (words[i].rfind('-', 0) != 0) return words[i];
    if (words[i] == "--out") ++i;
  }
  return "";
}

/// `open FILE ...`: the study lies in the file.
int opened(std::vector<std::string> words) {
  if (std::find(words.begin() + 2, words.end(), "--help") != words.end())
    return of_any_study(words[0], {"open", "--help"});
  const std::string file = first_of_no_option(words, 2);
  if (file.empty()) throw std::runtime_error("open: no file; give one that the command share made");
  const studies::Study study = studies::study_in_share(file);
  words.insert(words.begin() + 1, "STUDY.json");
  return run_study(std::move(words), study);
}

/// `complete STUDY.json WORD...` is asked of the study. The name of the file itself is the shell's.
int completed(std::vector<std::string> words) {
  if (words.size() < 4) return 0;
  std::swap(words[1], words[2]);
  return run_study(words, studies::study_from(words[1]));
}

/// As the process of a run, whose words begin with a checksum: to the study that waits at descriptor 3, that no
/// run can be made.
void refuse_runs(const std::string& reason) {
  const std::string reply = nlohmann::json{{"failure", reason}, {"not_started", true}}.dump(
      -1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (write(3, reply.data(), reply.size()) < 0) return;  // started by hand: nobody waits
}

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  const std::string program = std::filesystem::path(argv[0]).filename().string();
  const bool help = first == "--help" || first == "-h";
  if (help || first.empty() || (first[0] == '-' && first != "--version")) {
    const char* name = program.c_str();
    std::fprintf(help ? stdout : stderr, usage, name, name, name, name, name);
    if (!help) return 2;
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 ? 0 : 1;
  }
  try {
    if (first == "--version" || first == "man-page" || first == "about")
      return of_any_study(argv[0], {first});
    if (first == "open") return opened({argv, argv + argc});
    if (first == "complete") return completed({argv, argv + argc});
    return studies::run(argc, argv, studies::study_from(first));
  } catch (const std::exception& e) {
    if (first[0] == '@') refuse_runs(e.what());
    std::fprintf(stderr, "external_program: %s\n", e.what());
    return 1;
  }
}
