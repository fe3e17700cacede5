// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/program/one_process.h>
#include <drawpoint/studies/say/frames/frame_files.h>
#include <drawpoint/studies/say/frames/programs.h>
#include <drawpoint/studies/say/frames/scratch.h>
#include <drawpoint/studies/say/frames/video.h>
#include <unistd.h>
#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/doe/processes.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_write_film(const fs::path& file, int error) {
  throw std::runtime_error("--video: cannot write " + file.string() + ": " + std::strerror(error) +
                           "; check its folder and the free space, or name another");
}

/// Colours as the frames have them, in the sampling (4:2:0) that every player shows.
std::vector<std::string> words_for_ffmpeg(const Video& video, const fs::path& frames, const fs::path& to) {
  char rate[40];
  std::snprintf(rate, sizeof rate, "%.9g", video.fps);
  std::vector<std::string> words = {"-hide_banner",
                                    "-nostdin",
                                    "-xerror",  // also of a disk that fills at the end: a cut film is none
                                    "-loglevel",
                                    "warning",
                                    "-y",
                                    "-framerate",
                                    rate,
                                    "-i",
                                    (frames / frame_pattern).string(),
                                    "-vf",
                                    "scale=out_color_matrix=bt709:out_range=tv",
                                    "-pix_fmt",
                                    "yuv420p",
                                    "-colorspace",
                                    "bt709",
                                    "-color_primaries",
                                    "bt709",
                                    "-color_trc",
                                    "bt709"};
  const std::vector<std::string> mp4 = {"-c:v",      "libx264",    "-crf", "20",
                                        "-movflags", "+faststart", "-f",   "mp4"};
  const std::vector<std::string> webm = {"-c:v", "libvpx-vp9", "-crf", "30", "-b:v",
                                         "0",    "-row-mt",    "1",    "-f", "webm"};
  const auto& format = video.file.extension() == ".webm" ? webm : mp4;
  words.insert(words.end(), format.begin(), format.end());
  words.push_back(to.string());
  return words;
}

}  // namespace

void check_film_can_be_written(const fs::path& file) {
  if (access(fs::absolute(file).parent_path().c_str(), W_OK | X_OK) != 0) cannot_write_film(file, errno);
  if (fs::is_directory(file)) cannot_write_film(file, EISDIR);
}

void film(const Video& video, const fs::path& folder, const fs::path& ffmpeg) {
  const Scratch scratch;
  doe::detail::TemporaryFile unfinished(fs::absolute(video.file));
  const fs::path printed = scratch.path() / "printed.txt";
  const doe::ProcessEnd end =
      end_of({.executable = ffmpeg.string(),
              .arguments = words_for_ffmpeg(video, fs::absolute(folder), unfinished.path()),
              .output = printed});
  if (end.wait_status != 0)
    throw std::runtime_error(
        "replay: " + video.file.string() + " was not made: ffmpeg " + doe::describe(end) +
        "; check the free space in its folder, or name another file; " + last_words(printed));
  unfinished.replace_target();
}

}  // namespace drawpoint::studies
