// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/say/live/server.h>

#include <cstdio>
#include <filesystem>

namespace drawpoint::studies {

int live_command(const Study& study, const Settings& settings) {
  const std::filesystem::path folder = std::filesystem::absolute(settings.out).lexically_normal();
  Site site({study, Folder{folder}, settings.program});
  serve(site, settings.live.port, [&](int port) {
    std::printf("http://127.0.0.1:%d/\n", port);
    std::fflush(stdout);
    std::fprintf(stderr, "%s\nThe page is served until Ctrl-C, which leaves the study alone.\n",
                 site.standing().c_str());
  });
  return 0;
}

}  // namespace drawpoint::studies
