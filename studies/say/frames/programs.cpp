// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/frames/programs.h>
#include <unistd.h>

#include <cstdlib>
#include <deque>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace drawpoint::studies {
namespace {

bool can_be_started(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0;
}

}  // namespace

std::filesystem::path program_named(const std::string& name) {
  if (name.find('/') != std::string::npos) return can_be_started(name) ? name : "";
  const char* folders = std::getenv("PATH");
  std::istringstream all(folders == nullptr ? "" : folders);
  for (std::string folder; std::getline(all, folder, ':');)
    if (const auto file = std::filesystem::path(folder.empty() ? "." : folder) / name; can_be_started(file))
      return file;
  return "";
}

std::filesystem::path found_browser() {
  const char* named = std::getenv("DRAWPOINT_BROWSER");
  if (named != nullptr && *named != '\0') {
    const auto file = program_named(named);
    if (!file.empty()) return file;
    throw std::runtime_error("replay: DRAWPOINT_BROWSER is \"" + std::string(named) +
                             "\", which is no program; name a Chromium, or unset it");
  }
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (const auto file = program_named(name); !file.empty()) return file;
  throw std::runtime_error(
      "replay: frames are drawn by a Chromium, and none of chromium, chromium-browser, google-chrome is on "
      "the PATH; install one (Debian: apt install chromium), or name one in the environment variable "
      "DRAWPOINT_BROWSER");
}

std::filesystem::path found_ffmpeg() {
  const auto file = program_named("ffmpeg");
  if (!file.empty()) return file;
  throw std::runtime_error(
      "replay: --video is made by ffmpeg, which is not on the PATH; install it (Debian: apt install ffmpeg), "
      "or leave --video out and keep the frames with --frames");
}

std::string last_words(const std::filesystem::path& printed) {
  constexpr std::size_t most_lines = 5;
  std::ifstream file(printed);
  std::deque<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.find("dbus") != std::string::npos) continue;
    lines.push_back(line);
    if (lines.size() > most_lines) lines.pop_front();
  }
  if (lines.empty()) return "it printed nothing";
  std::string text = "it printed last:";
  for (const std::string& line : lines) text += "\n  " + line;
  return text;
}

}  // namespace drawpoint::studies
