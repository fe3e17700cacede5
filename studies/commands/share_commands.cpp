// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/json_output.h>
#include <drawpoint/studies/commands/options/output_file.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/run_logs.h>
#include <drawpoint/studies/run/store/share_file.h>
#include <drawpoint/studies/run/store/times.h>
#include <drawpoint/studies/say/versions.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <optional>
#include <set>
#include <system_error>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

/// What whoever opens the file should know.
std::vector<std::string> cautions_of(const Folder& folder, const std::set<std::int64_t>& damaged) {
  std::vector<std::string> cautions;
  for (const std::int64_t id : damaged)
    cautions.push_back("the log of run " + std::to_string(id) + " is damaged and left out");
  std::error_code ignored;
  if (!fs::exists(folder.report(), ignored))
    cautions.emplace_back("there is no report; the command report makes one");
  else if (fs::last_write_time(folder.report(), ignored) < fs::last_write_time(folder.store(), ignored))
    cautions.emplace_back("the store is newer than the report; the command report makes it anew");
  return cautions;
}

std::set<std::int64_t> damaged_logs(const Folder& folder, const std::vector<Run>& runs) {
  std::set<std::int64_t> damaged;
  for (const Run& run : runs)
    if (log_state(folder, run) == LogState::other) damaged.insert(run.id);
  return damaged;
}

std::vector<FileToShare> chosen_files(const Folder& folder, const Study& study, const ShareSettings& settings,
                                      const std::set<std::int64_t>& damaged) {
  std::vector<FileToShare> files = files_to_share(folder.path);
  std::erase_if(files, [&](const FileToShare& file) {
    if (!settings.logs && file.name.starts_with("logs/")) return true;
    for (const std::int64_t id : damaged)
      if (file.from == folder.log(id)) return true;
    return !study.simulator.definition.empty() && file.name == definition_name;
  });
  if (!study.simulator.definition.empty())
    files.push_back({definition_name, folder.path / definition_name, study.simulator.definition});
  return files;
}

/// The folder's name, beside it.
fs::path default_share(const Folder& folder) {
  fs::path file = fs::absolute(folder.path).lexically_normal();
  if (!file.has_filename()) file = file.parent_path();
  return file += ".drawpoint";
}

/// One that is made while this runs goes with it, unless it has become the study's folder.
class Draft {
 public:
  explicit Draft(const fs::path& beside) {
    std::string name = beside.string() + ".unfinished-XXXXXX";
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("open: cannot make a folder beside " + beside.string() + ": " +
                               std::error_code(errno, std::generic_category()).message() +
                               "; name another place");
    path_ = name;
  }
  ~Draft() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  const fs::path& path() const { return path_; }
  void becomes(const fs::path& folder) {
    fs::permissions(path_, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                               fs::perms::others_read | fs::perms::others_exec);
    fs::rename(path_, folder);
    path_.clear();
  }

 private:
  fs::path path_;
};

void require_new_folder(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(folder, ignored))) return;
  if (fs::is_directory(fs::symlink_status(folder, ignored)) && fs::is_empty(folder, ignored)) return;
  throw UsageError("open: " + folder.string() +
                   " is there already, and nothing is written over; name a new folder with --out");
}

/// Who gets the file has no study file yet: it lies within.
std::string opening_program(const Study& study, const Settings& settings) {
  return study.simulator.definition.empty() ? settings.program
                                            : settings.program.substr(0, settings.program.find(' '));
}

}  // namespace

int share_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  open_store(study, folder);  // refused before anything is locked
  std::optional<FolderLock> lock;
  if (access(folder.path.c_str(), W_OK) == 0)
    lock.emplace(folder);  // nobody writes where it cannot be written
  const Store store = open_store(study, folder);
  const fs::path file = output_file(
      folder, settings.share.file.empty() ? default_share(folder) : settings.share.file, "--output");
  if (fs::is_directory(file)) throw UsageError("--output: " + file.string() + " is a folder; name a file");
  if (fs::exists(file) && !settings.share.replace)
    throw UsageError("share: " + file.string() +
                     " is there already; --replace writes over it, --output names another");
  const std::vector<Run> runs = store.runs();
  const std::set<std::int64_t> damaged =
      settings.share.logs ? damaged_logs(folder, runs) : std::set<std::int64_t>();
  const std::vector<FileToShare> files = chosen_files(folder, study, settings.share, damaged);
  write_share(file, files,
              {{"study", study.name},
               {"program", program_version()},
               {"folder", fs::absolute(folder.path).lexically_normal().string()},
               {"made", utc_text(std::time(nullptr))}});
  const std::vector<std::string> cautions = cautions_of(folder, damaged);
  if (settings.json) {
    print_json(
        {{"study", study.name}, {"file", file.string()}, {"files", files.size()}, {"cautions", cautions}});
    return 0;
  }
  std::printf("%zu files of %s in %s; elsewhere: %s open %s --out FOLDER\n", files.size(),
              folder.path.c_str(), file.c_str(), opening_program(study, settings).c_str(),
              file.filename().c_str());
  for (const std::string& caution : cautions) std::printf("Caution: %s\n", caution.c_str());
  return 0;
}

int open_command(const Study& study, const Settings& settings) {
  require_new_folder(settings.out);
  auto facts = share_facts(settings.share.file);
  if (facts["study"] != study.name)
    throw UsageError("open: " + settings.share.file.string() + " holds the study \"" + facts["study"] +
                     "\", and this is the program of \"" + study.name + "\"; take that of the other");
  const fs::path folder = fs::absolute(settings.out).lexically_normal();
  if (!folder.parent_path().empty()) fs::create_directories(folder.parent_path());
  Draft draft(folder.has_filename() ? folder : folder.parent_path());
  const int files = unpack_share(settings.share.file, draft.path());
  open_store(study, Folder{draft.path()}).runs();  // sound, and of this study
  draft.becomes(folder.has_filename() ? folder : folder.parent_path());
  if (settings.json) {
    print_json({{"study", study.name},
                {"folder", settings.out.string()},
                {"files", files},
                {"made", facts["made"]},
                {"from", facts["folder"]}});
    return 0;
  }
  std::printf("%d files in %s, every one with its checksum; shared on %s from %s by %s\n", files,
              settings.out.c_str(), facts["made"].c_str(), facts["folder"].c_str(), facts["program"].c_str());
  const Folder made{settings.out};
  if (fs::exists(made.report())) std::printf("report: %s\n", fs::absolute(made.report()).c_str());
  return 0;
}

}  // namespace drawpoint::studies
