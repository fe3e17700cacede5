// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/run_process.h>
#include <drawpoint/studies/mark.hpp>

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace drawpoint::studies {

namespace fs = std::filesystem;

/// The link in /proc works even when a rebuild has replaced the file; the real name
/// looks better in `ps`.
std::string own_executable() {
  const fs::path link = "/proc/self/exe";
  std::error_code error;
  const fs::path name = fs::read_symlink(link, error);
  return !error && fs::equivalent(name, link, error) ? name.string() : link.string();
}

void require_own_file() {
  if (own_executable().starts_with("/proc/"))
    throw std::runtime_error(
        "studies: this program's file was replaced or removed since it started, and Slurm's tasks need it; "
        "give "
        "the same command again");
}

std::vector<std::string> whole_line(std::vector<std::string> leading, const std::vector<std::string>& words,
                                    const OptionValues& options) {
  leading.insert(leading.end(), words.begin(), words.end());
  for (const auto& [name, value] : options) leading.push_back("--" + name + "=" + value);
  return leading;
}

doe::Process process_of_run(const Run& run, const Folder& given, const OptionValues& options,
                            const Settings& settings) {
  const Folder folder{fs::absolute(given.path)};
  return {
      .id = run.id,
      .executable = own_executable(),
      .arguments = whole_line(settings.execution.leading_words,
                              {"evaluate", "--x=" + typed_values(run.x), "--seed=" + std::to_string(run.seed),
                               "--log=" + folder.unfinished_log(run.id).string(),
                               "--shared=" + folder.shared().string(), "--result-descriptor=3"},
                              options),
      .output = folder.printed(run.id),
      .time_limit = settings.execution.time_limit};
}

}  // namespace drawpoint::studies
