// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A study from a file, whose simulator is a program in any language: docs/writing-a-study.md.

#include <drawpoint/studies/study_file.h>

#include <cstdio>
#include <exception>
#include <string>

using namespace drawpoint;

namespace {

constexpr const char* usage =
    R"(usage: external_program STUDY.json [COMMAND] [OPTIONS]

Makes the runs of the study that STUDY.json describes: each starts the file's command, a program in any
language, with a request to read and a reply to write. docs/writing-a-study.md shows both files.

  external_program throw.json --runs 40 --validation 10   # plan, run, fit, report
  external_program throw.json confirm                     # simulate what the front promises
  external_program throw.json --help                      # all commands and options
)";

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == "--help" || first == "-h") return std::fputs(usage, stdout) < 0;
  if (first == "--version") return std::puts("Drawpoint " DRAWPOINT_VERSION) < 0;
  if (first.empty() || first[0] == '-') {
    std::fputs(usage, stderr);
    return 2;
  }
  try {
    return studies::run(argc, argv, studies::study_from(first));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "external_program: %s\n", e.what());
    return 1;
  }
}
