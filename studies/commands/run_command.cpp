// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/models.h>
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/folder_work.h>
#include <drawpoint/studies/runs/execution.h>
#include <drawpoint/studies/runs/session.h>
#include <drawpoint/studies/sampling/adaptive.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace drawpoint::studies {
namespace {

using Clock = std::chrono::steady_clock;

/// "; NRMSE production 0.21, spill 0.09"
std::string nrmse_text(const doe::Problem& problem, const std::vector<kriging::Validation>& validations) {
  std::string text;
  for (std::size_t j = 0; j < validations.size(); ++j) {
    char number[32];
    std::snprintf(number, sizeof number, "%.3g", validations[j].nrmse);
    text += (j == 0 ? "; NRMSE " : ", ") + problem.responses[j].name + " " + number;
  }
  return text;
}

/// Adds a batch of adaptive runs. False when the study has what it wants, or no models to go by.
bool add_batch(Store& store, double seconds_left, int messages) {
  const std::vector<Run> runs = store.runs();
  const Identity& identity = store.identity();
  const int made = count_points(runs, Kind::adaptive);
  if (made >= store.sampling().points) return false;
  const Tables tables = tables_of(runs, identity.problem);
  Models fitted;
  try {
    fitted = fit_models(tables);
  } catch (const std::invalid_argument& e) {
    dprintf(messages, "no adaptive runs, because there are no models yet: %s\n", e.what());
    return false;
  }
  const std::string so_far = std::to_string(tables.training.rows.size()) + " runs for the models so far" +
                             nrmse_text(identity.problem, fitted.validations);
  const bool met = target_met(store.sampling(), fitted.validations);
  if (met || seconds_left <= 0.0) {
    dprintf(messages, "no further adaptive runs, %s: %s\n", met ? "the target is met" : "the time is up",
            so_far.c_str());
    return false;
  }
  const auto batch = next_batch(identity, store.sampling(), runs, fitted.models);
  dprintf(messages, "adaptive points %d to %d of %d: %s\n", made + 1, count_points(batch, Kind::adaptive),
          store.sampling().points, so_far.c_str());
  store.add(batch);
  return true;
}

}  // namespace

int run_command(const Study& study, const Settings& settings) {
  const auto start = Clock::now();
  const auto seconds_left = [&] {
    return 3600.0 * settings.hours - std::chrono::duration<double>(Clock::now() - start).count();
  };
  if (!std::filesystem::exists(Folder{settings.out}.store())) check_new_study(study, settings);
  const int messages = message_descriptor(settings);
  return work_in_folder(
      study, settings, [&](const Folder& folder) { return plan_study(study, folder, settings); },
      [&](Store& store, const Folder& folder) {
        prepare_shared(study, store.identity().options, folder, messages);
        do {
          carry_out_runs(store, folder, settings, messages);
        } while (add_batch(store, seconds_left(), messages));
      });
}

int report_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  const Store store = open_store(study, folder);
  return conclude(study, store, folder, settings);
}

}  // namespace drawpoint::studies
