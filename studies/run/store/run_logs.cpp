// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/run_logs.h>
#include <drawpoint/doe/detail/hash.hpp>
#include <drawpoint/doe/detail/stranger_file.hpp>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace drawpoint::studies {

std::string file_checksum(const std::filesystem::path& name) {
  doe::detail::StrangerFile file(name, doe::detail::Links::follow);
  if (!file.fault().empty()) throw std::runtime_error("studies: " + name.string() + " " + file.fault());
  std::vector<char> block(std::size_t{1} << 20);
  std::uint64_t hash = doe::detail::fnv1a_of_nothing;
  ssize_t count = 0;
  while ((count = file.read(block.data(), block.size())) > 0)
    hash = doe::detail::fnv1a({block.data(), static_cast<std::size_t>(count)}, hash);
  if (count < 0)
    throw std::runtime_error("studies: " + name.string() + " cannot be read: " + std::strerror(errno));
  return doe::detail::hash_digits(hash);
}

LogState log_state(const Folder& folder, const Run& run) {
  const std::filesystem::path file = folder.log(run.id);
  std::error_code ignored;
  if (run.log.empty() || !std::filesystem::exists(file, ignored)) return LogState::none;
  try {
    return file_checksum(file) == run.log ? LogState::sound : LogState::other;
  } catch (const std::exception&) {
    return LogState::other;
  }
}

}  // namespace drawpoint::studies
