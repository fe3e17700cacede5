// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/options/frame_options.h>

#include <charconv>
#include <limits>

namespace drawpoint::studies {
namespace {

constexpr int least_pixels = 16, most_pixels = 4096;  // what software draws: 8192 at most

/// All of the text as a number of pixels; 0: it is none.
int pixels_in(const std::string& text) {
  int value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = end.ec == std::errc() && end.ptr == text.data() + text.size();
  return whole && value >= least_pixels && value <= most_pixels ? value : 0;
}

std::string size_complaint(const std::string& text) {
  if (frame_size_from(text)) return "";
  return "Value " + text + " is no size; give WIDTHxHEIGHT, each 16 to 4096 pixels, such as 1280x720";
}

/// CLI::Range lets what is no number through.
CLI::Validator number_between(double least, double most, const std::string& what) {
  return CLI::Validator(
      [=](const std::string& text) -> std::string {
        double value = std::numeric_limits<double>::quiet_NaN();
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return "";
        return "Value " + text + " is no " + what;
      },
      "");
}

std::string film_complaint(const std::string& text) {
  if (text.ends_with(".mp4") || text.ends_with(".webm")) return "";
  return "Value " + text + " is no name of a film; give one that ends with .mp4 or .webm";
}

}  // namespace

std::optional<FrameSize> frame_size_from(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) return std::nullopt;
  const FrameSize size{pixels_in(text.substr(0, cross)), pixels_in(text.substr(cross + 1))};
  if (size.width == 0 || size.height == 0) return std::nullopt;
  return size;
}

void add_frame_options(CLI::App& command, FrameSettings& settings) {
  const std::string group = "Pictures in place of the page, by chromium";
  const auto add = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->group(group);
  };
  command.get_option("--file")->excludes(
      add("--frames", settings.folder, "folder for frame_000001.png and so on; made where it is not there"));
  command.get_option("--file")->excludes(
      add("--video", settings.video,
          "film to write, .mp4 or .webm; needs ffmpeg, keeps no PNG without --frames")
          ->check(film_complaint));
  const auto add_detail = [&](const char* name, auto& value, const char* help) {
    return add(name, value, help)->each([&settings, name](const std::string&) { settings.given = name; });
  };
  const auto seconds = number_between(-1e9, 1e9, "time; give seconds on the clock of the replay");
  add_detail("--from", settings.from,
             "first moment, in seconds on the clock of the replay (default: its start)")
      ->check(seconds);
  add_detail("--to", settings.to, "last moment likewise (default: its end)")->check(seconds);
  add_detail("--fps", settings.fps, "frames per second of film, 0.1 to 240")
      ->check(number_between(0.1, 240, "rate; give 0.1 to 240 frames per second"))
      ->capture_default_str();
  add_detail("--speed", settings.speed,
             "seconds of the run per second of film, 0.01 to 100: 0.5 is slow motion")
      ->check(number_between(0.01, 100, "speed; give 0.01 to 100 seconds of the run per second of film"))
      ->capture_default_str();
  add_detail("--size", settings.size, "width and height, each 16 to 4096 pixels; even with --video")
      ->check(size_complaint)
      ->capture_default_str();
  add_detail("--camera", settings.camera, "where one looks from, as the buttons of the page")
      ->check(CLI::IsMember({"home", "side", "above", "follow"}))
      ->capture_default_str();
}

bool wants_frames(const FrameSettings& settings) {
  const bool wanted = !settings.folder.empty() || !settings.video.empty();
  if (!wanted && !settings.given.empty())
    throw UsageError(settings.given + " requires --frames or --video: it says how pictures are made");
  return wanted;
}

}  // namespace drawpoint::studies
