// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/store/run_logs.h>
#include <drawpoint/doe/detail/hash.hpp>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace drawpoint::studies {

std::string file_checksum(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file)) in.setstate(std::ios::failbit);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in) throw std::runtime_error("studies: cannot read " + file.string());
  return doe::detail::checksum(bytes);
}

LogState log_state(const Folder& folder, const Run& run) {
  const std::filesystem::path file = folder.log(run.id);
  if (run.log.empty() || !std::filesystem::exists(file)) return LogState::none;
  try {
    return file_checksum(file) == run.log ? LogState::sound : LogState::other;
  } catch (const std::exception&) {
    return LogState::other;
  }
}

}  // namespace drawpoint::studies
