// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The program `drawpoint`: lists the studies of an installation, says what they are made of, and starts one.
/// It knows none of them: they are the programs of one folder, and are asked (docs/decisions/0005).

#include <drawpoint/studies/commands/options/did_you_mean.h>
#include <drawpoint/studies/commands/options/option_tree.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace drawpoint;

namespace {

/// Beside this program, wherever the installation lies.
fs::path folder_of_studies() {
  return (fs::read_symlink("/proc/self/exe").parent_path() / DRAWPOINT_PROGRAMS).lexically_normal();
}

/// Their names, in order.
std::vector<std::string> studies_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && access(entry.path().c_str(), X_OK) == 0)
      names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// What the program prints when asked.
std::string said(const fs::path& program, const std::string& question) {
  std::string text;
  FILE* pipe = popen((quoted(program.string()) + " " + question).c_str(), "r");
  if (!pipe) return text;
  std::array<char, 4096> chunk{};
  while (const std::size_t n = std::fread(chunk.data(), 1, chunk.size(), pipe)) text.append(chunk.data(), n);
  pclose(pipe);
  return text;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// The lines of all studies, each once.
std::string version_of(const fs::path& folder, const std::vector<std::string>& studies) {
  std::string text;
  std::set<std::string> seen;
  for (const std::string& study : studies) {
    std::istringstream lines(said(folder / study, "--version"));
    for (std::string line; std::getline(lines, line);)
      if (seen.insert(line).second) text += line + "\n";
  }
  return text;
}

/// Never parsed: the words behind a study's name are the study's.
void describe(CLI::App& app, const fs::path& folder, const std::vector<std::string>& studies) {
  for (const std::string& study : studies)
    app.add_subcommand(study, first_line(said(folder / study, "about")))->group("Studies");
  app.set_help_flag("-h,--help", "show this text");
  app.set_version_flag("--version", "", "say what the studies are made of");
  app.require_subcommand(1);
  app.get_formatter()->label("SUBCOMMAND", "STUDY");
  app.footer(
      "drawpoint STUDY --help lists the commands and options of a study, man drawpoint-STUDY tells more.");
}

int start(const fs::path& program, char** words) {
  std::string name = "drawpoint ";
  name += program.filename().string();
  words[0] = name.data();
  execv(program.c_str(), words);
  std::fprintf(stderr, "drawpoint: cannot start %s; install the package drawpoint again\n", program.c_str());
  return 1;
}

int answer(const std::string& question, const std::vector<std::string>& words, const fs::path& folder,
           const std::vector<std::string>& studies) {
  if (question == "--version") return std::fputs(version_of(folder, studies).c_str(), stdout) < 0;
  CLI::App app("Explores machine designs and strategies by simulation: studies of several goals at once.",
               "drawpoint");
  describe(app, folder, studies);
  if (question == "man-page") {
    const std::string page =
        studies::man_page(app, {"drawpoint", "drawpoint", DRAWPOINT_VERSION, "STUDY", "STUDIES"});
    return std::fputs(page.c_str(), stdout) < 0;
  }
  if (question == "complete") {
    const auto none = [](const std::string&) { return std::vector<std::string>{}; };
    for (const auto& word : studies::completions(app, words, none)) std::puts(word.c_str());
    return 0;
  }
  if (question.empty() || question == "--help" || question == "-h")
    return std::fputs(app.help().c_str(), stdout) < 0;
  std::fprintf(stderr, "drawpoint: there is no study \"%s\"%s; drawpoint --help lists them\n",
               question.c_str(), studies::did_you_mean(question, studies).c_str());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const fs::path folder = folder_of_studies();
    const std::vector<std::string> studies = studies_in(folder);
    const auto is_study = [&](const std::string& name) {
      return std::find(studies.begin(), studies.end(), name) != studies.end();
    };
    const std::string first = argc > 1 ? argv[1] : "";
    if (is_study(first)) return start(folder / first, argv + 1);
    if (first == "complete" && argc > 3 && is_study(argv[2])) {
      const fs::path program = folder / argv[2];
      argv[2] = argv[1];
      return start(program, argv + 1);
    }
    const int code = answer(first, {argv + std::min(argc, 2), argv + argc}, folder, studies);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw std::runtime_error("cannot write to standard output; is the disk full?");
    return code;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "drawpoint: %s\n", e.what());
    return 1;
  }
}
