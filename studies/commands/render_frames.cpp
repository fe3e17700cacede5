// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/options/frame_options.h>
#include <drawpoint/studies/commands/options/output_file.h>
#include <drawpoint/studies/commands/render_frames.h>
#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/say/frames/frame_files.h>
#include <drawpoint/studies/say/frames/frame_times.h>
#include <drawpoint/studies/say/frames/programs.h>
#include <drawpoint/studies/say/frames/rendering.h>
#include <drawpoint/studies/say/frames/scratch.h>
#include <drawpoint/studies/say/frames/video.h>
#include <drawpoint/studies/say/run_replay.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

std::string seconds_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g s", value);
  return text;
}

FrameSettings with_files(const Folder& folder, FrameSettings settings) {
  settings.folder = output_file(folder, settings.folder, "--frames");
  settings.video = output_file(folder, settings.video, "--video");
  return settings;
}

/// What can be told before the log is read.
FrameSize checked_size(const FrameSettings& settings) {
  const FrameSize size = frame_size_from(settings.size).value();
  if (!settings.video.empty() && (size.width % 2 != 0 || size.height % 2 != 0))
    throw UsageError("--size: a film has an even number of pixels each way, not " + settings.size +
                     "; add 1 to the odd one");
  return size;
}

nlohmann::json existing_scene(const Study& study, const Identity& identity, const Folder& folder,
                              const Replayed& shown) {
  nlohmann::json scene = scene_of_run(study, identity, folder, shown);
  if (scene.is_null())
    throw std::runtime_error(
        "replay: the study draws no scene of the log of run " + std::to_string(shown.run.id) +
        ", and frames are of a scene; leave --frames and --video out for its other figures");
  return scene;
}

double time_within(const std::optional<double>& given, double otherwise, const char* option,
                   const FrameTimes& scene) {
  if (!given) return otherwise;
  if (*given >= scene.from && *given <= scene.to) return *given;
  throw UsageError(std::string(option) + ": the replay of this run goes from " + seconds_text(scene.from) +
                   " to " + seconds_text(scene.to) + "; " + seconds_text(*given) +
                   " is outside; give a time within, or leave " + option + " out");
}

std::vector<double> times_of(const nlohmann::json& scene, const FrameSettings& settings) {
  const auto& pictures = scene.at("frames");
  const FrameTimes whole{.from = pictures.front().at("t").get<double>(),
                         .to = pictures.back().at("t").get<double>()};
  const FrameTimes times{.from = time_within(settings.from, whole.from, "--from", whole),
                         .to = time_within(settings.to, whole.to, "--to", whole),
                         .fps = settings.fps,
                         .speed = settings.speed};
  if (times.from > times.to)
    throw UsageError("--from: " + seconds_text(times.from) + " is after --to " + seconds_text(times.to) +
                     "; swap them");
  if (frame_count(times) > most_frames)
    throw UsageError("--fps, --speed: " + std::to_string(static_cast<long long>(frame_count(times))) +
                     " frames; allowed are 999999; lower --fps or raise --speed");
  return all_times(times);
}

void say_where(const fs::path& made) { std::printf("%s\n", fs::absolute(made).lexically_normal().c_str()); }

std::string message_after_signal(const FrameSettings& settings) {
  return settings.folder.empty()
             ? "interrupted; no film was made\n"
             : "interrupted; the frames in " + settings.folder.string() +
                   " are whole; remove them before the same command, or name another folder\n";
}

}  // namespace

int render_frames(const Study& study, const Identity& identity, const Folder& folder, const Replayed& shown,
                  const FrameSettings& wanted) {
  const FrameSettings settings = with_files(folder, wanted);
  Rendering rendering{.scene = {}, .times = {}, .size = checked_size(settings), .camera = settings.camera};
  const fs::path ffmpeg = settings.video.empty() ? "" : found_ffmpeg();
  const Browser browser{.program = found_browser()};
  rendering.scene = existing_scene(study, identity, folder, shown);
  rendering.times = times_of(rendering.scene, settings);
  if (!settings.video.empty()) check_film_can_be_written(settings.video);
  if (!settings.folder.empty()) prepare_frame_folder(settings.folder);
  const InterruptGuard guard("");
  try {
    std::optional<Scratch> own;
    if (settings.folder.empty()) own.emplace();
    const fs::path frames = own ? own->path() : settings.folder;
    render(rendering, browser, frames);
    if (!own) say_where(frames);
    if (!settings.video.empty()) film({settings.video, settings.fps}, frames, ffmpeg);
  } catch (const Interrupted&) {
    std::fputs(message_after_signal(settings).c_str(), stderr);
    return 130;
  }
  if (!settings.video.empty()) say_where(settings.video);
  return 0;
}

}  // namespace drawpoint::studies
