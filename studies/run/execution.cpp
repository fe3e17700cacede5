// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/execution.h>
#include <drawpoint/studies/run/first_failures.h>
#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/progress.h>
#include <drawpoint/studies/run/run_files.h>
#include <drawpoint/studies/run/run_process.h>
#include <drawpoint/studies/run/store/shared_files.h>
#include <drawpoint/studies/run/workers.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr milliseconds patience(100);  // between two looks at signals, time limits and progress

[[noreturn]] void stop_for_full_disk(const Folder& folder) {
  throw std::runtime_error(
      "studies: the disk of " + folder.path.string() +
      " is full; free some space and give the same command again; finished runs are kept");
}

bool disk_is_full(const Folder& folder) { return free_space(folder.path) < least_free_space; }

/// The run is made again by whoever goes on.
void take_back(Store& store, const Folder& folder, Workers& workers, std::int64_t id) {
  drop_logs(folder, id);  // leaves the store room for the next line
  store.mark_planned(id);
  workers.discard(id);
}

[[noreturn]] void stop_unstarted(Store& store, Workers& workers, std::int64_t id, const std::string& reason) {
  workers.abandon();
  store.plan_again(false);
  throw std::runtime_error(
      "studies: no run can be made: run " + std::to_string(id) + ": " + reason +
      ". Mend it and give the same command again; finished runs are kept, and the command "
      "check tries one run");
}

[[noreturn]] void stop_alike(Store& store, Workers& workers, const FirstFailures& first) {
  workers.abandon();
  store.plan_again(false);
  throw std::runtime_error(
      "studies: the first " + std::to_string(FirstFailures::few) +
      " runs all failed alike: " + first.reason() +
      ". Nothing more is started; the command check makes one run and shows all of it. When it is mended "
      "give "
      "the same command with --retry-failed; where failures are what the study is about, with --keep-going");
}

/// The outcome, and the log's checksum where there is one; a log that is none fails the run.
doe::Outcome with_log(const Folder& folder, const Settings& settings, std::int64_t id, doe::Outcome outcome,
                      std::string& log) {
  try {
    log = publish_log(folder, settings, id);
    return outcome;
  } catch (const std::exception& e) {
    return doe::Failure{std::string("what it left cannot be kept: ") + e.what()};
  }
}

doe::Outcome of_this_many(const doe::Outcome& outcome, std::size_t responses) {
  if (outcome.failed() || outcome.values().size() == static_cast<Eigen::Index>(responses)) return outcome;
  return doe::Failure{"the run's process gave " + std::to_string(outcome.values().size()) + " values for " +
                      std::to_string(responses) + " responses"};
}

/// Stores the end of a run; what it was.
doe::Outcome store_end(Store& store, const Folder& folder, const Settings& settings, Workers& workers,
                       const doe::ProcessEnd& end) {
  const RunEnd ended = run_end(end, folder.printed(end.id));
  if (ended.not_started) {
    take_back(store, folder, workers, end.id);
    stop_unstarted(store, workers, end.id, ended.outcome.reason());
  }
  const auto stop_if_full = [&](const doe::Outcome& outcome) {
    if (!outcome.failed() || !disk_is_full(folder)) return;
    take_back(store, folder, workers, end.id);
    stop_for_full_disk(folder);
  };
  stop_if_full(ended.outcome);
  std::string log;
  const doe::Outcome outcome = with_log(
      folder, settings, end.id, of_this_many(ended.outcome, store.identity().problem.responses.size()), log);
  stop_if_full(outcome);
  if (outcome.failed()) {
    store.save_failed(end.id, outcome.reason(), end.seconds, log);
  } else {
    store.save_done(end.id, outcome.values(), end.seconds, log);
  }
  drop_unfinished_log(folder, end.id);
  return outcome;
}

bool was_made(const Run& run) { return run.status == Status::done && run.kind != Kind::imported; }

/// Those of runs that were not ended together with this process. (Slurm's tasks have signals of their own.)
std::vector<doe::ProcessEnd> ends_of_runs(Workers& workers, const Settings& settings) {
  std::vector<doe::ProcessEnd> ends = workers.wait(patience);
  const bool stopped =
      !settings.execution.slurm && std::any_of(ends.begin(), ends.end(), ended_by_stop_signal);
  if (stopped && soon(InterruptGuard::requested)) std::erase_if(ends, ended_by_stop_signal);
  return ends;
}

/// As many as the workers take.
void start_some(std::deque<const Run*>& waiting, Store& store, const Folder& folder, const Settings& settings,
                Workers& workers) {
  while (!waiting.empty() && !workers.full()) {
    const std::int64_t id = waiting.front()->id;
    store.mark_running(id);  // which finds out where the folder was moved
    make_way(folder, id);
    if (!workers.start(process_of_run(*waiting.front(), folder, store.identity().options, settings))) {
      store.mark_planned(id);
      return;
    }
    waiting.pop_front();
  }
}

/// Wherever the budget ends, as large a share of the validation points is made as of the others.
void share_out(std::deque<const Run*>& waiting, const std::vector<Run>& runs) {
  const double validation = count_points(runs, Kind::validation),
               others = std::max(count_points(runs, Kind::training), count_points(runs, Kind::adaptive));
  const auto share = [&](const Run* run) {
    return static_cast<double>(run->point) / (run->kind == Kind::validation ? validation : others);
  };
  std::stable_sort(waiting.begin(), waiting.end(),
                   [&](const Run* a, const Run* b) { return share(a) < share(b); });
}

ProgressState state_of(const std::vector<Run>& runs) {
  ProgressState state;
  state.total = static_cast<int>(runs.size());
  for (const auto& run : runs) {
    if (has_ended(run)) ++state.done;
    if (run.status == Status::failed) ++state.failed;
  }
  return state;
}

}  // namespace

void prepare_shared(const Study& study, const OptionValues& options, const Folder& folder,
                    int message_descriptor) {
  if (!study.prepare) return;
  if (fs::exists(folder.shared())) return check_shared(folder);
  dprintf(message_descriptor, "preparing what all runs share ...\n");
  const fs::path draft = folder.path / "shared.unfinished";
  const fs::path printed = folder.logs() / "prepare.txt";
  fs::remove_all(draft);
  fs::create_directory(draft);
  doe::ProcessPool pool(1);
  pool.start(
      {.executable = own_executable(),
       .arguments = whole_line(study.simulator.leading_words,
                               {"prepare", "--shared=" + draft.string(), "--result-descriptor=3"}, options),
       .output = printed});
  std::vector<doe::ProcessEnd> ends;
  while (ends.empty()) {
    if (InterruptGuard::requested()) {
      pool.terminate(time_to_end);
      throw Interrupted{};
    }
    ends = pool.wait(patience);
  }
  if (ended_by_stop_signal(ends.front()) && soon(InterruptGuard::requested)) throw Interrupted{};
  const doe::Outcome outcome = outcome_of(ends.front(), printed);
  if (outcome.failed()) {
    if (disk_is_full(folder)) stop_for_full_disk(folder);
    throw std::runtime_error("studies: the preparation failed: " + outcome.reason());
  }
  remember_shared(folder, draft);
  fs::rename(draft, folder.shared());
  dprintf(message_descriptor, "prepared in %s\n", duration_text(ends.front().seconds).c_str());
}

void carry_out_runs(Store& store, const Folder& folder, const Settings& settings, int message_descriptor) {
  Budget endless;
  carry_out_runs(store, folder, settings, message_descriptor, endless);
}

int carry_out_runs(Store& store, const Folder& folder, const Settings& settings, int message_descriptor,
                   Budget& budget) {
  const std::vector<Run> runs = store.runs();
  std::deque<const Run*> waiting;
  for (const auto& run : runs) {
    if (run.status == Status::planned) waiting.push_back(&run);
  }
  if (InterruptGuard::requested()) throw Interrupted{};
  if (waiting.empty()) return 0;
  if (!budget.text().empty()) share_out(waiting, runs);
  if (settings.execution.slurm) {
    require_own_file();
    dprintf(message_descriptor, "%zu runs go to Slurm\n", waiting.size());
  }
  const std::unique_ptr<Workers> workers = workers_for(folder, settings, message_descriptor);
  Progress progress(message_descriptor, state_of(runs));
  int left_out = 0;
  FirstFailures first(settings.execution.keep_going || std::any_of(runs.begin(), runs.end(), was_made));
  while (!waiting.empty() || workers->running() > 0 || InterruptGuard::requested()) {
    if (InterruptGuard::requested()) {
      workers->leave();
      store.plan_again(false);
      throw Interrupted{};
    }
    if (settings.execution.slurm && budget.seconds_left() <= 0.0) {
      workers->leave();
      store.plan_again(false);
      return static_cast<int>(waiting.size()) + workers->running();
    }
    if (!waiting.empty() && !budget.has_room()) {
      left_out = static_cast<int>(waiting.size());
      waiting.clear();
    }
    const bool full = !waiting.empty() && disk_is_full(folder);
    if (full && workers->running() == 0) stop_for_full_disk(folder);
    if (!full) start_some(waiting, store, folder, settings, *workers);
    for (const auto& end : ends_of_runs(*workers, settings)) {
      const doe::Outcome outcome = store_end(store, folder, settings, *workers, end);
      budget.run_ended(end.seconds);
      outcome.failed() ? first.failed(outcome.reason()) : first.done();
      progress.finished_one(outcome.failed());
    }
    if (first.all_alike() && !waiting.empty()) stop_alike(store, *workers, first);
    progress.tick(workers->standing());
  }
  workers->finish();
  std::error_code ignored;
  fs::remove_all(folder.unfinished(), ignored);  // with what processes that were killed have left
  return left_out;
}

}  // namespace drawpoint::studies
