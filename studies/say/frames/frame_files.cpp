// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/say/frames/frame_files.h>

#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace drawpoint::studies {
namespace {

bool names_a_frame(const std::string& name) { return name.starts_with("frame_") && name.ends_with(".png"); }

}  // namespace

std::string frame_name(std::size_t number) {
  char name[40];
  std::snprintf(name, sizeof name, frame_pattern, static_cast<int>(number));
  return name;
}

void prepare_frame_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder, error) && !std::filesystem::is_directory(folder, error))
    throw UsageError("--frames: " + folder.string() +
                     " is no folder; name one, which is made where it is not there");
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error("--frames: cannot make the folder " + folder.string() + ": " + error.message() +
                             "; name another");
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (names_a_frame(entry.path().filename().string())) ++count;
  if (count > 0)
    throw UsageError("--frames: " + folder.string() + " holds frames already (" + std::to_string(count) +
                     " files frame_*.png); name another folder, or remove them");
}

}  // namespace drawpoint::studies
