// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/from_file/simulator_files.h>
#include <glob.h>
#include <drawpoint/doe/detail/hash.hpp>
#include <drawpoint/doe/detail/stranger_file.hpp>

#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <system_error>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 200;
constexpr std::uintmax_t most_bytes = 4'000'000;
constexpr std::size_t most_named = 10'000;
constexpr std::uintmax_t most_named_bytes =
    1'000'000'000;                      // which are read at the begin and the end of each run
constexpr int most_looked_at = 20'000;  // names of a folder, before it counts as too large

std::uint64_t hash_of(const fs::path& name, std::uint64_t hash) {
  doe::detail::StrangerFile file(name, doe::detail::Links::follow);
  if (!file.fault().empty()) throw std::runtime_error("the file " + name.string() + " " + file.fault());
  std::vector<char> block(std::size_t{1} << 16);
  for (ssize_t count; (count = file.read(block.data(), block.size())) > 0;)
    hash = doe::detail::fnv1a({block.data(), static_cast<std::size_t>(count)}, hash);
  return hash;
}

SimulatorFiles summed(const std::set<fs::path>& files, const fs::path& folder) {
  std::uint64_t hash = doe::detail::fnv1a_of_nothing;
  for (const fs::path& file : files)
    hash = hash_of(file, doe::detail::fnv1a(file.lexically_relative(folder).string() + '\n', hash));
  return {{files.begin(), files.end()}, doe::detail::hash_digits(hash)};
}

bool is_study(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / "study.db", ignored);
}

/// Files that a study file names, and their bytes.
struct Named {
  std::set<fs::path> files;
  std::uintmax_t bytes = 0;

  void add(const fs::path& file, const std::string& pattern) {
    std::error_code ignored;
    if (!files.insert(file.lexically_normal()).second) return;
    if (const std::uintmax_t size = fs::file_size(file, ignored); !ignored) bytes += size;
    if (files.size() > most_named || bytes > most_named_bytes)
      throw std::runtime_error("\"files\": \"" + pattern + "\" and those before it name more than " +
                               std::to_string(most_named) +
                               " files or 1 GB; name those of the program alone");
  }
};

/// Without the folders of studies, where programs write.
void add_below(const fs::path& place, const std::string& pattern, Named& named) {
  std::error_code ignored;
  if (fs::is_regular_file(place, ignored)) named.add(place, pattern);
  if (!fs::is_directory(place, ignored) || is_study(place)) return;
  fs::recursive_directory_iterator entry(place, fs::directory_options::skip_permission_denied, ignored), end;
  for (; entry != end; entry.increment(ignored)) {
    if (entry->is_directory(ignored) && is_study(entry->path())) entry.disable_recursion_pending();
    if (entry->is_regular_file(ignored)) named.add(entry->path(), pattern);
  }
}

/// What is hidden, what others keep there, and folders of studies.
bool passed_over(const fs::path& name) {
  const std::string text = name.filename().string();
  return text.starts_with('.') || text == "__pycache__" || text == "node_modules" || is_study(name);
}

/// False where there is too much to look at.
bool add_alike(const fs::path& program, std::set<fs::path>& files, std::uintmax_t& bytes) {
  std::error_code ignored;
  int looked_at = 0;
  fs::recursive_directory_iterator entry(program.parent_path(), fs::directory_options::skip_permission_denied,
                                         ignored),
      end;
  for (; entry != end; entry.increment(ignored)) {
    if (++looked_at > most_looked_at) return false;
    if (passed_over(entry->path())) {
      entry.disable_recursion_pending();
    } else if (entry->path().extension() == program.extension() && entry->is_regular_file(ignored) &&
               files.insert(entry->path().lexically_normal()).second) {
      bytes += entry->file_size(ignored);
      if (files.size() > most_files || bytes > most_bytes) return false;
    }
  }
  return true;
}

}  // namespace

SimulatorFiles files_named(const std::vector<std::string>& patterns, const fs::path& folder) {
  Named named;
  for (const std::string& pattern : patterns) {
    glob_t found = {};
    const int error = glob((folder / pattern).c_str(), 0, nullptr, &found);
    const std::vector<std::string> places(found.gl_pathv, found.gl_pathv + (error == 0 ? found.gl_pathc : 0));
    globfree(&found);
    for (const std::string& place : places) add_below(place, pattern, named);
    if (error != 0)
      throw std::runtime_error("\"files\": \"" + pattern +
                               "\" names nothing; give names and patterns as a shell takes them, relative to "
                               "the study file");
  }
  return summed(named.files, folder);
}

SimulatorFiles files_like(const std::vector<fs::path>& programs, const fs::path& folder) {
  std::set<fs::path> files;
  std::uintmax_t bytes = 0;
  for (const fs::path& program : programs)
    if (program.has_extension() && !add_alike(program, files, bytes))
      return {.note = "the folder " + program.parent_path().string() +
                      " is too large to be taken as the program: a changed module is not noticed there. Name "
                      "the program's files in the study file, \"files\": [\"*.py\"]"};
  for (const fs::path& program : programs) files.erase(program.lexically_normal());
  return files.empty() ? SimulatorFiles{} : summed(files, folder);
}

}  // namespace drawpoint::studies
