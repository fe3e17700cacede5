// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/failures.h>
#include <drawpoint/studies/model/fits/stop_rule.h>
#include <drawpoint/studies/model/sampling/adaptive.h>
#include <drawpoint/studies/model/sampling/criteria.h>
#include <drawpoint/studies/model/sampling/repeats.h>
#include <drawpoint/studies/model/sampling/samplers.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/doe/detail/nearest.hpp>
#include <drawpoint/doe/detail/unit_box.hpp>
#include <drawpoint/doe/propose.hpp>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::studies {
namespace {

/// What the runs so far say.
struct Known {
  const Tables& tables;
  const Models& fitted;
  Failures failures;
};

struct BatchPoints {
  Eigen::MatrixXd X;
  int repeats = 0;           ///< the last so many rows
  std::string nothing = {};  ///< why there are no rows
};

/// Whether x, natural units, is one of the points, to 1e-4 of the unit box as doe::propose keeps them apart.
bool is_among(const Eigen::MatrixXd& points, const Eigen::VectorXd& x, const doe::Problem& problem) {
  if (points.rows() == 0) return false;
  const Eigen::MatrixXd U = doe::detail::to_unit_box(points, problem);
  return doe::detail::nearest_sites(doe::detail::to_unit_box(x.transpose(), problem), U).squared_distance[0] <
         1e-8;
}

/// Where runs have not been made; fewer rows than `count` where places run out.
Eigen::MatrixXd new_points(const Known& known, const CriteriaTurns& turns, doe::Seed seed,
                           Eigen::Index count) {
  const doe::Evaluations& training = known.tables.training;
  Eigen::MatrixXd points(0, static_cast<Eigen::Index>(training.problem.variables.size()));
  const auto options = [&](Eigen::Index batch, doe::BatchRule rule) {
    return doe::ProposeOptions{.seed = seed,
                               .batch = static_cast<int>(batch),
                               .rule = rule,
                               .allowed = [&](const Eigen::VectorXd& x) {
                                 return !known.failures.avoided(x.transpose()).front() &&
                                        !is_among(points, x, training.problem);
                               }};
  };
  const Eigen::Index together = !turns.may_join          ? 0
                                : turns.new_ones.empty() ? count
                                                         : std::min<Eigen::Index>(turns.together, count);
  if (!turns.new_ones.empty() && together < count)
    points = doe::propose(training, mix_of(turns.new_ones, known.fitted.models, known.failures, seed),
                          options(count - together, doe::BatchRule::cells));
  if (together == 0) return points;
  const Eigen::MatrixXd joint =
      doe::propose(training, joint_improvement_beside(points, known.fitted.models, known.failures),
                   options(count - points.rows(), doe::BatchRule::joint));
  Eigen::MatrixXd all(points.rows() + joint.rows(), points.cols());
  all << points, joint;
  return all;
}

/// Each criterion in its turn; where no new place is left, repeats for all, if they were named.
BatchPoints chosen_points(const Identity& identity, const Sampling& sampling, const std::vector<Run>& runs,
                          const Known& known) {
  const doe::Seed seed = seed_of_choice(identity, runs.size());
  const int made = count_points(runs, Kind::adaptive),
            count = std::min(sampling.points - made, sampling.batch);
  const CriteriaTurns turns = turns_of(criteria_from(sampling.criteria), made, count);
  const auto repeated = [&](Eigen::Index repeats) {
    return points_to_repeat(
        known.tables.training, known.fitted.models, known.failures,
        {.seed = seed, .count = static_cast<int>(repeats), .replicates = identity.replicates});
  };
  Eigen::MatrixXd again = repeated(turns.repeats);
  BatchPoints chosen{new_points(known, turns, seed, count - again.rows())};
  const bool want_new = turns.may_join || !turns.new_ones.empty();
  const bool ran_out = chosen.X.rows() + again.rows() < count && want_new;
  if (ran_out && turns.may_repeat) again = repeated(count - chosen.X.rows());
  chosen.repeats = static_cast<int>(again.rows());
  chosen.X.conservativeResize(chosen.X.rows() + again.rows(), Eigen::NoChange);
  chosen.X.bottomRows(again.rows()) = again;
  if (chosen.X.rows() == 0)
    chosen.nothing = want_new
                         ? "no place is left where a run would be new and likely to succeed"
                         : "no run is worth making again beside what new points would teach; name another "
                           "criterion beside repeat";
  return chosen;
}

/// The largest error of a mean that counts, as a share of its range.
double largest_error(const doe::Problem& problem, const std::vector<kriging::MeanError>& errors) {
  double largest = 0.0;
  for (std::size_t j = 0; j < errors.size(); ++j)
    if (!doe::is_standard_error(problem, j)) largest = std::max(largest, error_that_counts(errors[j]));
  return largest;
}

/// Which errors are as small as they were wanted, or nothing.
StopNote reached(const Sampling& sampling, const doe::Problem& problem, const Models& fitted) {
  if (target_met(sampling, problem, fitted.mean_errors)) {
    char text[120];
    std::snprintf(text, sizeof text,
                  "--target %.3g is reached: the largest error of a mean is %.3g of its range",
                  sampling.target, largest_error(problem, fitted.mean_errors));
    return {.why = text, .go_on = "give a smaller --target, or --target 0", .enough = true};
  }
  const StopState state =
      stop_state(stop_rule_from(sampling.until, problem), problem, fitted.validations, fitted.mean_errors);
  if (!state.met) return {};
  return {.why = "--until is reached: " + state.text,
          .go_on = "give smaller errors in --until, or --until ''",
          .enough = true};
}

}  // namespace

Batch next_batch(const Identity& identity, const Sampling& sampling, const std::vector<Run>& runs) {
  const int missing = sampling.points - count_points(runs, Kind::adaptive);
  if (missing <= 0) return {};
  const Tables tables = tables_of(runs, identity.problem);
  Models fitted;
  try {
    fitted = fit_models(tables);
  } catch (const std::invalid_argument& e) {
    return {.status = BatchStatus::no_models,
            .message = e.what(),
            .stopped = {.why = std::string("there are no models to choose adaptive points by: ") + e.what(),
                        .go_on = "give more --runs, or --retry-failed where runs failed"}};
  }
  const std::string nrmse = nrmse_text(fitted, identity.problem);
  Batch batch{.status = BatchStatus::target_met,
              .message = std::to_string(tables.training.rows.size()) + " runs for the models so far" +
                         (nrmse.empty() ? "" : "; " + nrmse)};
  batch.stopped = reached(sampling, identity.problem, fitted);
  if (batch.stopped.enough) return batch;
  const BatchPoints chosen = chosen_points(identity, sampling, runs, {tables, fitted, Failures(tables)});
  if (chosen.X.rows() == 0) {
    batch.status = BatchStatus::exhausted;
    batch.message = chosen.nothing;
    batch.stopped = {.why = chosen.nothing, .go_on = "name other criteria with --criteria"};
    return batch;
  }
  batch.repeats = chosen.repeats;
  batch.status = BatchStatus::planned;
  batch.runs =
      runs_at(identity, runs, Kind::adaptive, with_predictions(fitted.models, identity.problem, chosen.X));
  return batch;
}

bool target_met(const Sampling& sampling, const doe::Problem& problem,
                const std::vector<kriging::MeanError>& errors) {
  if (sampling.target <= 0.0 || errors.empty()) return false;
  for (std::size_t j = 0; j < errors.size(); ++j)
    if (!doe::is_standard_error(problem, j) && !(error_that_counts(errors[j]) <= sampling.target))
      return false;
  return true;
}

}  // namespace drawpoint::studies
