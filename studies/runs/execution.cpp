// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/runs/execution.h>
#include <drawpoint/studies/runs/interrupt.h>
#include <drawpoint/studies/runs/progress.h>
#include <drawpoint/studies/runs/workers.h>
#include <drawpoint/studies/store/run_logs.h>
#include <drawpoint/studies/store/shared_files.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <deque>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::milliseconds;

constexpr milliseconds patience(100);  // between two looks at signals, time limits and progress

/// The program's own file. The link in /proc works even when a rebuild has replaced the file; the real name
/// looks better in `ps`.
std::string own_executable() {
  const fs::path link = "/proc/self/exe";
  std::error_code error;
  const fs::path name = fs::read_symlink(link, error);
  return !error && fs::equivalent(name, link, error) ? name.string() : link.string();
}

/// A task on another machine knows no /proc of this process.
void require_own_file() {
  if (own_executable().starts_with("/proc/"))
    throw std::runtime_error(
        "studies: this program's file was replaced or removed since it started, and Slurm's tasks need it; "
        "give "
        "the same command again");
}

std::string joined(const Eigen::VectorXd& x) {
  std::string text;
  for (const double value : x) {
    char number[32];
    std::snprintf(number, sizeof number, "%.17g", value);
    if (!text.empty()) text += ',';
    text += number;
  }
  return text;
}

/// The words of a child's command line, with those of the study before them and its options behind.
std::vector<std::string> whole_line(std::vector<std::string> leading, const std::vector<std::string>& words,
                                    const OptionValues& options) {
  leading.insert(leading.end(), words.begin(), words.end());
  for (const auto& [name, value] : options) leading.push_back("--" + name + "=" + value);
  return leading;
}

/// Equal runs are equal processes, wherever the command is given: names of files are whole.
doe::Process process_for(const Run& run, const Folder& given, const OptionValues& options,
                         const Settings& settings) {
  const Folder folder{fs::absolute(given.path)};
  return {.id = run.id,
          .executable = own_executable(),
          .arguments = whole_line(settings.leading_words,
                                  {"evaluate", "--x=" + joined(run.x), "--seed=" + std::to_string(run.seed),
                                   "--log=" + folder.unfinished_log(run.id).string(),
                                   "--shared=" + folder.shared().string(), "--result-descriptor=3"},
                                  options),
          .output = folder.printed(run.id),
          .time_limit = settings.time_limit};
}

/// The log gets its final name before the run counts as done, so that each run that is done has its log, and
/// keeps the other one until then: who dies between leaves it for the next to publish. Returns its checksum;
/// empty: there is none.
std::string publish_log(const Folder& folder, const Settings& settings, std::int64_t id) {
  std::error_code ignored;
  fs::remove(folder.log(id), ignored);  // of an attempt that did not count
  if (!fs::exists(folder.unfinished_log(id), ignored)) return "";
  try {
    if (settings.finish_log) settings.finish_log(folder.unfinished_log(id));
  } catch (const std::exception&) {  // the run stands without the rest of its log
  }
  const std::string checksum = file_checksum(folder.unfinished_log(id));
  link_or_copy(folder.unfinished_log(id), folder.log(id));
  return checksum;
}

void drop_unfinished_log(const Folder& folder, std::int64_t id) {
  std::error_code ignored;
  fs::remove(folder.unfinished_log(id), ignored);
}

[[noreturn]] void stop_for_full_disk(const Folder& folder) {
  throw std::runtime_error(
      "studies: the disk of " + folder.path.string() +
      " is full; free some space and give the same command again; finished runs are kept");
}

bool disk_is_full(const Folder& folder) { return free_space(folder.path) < least_free_space; }

/// True if the run failed.
bool store_end(Store& store, const Folder& folder, const Settings& settings, Workers& workers,
               const doe::ProcessEnd& end) {
  const doe::Outcome outcome = outcome_of(end, folder.printed(end.id));
  if (outcome.failed() && disk_is_full(folder)) {
    drop_unfinished_log(folder, end.id);  // leaves the store room for the next line
    store.mark_planned(end.id);
    workers.discard(end.id);
    stop_for_full_disk(folder);
  }
  const std::string log = publish_log(folder, settings, end.id);
  if (outcome.failed()) {
    store.save_failed(end.id, outcome.reason(), end.seconds, log);
  } else {
    store.save_done(end.id, outcome.values(), end.seconds, log);
  }
  drop_unfinished_log(folder, end.id);
  return outcome.failed();
}

/// Those of runs that were not ended together with this process. (Slurm's tasks have signals of their own.)
std::vector<doe::ProcessEnd> ends_of_runs(Workers& workers, const Settings& settings) {
  std::vector<doe::ProcessEnd> ends = workers.wait(patience);
  const bool stopped = !settings.slurm && std::any_of(ends.begin(), ends.end(), ended_by_stop_signal);
  if (stopped && soon(InterruptGuard::requested)) std::erase_if(ends, ended_by_stop_signal);
  return ends;
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
       .arguments = whole_line(study.leading_words,
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
  const std::vector<Run> runs = store.runs();
  std::deque<const Run*> waiting;
  for (const auto& run : runs) {
    if (run.status == Status::planned) waiting.push_back(&run);
  }
  if (InterruptGuard::requested()) throw Interrupted{};
  if (waiting.empty()) return;
  if (settings.slurm) {
    require_own_file();
    dprintf(message_descriptor, "%zu runs go to Slurm\n", waiting.size());
  }
  const std::unique_ptr<Workers> workers = workers_for(folder, settings);
  Progress progress(message_descriptor, state_of(runs));
  while (!waiting.empty() || workers->running() > 0 || InterruptGuard::requested()) {
    if (InterruptGuard::requested()) {
      workers->leave();
      store.plan_again(false);
      throw Interrupted{};
    }
    const bool full = !waiting.empty() && disk_is_full(folder);
    if (full && workers->running() == 0) stop_for_full_disk(folder);
    while (!full && !waiting.empty() && !workers->full()) {
      store.mark_running(waiting.front()->id);
      workers->start(process_for(*waiting.front(), folder, store.identity().options, settings));
      waiting.pop_front();
    }
    for (const auto& end : ends_of_runs(*workers, settings))
      progress.finished_one(store_end(store, folder, settings, *workers, end));
    progress.tick(workers->standing());
  }
  workers->finish();
  std::error_code ignored;
  fs::remove_all(folder.unfinished(), ignored);  // with what processes that were killed have left
}

std::string reply_text(const doe::Outcome& outcome) {
  if (outcome.failed())
    return json{{"failure", outcome.reason()}}.dump(-1, ' ', false, json::error_handler_t::replace);
  const Eigen::VectorXd& y = outcome.values();
  return json{{"values", std::vector<double>(y.begin(), y.end())}}.dump();
}

doe::Outcome outcome_of(const doe::ProcessEnd& end, const fs::path& printed) {
  const json reply = json::parse(end.reply, nullptr, false);
  if (reply.is_object() && reply.contains("failure"))
    return doe::Failure{reply["failure"].get<std::string>()};
  if (reply.is_object() && reply.contains("values") && !end.timed_out) {
    const auto values = reply["values"].get<std::vector<double>>();
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  }
  std::string reason = "the run's process " + doe::describe(end);
  std::error_code ignored;
  if (fs::exists(printed, ignored)) reason += "; it printed logs/" + printed.filename().string();
  return doe::Failure{reason};
}

}  // namespace drawpoint::studies
