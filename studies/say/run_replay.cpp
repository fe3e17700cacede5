// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/tables.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/run/logged_runs.h>
#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/run_logs.h>
#include <drawpoint/studies/say/facts.h>
#include <drawpoint/studies/say/page/cycles.h>
#include <drawpoint/studies/say/page/panels.h>
#include <drawpoint/studies/say/page/replay_page.h>
#include <drawpoint/studies/say/run_replay.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace drawpoint::studies {
namespace {

void require_log(const Study& study, const Identity& identity, const Folder& folder, const Run& run) {
  const std::string name = "replay: run " + std::to_string(run.id);
  const std::string log = folder.log(run.id).string();
  if (run.status != Status::done && run.status != Status::failed)
    throw std::runtime_error(name + " has not ended; make it with the command run");
  const std::string failure = run.status == Status::failed ? " It failed: " + run.reason + "." : "";
  if (run.log.empty()) throw std::runtime_error(name + " wrote no log." + failure + " Choose a run that did");
  switch (log_state(folder, run)) {
    case LogState::none:
      throw std::runtime_error(name + ": its log " + log + " is gone; " +
                               how_made_again(study, identity, folder, run.id));
    case LogState::other:
      throw std::runtime_error(name + ": " + log + " is damaged, or not what the run wrote; " +
                               how_made_again(study, identity, folder, run.id));
    case LogState::sound:
      return;
  }
}

nlohmann::json drawn_by(const FigureFunction& draw, const Identity& identity, const Folder& folder,
                        const Run& run) {
  try {
    return draw(folder.log(run.id), identity.options);
  } catch (const std::exception& e) {
    throw std::runtime_error("replay: run " + std::to_string(run.id) + " could not be shown: " + e.what());
  }
}

std::string cycle_complaint(const std::vector<int>& cycles, const Replayed& shown) {
  const std::string run = "run " + std::to_string(shown.run.id);
  if (cycles.empty()) return "--cycle: this study does not show " + run + " by cycles; leave --cycle out";
  const bool one = cycles.size() == 1;
  return "--cycle " + std::to_string(*shown.cycle) + ": the log of " + run + " has " +
         (one ? "cycle " : "cycles ") + std::to_string(cycles.front()) +
         (one ? "" : " to " + std::to_string(cycles.back())) + "; choose one of them";
}

/// The panels of a run's replay: those of all cycles, or of the one that is wanted.
nlohmann::json illustrated(const Study& study, const Identity& identity, const Folder& folder,
                           const Replayed& shown) {
  nlohmann::json panels =
      drawn_by(study.presentation.replay ? study.presentation.replay : study.presentation.illustrate,
               identity, folder, shown.run);
  if (!shown.cycle || !panels.is_array()) return panels;
  const std::vector<int> cycles = detail::cycles_of(panels);
  if (std::find(cycles.begin(), cycles.end(), *shown.cycle) == cycles.end())
    throw UsageError(cycle_complaint(cycles, shown));
  return detail::panels_of_cycle(panels, *shown.cycle);
}

std::vector<std::pair<std::string, std::string>> facts_of_run(const Identity& identity, const Folder& folder,
                                                              const Run& run) {
  std::vector<std::pair<std::string, std::string>> all = {{"Log", folder.log(run.id).filename().string()},
                                                          {"Seed", std::to_string(run.seed)}};
  add_options(identity, all);
  all.emplace_back("Made", run.started + " to " + run.finished);
  all.emplace_back("Time", detail::number_with_unit(run.seconds, "s"));
  all.emplace_back("Page made by", std::string("Drawpoint ") + DRAWPOINT_VERSION);
  return all;
}

ReplayInput input_of_run(const Study& study, const Identity& identity, const Folder& folder,
                         const Replayed& shown, const std::string& command) {
  const Run& run = shown.run;
  require_log(study, identity, folder, run);
  const Tables tables = tables_of({run}, study.problem);
  const auto& rows = run.kind == Kind::validation ? tables.validation.rows : tables.training.rows;
  return {.study = study.name,
          .about = study.about,
          .command = command,
          .problem = study.problem,
          .run = rows.front(),
          .kind = name_of(run.kind),
          .panels = illustrated(study, identity, folder, shown),
          .facts = facts_of_run(identity, folder, run)};
}

}  // namespace

void replay(const Study& study, const Store& store, const Folder& folder, const Replayed& shown,
            const std::filesystem::path& file, const std::string& command) {
  write_replay(file, input_of_run(study, store.identity(), folder, shown, command));
}

std::string replay_page(const Study& study, const Identity& identity, const Folder& folder,
                        const Replayed& shown, const std::string& command) {
  return replay_page(input_of_run(study, identity, folder, shown, command));
}

nlohmann::json scene_of_run(const Study& study, const Identity& identity, const Folder& folder,
                            const Replayed& shown) {
  require_log(study, identity, folder, shown.run);
  std::vector<std::string> cautions;
  for (const auto& panel : illustrated(study, identity, folder, shown)) {
    if (!panel.is_object() || panel.value("type", nlohmann::json()) != "scene") continue;
    auto checked = detail::checked_panels(nlohmann::json::array({panel}), cautions);
    if (!checked.empty()) return std::move(checked.front());
  }
  return {};
}

nlohmann::json flat_figures(const Study& study, const Identity& identity, const Folder& folder,
                            const Run& run, std::vector<std::string>& cautions) {
  require_log(study, identity, folder, run);
  nlohmann::json panels = illustrated(study, identity, folder, {run, {}});
  nlohmann::json flat = nlohmann::json::array();
  for (auto& panel : panels)
    if (!panel.is_object() || panel.value("type", nlohmann::json()) != "scene")
      flat.push_back(std::move(panel));
  const std::vector<int> cycles = detail::cycles_of(flat);
  return detail::checked_panels(cycles.empty() ? flat : detail::panels_of_cycle(flat, cycles.back()),
                                cautions);
}

}  // namespace drawpoint::studies
