// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/options/points.h>
#include <drawpoint/studies/commands/planning.h>
#include <drawpoint/studies/model/fits/stop_rule.h>
#include <drawpoint/studies/model/sampling/adaptive.h>
#include <drawpoint/studies/model/sampling/confirmation_round.h>
#include <drawpoint/studies/model/sampling/criteria.h>
#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/marks.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace drawpoint::studies {
namespace {

std::string repeats_text(const Batch& batch) {
  if (batch.repeats == 0) return "";
  return ", " + std::to_string(batch.repeats) +
         (batch.repeats == 1 ? " of them a run made again" : " of them runs made again");
}

/// For the last words of this command, and for whoever asks later.
void remember(Store& store, const StopNote& stopped) {
  Sampling sampling = store.sampling();
  sampling.stopped = stopped;
  store.set_sampling(sampling);
}

Batch chosen_batch(const Store& store, const std::vector<Run>& runs) {
  const EndsAtOnce now;
  return next_batch(store.identity(), store.sampling(), runs);
}

}  // namespace

void check_request(const Study& study, const Settings& settings) {
  if (settings.plan.criteria) check_criteria(*settings.plan.criteria, study.problem);
  if (settings.plan.until) stop_rule_from(*settings.plan.until, study.problem);
  if (!std::filesystem::exists(Folder{settings.out}.store())) check_new_study(study, settings);
}

bool add_batch(Store& store, const std::string& time_is_up, int messages) {
  const std::vector<Run> runs = store.runs();
  const int wanted = store.sampling().points;
  const int made = count_points(runs, Kind::adaptive);
  if (made < wanted && !time_is_up.empty()) {
    dprintf(messages, "no further adaptive runs, %s: %d of %d made\n", time_is_up.c_str(), made, wanted);
    remember(store, {.why = time_is_up + ": left out are " + std::to_string(wanted - made) + " of " +
                            std::to_string(wanted) + " adaptive points",
                     .go_on = "give the same command again"});
    return false;
  }
  if (made < wanted) dprintf(messages, "fitting the models, choosing adaptive points ...\n");
  const Batch batch = chosen_batch(store, runs);
  if (!batch.stopped.why.empty()) remember(store, batch.stopped);
  const char* what = batch.message.c_str();
  switch (batch.status) {
    case BatchStatus::planned:
      dprintf(messages, "adaptive points %d to %d of %d%s: %s\n", made + 1,
              count_points(batch.runs, Kind::adaptive), wanted, repeats_text(batch).c_str(), what);
      store.add(batch.runs);
      return true;
    case BatchStatus::target_met:
      dprintf(messages, "no further adaptive runs, the target is met: %s\n", what);
      return false;
    case BatchStatus::exhausted:
      dprintf(messages, "no further adaptive runs, %d of %d made: %s\n", made, wanted, what);
      return false;
    case BatchStatus::no_models:
      dprintf(messages, "no adaptive runs, because there are no models yet: %s\n", what);
      return false;
    default:
      return false;
  }
}

Eigen::MatrixXd named_points(const doe::Problem& problem, const ConfirmSettings& settings) {
  if (settings.x.empty()) return Eigen::MatrixXd(0, static_cast<Eigen::Index>(problem.variables.size()));
  return checked_points(problem, settings.x);
}

bool add_round(Store& store, const Study& study, const ConfirmSettings& settings, int round, int messages) {
  const std::vector<Run> runs = store.runs();
  dprintf(messages, "fitting the models, choosing points of their front ...\n");
  RoundPlan plan;
  {
    const EndsAtOnce now;
    plan = plan_round(store.identity(), runs, named_points(store.identity().problem, settings),
                      settings.points, with_marks(study.presentation.marks, store.marks()));
  }
  if (round == 1 || plan.runs.empty())
    for (const std::string& known : plan.known)
      dprintf(messages, "%s%s\n", plan.runs.empty() ? "nothing to simulate: " : "", known.c_str());
  if (plan.runs.empty()) {
    if (!plan.nothing.empty()) dprintf(messages, "%s\n", plan.nothing.c_str());
    return false;
  }
  const int points = count_points(plan.runs, Kind::confirmation) - count_points(runs, Kind::confirmation);
  dprintf(messages, "round %d: %d %s to simulate\n", round, points, points == 1 ? "point" : "points");
  Sampling sampling = store.sampling();
  auto& rounds = sampling.rounds;
  if (!rounds.empty() && rounds.back().first == plan.round.first)
    rounds.pop_back();  // died before its runs came
  rounds.push_back(plan.round);
  store.set_sampling(sampling);
  store.add(plan.runs);
  return true;
}

}  // namespace drawpoint::studies
