// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/options/frame_options.h>
#include <drawpoint/studies/commands/options/output_file.h>
#include <drawpoint/studies/commands/render_frames.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/say/run_replay.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace drawpoint::studies {

int replay_command(const Study& study, const Settings& settings) {
  const ReplaySettings& wanted = settings.replay;
  if (!study.presentation.illustrate)
    throw UsageError(
        "replay: this study does not say what to draw of a run's log (Presentation::illustrate)");
  const bool frames = wants_frames(wanted.frames);
  const Folder folder{settings.out};
  const Store store = open_store(study, folder);
  const Run run = stored_run(store, folder, wanted.run);
  const Replayed shown{.run = run, .cycle = wanted.cycle};
  if (frames) return render_frames(study, store.identity(), folder, shown, wanted.frames);
  const std::filesystem::path file =
      wanted.file.empty() ? folder.replay(run.id, wanted.cycle) : output_file(folder, wanted.file);
  replay(study, store, folder, shown, file, settings.command);
  std::printf("%s\n", std::filesystem::absolute(file).lexically_normal().c_str());
  return 0;
}

}  // namespace drawpoint::studies
