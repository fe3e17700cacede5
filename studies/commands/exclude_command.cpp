// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/json_output.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/folder.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {
namespace {

int show_ledger(const Store& store, bool as_json) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Correction& c : store.corrections()) {
    all.push_back({{"number", c.number},
                   {"run", c.run},
                   {"what", c.what},
                   {"why", c.why},
                   {"before", nlohmann::ordered_json::parse(c.before, nullptr, false)},
                   {"made", c.made}});
    if (!as_json)
      std::printf("%lld. %s run %lld, %s: %s; before: %s\n", static_cast<long long>(c.number), c.what.c_str(),
                  static_cast<long long>(c.run), c.made.c_str(), c.why.c_str(), c.before.c_str());
  }
  if (as_json)
    std::printf("%s\n", nlohmann::ordered_json{{"corrections", all}}.dump().c_str());
  else if (all.empty())
    std::printf("no run was excluded or replaced\n");
  return 0;
}

void require_reason(const ExcludeSettings& settings) {
  if (settings.why.find_first_not_of(" \t\n") == std::string::npos)
    throw UsageError("exclude --run " + std::to_string(*settings.run) +
                     ": say why with --why TEXT; it is kept beside the run");
}

}  // namespace

int exclude_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  const ExcludeSettings& asked = settings.exclude;
  if (!asked.run) return show_ledger(open_store(study, folder), settings.json);
  require_reason(asked);
  open_store(study, folder);  // refused before anything is locked
  make_writable(folder);
  const FolderLock lock(folder);
  Store store = open_store(study, folder);
  const Run run = stored_run(store, folder, *asked.run);
  const std::string name = "run " + std::to_string(*asked.run);
  if (!has_ended(run)) throw UsageError("exclude: " + name + " has not ended; there is nothing to exclude");
  const bool is_out = run.reason.starts_with("left out: excluded by hand");
  if (is_out != asked.undo)
    throw UsageError("exclude: " + name + (is_out ? " is excluded already" : " is not excluded"));
  store.exclude(*asked.run, asked.why, asked.undo);
  std::fprintf(settings.json ? stderr : stdout,
               "%s is %s; what it gave stays in the store, and the command exclude "
               "lists all corrections. The command report shows the rest\n",
               name.c_str(), asked.undo ? "taken in again" : "left out from now on");
  return settings.json ? show_ledger(store, true) : 0;
}

}  // namespace drawpoint::studies
