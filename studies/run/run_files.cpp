// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/run_files.h>
#include <drawpoint/studies/run/store/run_logs.h>
#include <drawpoint/doe/detail/stranger_file.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;
using doe::detail::clear_away;

void require_log(const fs::path& log) {
  const doe::detail::StrangerFile file(log);
  if (!file.fault().empty()) throw std::runtime_error("its log " + file.fault());
  if (file.size() > largest_log)
    throw std::runtime_error("its log has " + std::to_string(file.size()) + " bytes; allowed are " +
                             std::to_string(largest_log));
}

/// A power cut leaves what is stored as done with its log.
void put_on_disk(const fs::path& place) {
  const int descriptor = ::open(place.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void make_way(const Folder& folder, std::int64_t id) {
  std::error_code ignored;
  if (!fs::is_directory(folder.unfinished(), ignored)) {
    if (!fs::is_directory(folder.logs(), ignored)) clear_away(folder.logs());
    clear_away(folder.unfinished());
    fs::create_directories(folder.unfinished(), ignored);
  }
  if (!fs::is_regular_file(fs::symlink_status(folder.printed(id), ignored))) clear_away(folder.printed(id));
}

std::string publish_log(const Folder& folder, const Settings& settings, std::int64_t id) {
  const fs::path draft = folder.unfinished_log(id), log = folder.log(id);
  clear_away(log);  // of an attempt that did not count
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(draft, ignored))) return "";
  require_log(draft);
  try {
    if (settings.execution.finish_log) settings.execution.finish_log(draft);
  } catch (const std::exception&) {  // the run stands without the rest of its log
  }
  require_log(draft);
  const std::string checksum = file_checksum(draft);
  put_on_disk(draft);
  link_or_copy(draft, log);
  put_on_disk(log);
  put_on_disk(folder.logs());
  return checksum;
}

void drop_unfinished_log(const Folder& folder, std::int64_t id) { clear_away(folder.unfinished_log(id)); }

void drop_logs(const Folder& folder, std::int64_t id) {
  drop_unfinished_log(folder, id);
  clear_away(folder.log(id));
}

}  // namespace drawpoint::studies
