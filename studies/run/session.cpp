// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/points/imported_points.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/option_values.h>
#include <drawpoint/doe/detail/task_files.hpp>
#include <drawpoint/studies/external_program.hpp>

#include <optional>
#include <stdexcept>
#include <string>

namespace drawpoint::studies {
namespace {

[[noreturn]] void refuse_folder(const Folder& folder, const std::string& difference) {
  throw UsageError("studies: " + folder.path.string() + " holds another study: " + difference +
                   "; choose another folder with --out, or move this one away");
}

/// The options of responses that the folder has other values of than the study, as they are typed.
std::string response_options(const Study& study, const OptionValues& stored) {
  std::string text;
  for (const StudyOption& option : study.options) {
    const auto value = stored.find(option.name);
    if (option.of_responses && value != stored.end() && value->second != option.value)
      text += " --" + option.name + "=" + doe::detail::quoted_for_shell(value->second);
  }
  return text;
}

/// More runs would have responses that those of the folder lack.
[[noreturn]] void refuse_earlier(const Study& study, const Folder& folder, const OptionValues& stored) {
  std::string how = "begin another folder with --out";
  if (study.logs.responses)
    how = "take them from the logs with rerun-responses --from " +
          doe::detail::quoted_for_shell(folder.path.string()) + response_options(study, stored) +
          " --out NEW, and go on in NEW, or " + how;
  throw UsageError("studies: " + folder.path.string() +
                   " was begun before the study had its last responses, " +
                   study.problem.responses.back().name + " among them; " + how +
                   ". report, front and the other commands that read take the folder as it is");
}

void require_same_options(const Identity& stored, const Settings& settings, const Folder& folder) {
  if (settings.plan.seed && *settings.plan.seed != stored.seed) {
    refuse_folder(folder, "seed " + std::to_string(stored.seed) + " there, " +
                              std::to_string(*settings.plan.seed) + " here");
  }
  if (settings.plan.replicates && *settings.plan.replicates != stored.replicates) {
    refuse_folder(folder, "replicates " + std::to_string(stored.replicates) + " there, " +
                              std::to_string(*settings.plan.replicates) + " here");
  }
  const std::string other = difference(stored.options, settings.options, true);
  if (!other.empty()) refuse_folder(folder, other);
}

/// A study whose store was lost would be made anew over what is left of it.
void require_no_logs(const Folder& folder) {
  if (!std::filesystem::is_directory(folder.logs())) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder.logs())) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("run_"))
      throw UsageError("studies: " + folder.path.string() + " has logs of runs, such as " + name +
                       ", and no study.db: a new study would write over them. Bring study.db back, move the "
                       "folder logs away, or give another --out");
  }
}

Store new_store(const Study& study, const Folder& folder, const Settings& settings) {
  require_no_logs(folder);
  const int runs = settings.plan.runs.value_or(study.defaults.runs);
  return Store::create(folder.store(), {.study = study.name,
                                        .problem = study.problem,
                                        .seed = settings.plan.seed.value_or(1),
                                        .replicates = settings.plan.replicates.value_or(1),
                                        .corners = has_corners(study.problem, runs),
                                        .options = with_defaults(study.options, settings.options),
                                        .simulator = study.simulator.name});
}

void check_target(double target, const std::string& until, int validation) {
  if (validation > 0 || (target <= 0.0 && until.empty())) return;
  throw UsageError(std::string(target > 0.0 ? "--target" : "--until") +
                   ": without a validation run there is no error to reach; give --validation 10 or more");
}

void check_something_to_stop(const Settings& settings, int adaptive) {
  if (settings.plan.until && !settings.plan.until->empty() && adaptive == 0)
    throw UsageError(
        "--until: with --adaptive 0 there are no runs to stop; leave it out, or give the most that may be "
        "made");
}

/// Who names errors to reach, and no number, wants no fixed number of adaptive points, but not endless ones.
constexpr int adaptive_per_training_point = 4;

std::vector<Run> everything(std::vector<Run> existing, const std::vector<Run>& added) {
  existing.insert(existing.end(), added.begin(), added.end());
  return existing;
}

/// Models need two points.
void check_runs(int runs, const std::vector<Run>& all) {
  if (const int imported = count_points(all, Kind::imported); runs + imported < 2)
    throw UsageError("--runs " + std::to_string(runs) + " and " + std::to_string(imported) +
                     " points of --import: allowed is 2 or more together");
}

/// With the points of a table made elsewhere.
void add_imported(const Settings& settings, const doe::Problem& problem, const std::vector<Run>& existing,
                  const std::vector<Correction>& corrections, std::vector<Run>& added) {
  if (settings.plan.imported.empty()) return;
  const std::vector<Run> imported =
      imported_runs(settings.plan.imported, problem, everything(existing, added), corrections);
  added.insert(added.end(), imported.begin(), imported.end());
}

struct Points {
  int training, validation;
};

/// What is given, else what the folder or the study has. Throws UsageError for what cannot be.
Sampling sampling_of(Sampling kept, const Settings& settings, const std::vector<Run>& existing,
                     const Points& points) {
  kept.until = settings.plan.until.value_or(kept.until);
  kept.stopped = {};
  if (settings.plan.until && !kept.until.empty() && kept.points == 0)
    kept.points = adaptive_per_training_point * points.training;
  kept.points = settings.plan.adaptive.value_or(kept.points);
  check_something_to_stop(settings, kept.points);
  kept.batch = settings.plan.batch.value_or(kept.batch);
  kept.criteria = settings.plan.criteria.value_or(kept.criteria);
  kept.target = settings.plan.target.value_or(kept.target);
  refuse_to_shrink(count_points(existing, Kind::adaptive), kept.points, "--adaptive", "adaptive");
  check_target(kept.target, kept.until, points.validation);
  return kept;
}

}  // namespace

namespace {

/// The problem of a store that can be read at once; nothing where there is none.
std::optional<doe::Problem> stored_problem(const Folder& folder) {
  try {
    return Store::open(folder.store(), Access::read).identity().problem;
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

Study as_begun(const Study& study, const Folder& folder) {
  Study then = study;
  const auto stored = stored_problem(folder);
  if (!stored) return then;
  const auto before = before_later_responses(*stored, study.problem);
  if (!before) return then;
  then.problem = *before;
  then.simulator.name += ", with more responses";  // none of its runs can be added
  return then;
}

Store open_store(const Study& study, const Folder& folder, Access access) {
  if (!std::filesystem::exists(folder.store())) {
    throw std::runtime_error(
        "studies: there is no study in " + folder.path.string() +
        " (no file study.db); name its folder with --out, or start one with the command run");
  }
  Store store = Store::open(folder.store(), access);
  const Identity& stored = store.identity();
  if (stored.study != study.name)
    refuse_folder(folder, "name \"" + stored.study + "\" there, \"" + study.name + "\" here");
  if (before_later_responses(stored.problem, study.problem)) refuse_earlier(study, folder, stored.options);
  const std::string text = difference(stored.problem, study.problem);
  if (!text.empty()) refuse_folder(folder, text);
  // Values are the folder's own; only what options there are is the program's.
  const OptionValues options = with_later_ones(study.options, stored.options);
  const std::string other = difference(options, with_defaults(study.options, options), false);
  if (!other.empty()) refuse_folder(folder, other);
  store.complete_options(options);
  return store;
}

Run stored_run(const Store& store, const Folder& folder, std::int64_t id) {
  const std::vector<Run> runs = store.runs();
  if (id < 1 || id > static_cast<std::int64_t>(runs.size()))
    throw UsageError("--run " + std::to_string(id) + ": the study in " + folder.path.string() +
                     " has runs 1 to " + std::to_string(runs.size()));
  return runs[static_cast<std::size_t>(id) - 1];
}

std::string making_command(const Study& study) { return study.black_box ? "run" : "ask"; }

std::string confirming_command(const Study& study) { return study.black_box ? "confirm" : "ask --confirm"; }

std::string out_option(const Folder& folder) {
  return " --out " + doe::detail::quoted_for_shell(folder.path.string());
}

void require_simulator(const Study& study) {
  if (!study.black_box)
    throw UsageError("the study " + study.name +
                     " has no simulator: its runs are made elsewhere; the command ask gives them, tell takes "
                     "what came out");
}

std::string named(const std::string& simulator) {
  return simulator.empty() ? "a simulator without a name" : "\"" + simulator + "\"";
}

void require_same_simulator(const Study& study, const Store& store, const Folder& folder) {
  const std::string& stored = store.identity().simulator;
  if (stored == study.simulator.name || study.simulator.name.starts_with(stored + files_beside_it)) return;
  throw UsageError(
      "studies: the runs of " + folder.path.string() + " were made by " + named(stored) +
      ", and new ones would be by " + named(study.simulator.name) +
      ": one model does not take both. report, front, replay, compare, export and rerun-responses read this "
      "folder as ever; for new runs begin a study with another --out, or take the program as it was when the "
      "folder was made");
}

void check_options(const Study& study, const OptionValues& given) {
  if (!study.options_complaint) return;
  const std::string wrong = study.options_complaint(with_defaults(study.options, given));
  if (!wrong.empty()) throw UsageError(wrong);
}

void check_new_study(const Study& study, const Settings& settings) {
  check_options(study, settings.options);
  std::vector<Run> imported;
  add_imported(settings, study.problem, {}, {}, imported);
  check_runs(settings.plan.runs.value_or(study.defaults.runs), imported);
  check_something_to_stop(settings, settings.plan.adaptive.value_or(1));
  check_target(settings.plan.target.value_or(0.0), settings.plan.until.value_or(""),
               settings.plan.validation.value_or(study.defaults.validation));
}

Store plan_study(const Study& study, const Folder& folder, const Settings& settings) {
  const bool found = std::filesystem::exists(folder.store());
  Store store = found ? open_store(study, folder) : new_store(study, folder, settings);
  require_same_options(store.identity(), settings, folder);
  const std::vector<Run> existing = store.runs();
  const bool resumes = !existing.empty();
  const int runs =
      settings.plan.runs.value_or(resumes ? count_points(existing, Kind::training) : study.defaults.runs);
  const int validation = settings.plan.validation.value_or(resumes ? count_points(existing, Kind::validation)
                                                                   : study.defaults.validation);
  auto added = runs_to_add(store.identity(), existing, runs, validation);
  if (study.simulator.asks_for_chance)
    added = everything(added, run_that_asks_for_chance(store.identity(), existing, added));
  add_imported(settings, study.problem, existing, store.corrections(), added);
  check_runs(runs, everything(existing, added));
  Sampling kept = store.sampling();
  if (!resumes) kept.points = study.defaults.adaptive;
  const Sampling sampling = sampling_of(kept, settings, existing, {runs, validation});
  store.plan_again(settings.execution.retry_failed);
  store.set_sampling(sampling);
  store.add(added);
  return store;
}

}  // namespace drawpoint::studies
