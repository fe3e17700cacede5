// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/options/run_options.h>
#include <drawpoint/studies/model/sampling/criteria.h>
#include <drawpoint/studies/run/budget.h>
#include <drawpoint/studies/run/store/joined.h>
#include <drawpoint/doe/problem.hpp>

#include <charconv>
#include <limits>
#include <string>

namespace drawpoint::studies {
namespace {

/// CLI::Range lets what is no number through.
std::string seconds_complaint(const std::string& text) {
  constexpr double most = 1e9;
  double seconds = std::numeric_limits<double>::quiet_NaN();
  if (CLI::detail::lexical_cast(text, seconds) && seconds >= 0 && seconds <= most) return "";
  return "Value " + text + " is no time; give 0 to 1e9 seconds, 0 for no limit";
}

std::string target_complaint(const std::string& text) {
  double target = std::numeric_limits<double>::quiet_NaN();
  if (CLI::detail::lexical_cast(text, target) && target >= 0 && target <= 1) return "";
  return "Value " + text + " is no share of the range; give 0 to 1, 0 for no target";
}

std::string hours_complaint(const std::string& text) {
  double hours = std::numeric_limits<double>::quiet_NaN();
  if (CLI::detail::lexical_cast(text, hours) && hours >= 0) return "";
  return "Value " + text + " is no time; give 0 hours or more";
}

std::string criteria_complaint(const std::string& text) {
  try {
    criteria_from(text);
    return "";
  } catch (const UsageError& e) {
    return e.what();
  }
}

std::string budget_complaint(const std::string& text) {
  try {
    budget_seconds(text);
    return "";
  } catch (const UsageError& e) {
    return e.what();
  }
}

}  // namespace

std::string seed_complaint(const std::string& text) {
  doe::Seed seed = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (!text.empty() && end.ec == std::errc() && end.ptr == text.data() + text.size()) return "";
  return "Value " + text + " is no seed; give a whole number from 0 to " +
         std::to_string(std::numeric_limits<doe::Seed>::max());
}

std::string names_of(const doe::Problem& problem) {
  return joined(problem.variables, &doe::Variable::name, ",");
}

void add_run_options(CLI::App& command, Settings& settings, const Defaults& defaults) {
  const int most_points = 1'000'000;
  const std::string kept = ", or as many as the folder holds";
  command
      .add_option("--runs", settings.plan.runs,
                  "training points (default " + std::to_string(defaults.runs) + kept + ")")
      ->check(CLI::Range(0, most_points));
  command.add_option("--import", settings.plan.imported,
                     "table of points made elsewhere, as export writes it; those already there are left out");
  command
      .add_option("--validation", settings.plan.validation,
                  "validation points (default " + std::to_string(defaults.validation) + kept + ")")
      ->check(CLI::Range(0, most_points));
  command
      .add_option("--replicates", settings.plan.replicates,
                  "runs per training point, each with its own seed (default 1)")
      ->check(CLI::Range(1, 1000));
  command
      .add_option("--seed", settings.plan.seed,
                  "study seed, from which all random numbers follow (default 1)")
      ->check(seed_complaint);
}

void add_sampling_options(CLI::App& command, Settings& settings, const Defaults& defaults) {
  const std::string group = "Adaptive sampling";
  command
      .add_option("--adaptive", settings.plan.adaptive,
                  "adaptive points in all, where the runs before them show that they teach most (default " +
                      std::to_string(defaults.adaptive) + ", or as many as the folder is to hold)")
      ->check(CLI::Range(0, 1'000'000))
      ->group(group);
  command
      .add_option("--batch", settings.plan.batch,
                  "adaptive points chosen together, before the models are fitted again (default 8)")
      ->check(CLI::Range(1, 100'000))
      ->group(group);
  command
      .add_option(
          "--criteria", settings.plan.criteria,
          "who chooses them: NAME=WEIGHT,... of lola_voronoi, voronoi, distance, error, "
          "cross_validation, variance, feasibility, improvement; for one objective predicted and, "
          "without limits, joint_improvement, knowledge_gradient; repeat: runs made again where noise "
          "limits the models (default lola_voronoi=0.4,voronoi=0.4,error=0.2)")
      ->check(criteria_complaint)
      ->group(group);
  command
      .add_option(
          "--target", settings.plan.target,
          "stop when the models miss the mean of every response, standard errors apart, by at most this "
          "share of its range, by the validation runs (default 0: never)")
      ->check(target_complaint)
      ->group(group);
  command
      .add_option(
          "--until", settings.plan.until,
          "stop when these errors, shares of the range by the validation runs, are reached: 'nrmse(RESPONSE) "
          "< "
          "0.1', of single runs, or mean_error(RESPONSE), of their mean; several with \" and \" between "
          "(default: what the folder has; '': none). Without --adaptive, after four points per training "
          "point")
      ->group(group);
}

void add_time_options(CLI::App& command, Settings& settings) {
  command
      .add_option("--hours", settings.plan.hours,
                  "begin no batch later than this after the start (default: no end)")
      ->check(hours_complaint)
      ->group("Adaptive sampling");
  command
      .add_option("--budget", settings.execution.budget,
                  "wall time of this command, such as 90s, 30min, 2h or 1d: no run is begun that would end "
                  "later; the report comes then, and says what is left out (default: no end)")
      ->check(budget_complaint);
}

void add_execution_options(CLI::App& command, Settings& settings) {
  command
      .add_option("--jobs", settings.execution.jobs,
                  "processes at a time (default: one per core; with --slurm: tasks at a time, as many as the "
                  "cluster gives)")
      ->check(CLI::Range(1, 4096));
  command
      .add_option("--time-limit", settings.execution.time_limit,
                  "seconds after which a run is stopped and counts as failed; 0: none")
      ->check(seconds_complaint)
      ->capture_default_str();
  command.add_flag("--retry-failed", settings.execution.retry_failed, "make the failed runs again");
  command.add_flag("--keep-going", settings.execution.keep_going,
                   "go on though the first five runs of the study all fail alike");
  command.add_flag("!--no-spot-check", settings.execution.spot_check,
                   "do not make one run again, on resume, to see that the simulator is the same");
  const std::string group = "On a Slurm cluster";
  auto* slurm =
      command
          .add_flag(
              "--slurm", settings.execution.slurm,
              "make the runs as tasks of job arrays; program and folder must have the same names on all "
              "nodes. Ctrl-C leaves the tasks running, and the same command takes them over")
          ->group(group);
  command
      .add_option(
          "--slurm-option", settings.execution.slurm_options,
          "a word for sbatch, such as --slurm-option=--partition=short; repeatable. SBATCH_*, SQUEUE_*, "
          "SCANCEL_* and SACCT_* of the environment are not followed")
      ->needs(slurm)
      ->group(group);
  command
      .add_option(
          "--slurm-array", settings.execution.slurm_array,
          "tasks of one job array at most (default: as many as Slurm takes, up to 1000; half where it "
          "refuses them)")
      ->needs(slurm)
      ->check(CLI::Range(1, 1'000'000))
      ->group(group);
}

void add_confirm_options(CLI::App& command, ConfirmSettings& settings, const doe::Problem& problem) {
  command
      .add_option(
          "--points", settings.points,
          "points of the front per round: the recommended one, the best of each objective, the balanced "
          "one, knees, then others far apart; with --x also 0")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  command
      .add_option("--rounds", settings.rounds,
                  "at most in this command; after each the models are fitted and the front is searched again")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command.add_option("--x", settings.x, "a point of your own besides: " + names_of(problem) + "; repeatable")
      ->delimiter(',');
}

}  // namespace drawpoint::studies
