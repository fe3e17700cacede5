// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What is asked of a Slurm cluster, by the commands that its users have: sbatch, squeue, scancel, scontrol.

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <drawpoint/doe/processes.hpp>

namespace drawpoint::doe::detail {

/// A command of Slurm that failed, with its own words.
struct SlurmError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Variables of the environment that would change what a command of Slurm does: an SQUEUE_PARTITION hides
/// tasks, an SBATCH_WAIT has sbatch wait for their end.
inline std::vector<std::string> slurm_variables() {
  constexpr std::string_view prefixes[] = {"SQUEUE_", "SBATCH_", "SCANCEL_", "SACCT_"};
  std::vector<std::string> names;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    const std::string_view name = text.substr(0, text.find('='));
    const bool plain = std::all_of(name.begin(), name.end(),
                                   [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
    if (plain && std::any_of(std::begin(prefixes), std::end(prefixes),
                             [&](std::string_view prefix) { return name.starts_with(prefix); }))
      names.emplace_back(name);
  }
  return names;
}

/// What the command prints, whatever the variables above say. Throws SlurmError when it fails, is not there, or says
/// nothing for a minute.
inline std::string slurm_answer(const std::vector<std::string>& words) {
  std::string clean;
  for (const std::string& name : slurm_variables()) clean += "unset " + name + "; ";
  std::vector<std::string> arguments = {"-c", clean + "exec \"$@\" >&3 2>&3", "sh"};
  arguments.insert(arguments.end(), words.begin(), words.end());
  ProcessPool pool(1);
  pool.start({.executable = "sh", .arguments = std::move(arguments), .time_limit = 60.0});
  std::vector<ProcessEnd> ends;
  while (ends.empty()) ends = pool.wait(std::chrono::milliseconds(100));
  const ProcessEnd& end = ends.front();
  if (!end.timed_out && end.wait_status == 0) return end.reply;
  const std::string said = end.reply.substr(0, end.reply.find_last_not_of(" \n") + 1);
  throw SlurmError(words.front() + " " + describe(end) + (said.empty() ? "" : ": " + said));
}

/// The largest number of tasks in one job array.
inline int most_tasks_per_array() {
  const std::string config = slurm_answer({"scontrol", "show", "config"});
  const std::string name = "MaxArraySize";
  const std::size_t at = config.find(name);
  const std::size_t from = at == config.npos ? at : config.find_first_of("0123456789", at);
  int size = 0;
  if (from != config.npos) std::from_chars(config.data() + from, config.data() + config.size(), size);
  if (size < 2) throw SlurmError("scontrol show config names no MaxArraySize above 1: job arrays are off");
  return size;
}

/// Submits tasks 0 to `tasks` - 1 of the script as one job array, at most `at_once` at a time (0: no bound).
/// `options` are words for sbatch; those that say which array this is come from here.
inline void submit_array(const std::string& name, const std::filesystem::path& script, int tasks, int at_once,
                         const std::vector<std::string>& options) {
  std::vector<std::string> words = {"sbatch"};
  words.insert(words.end(), options.begin(), options.end());
  const std::string bound = at_once > 0 ? "%" + std::to_string(at_once) : "";
  for (const std::string& word :
       {"--job-name=" + name, "--array=0-" + std::to_string(tasks - 1) + bound, std::string("--no-requeue"),
        std::string("--output=/dev/null"), std::string("--error=/dev/null"), script.string()})
    words.push_back(word);
  slurm_answer(words);
}

/// Where a task stands, in Slurm's words, and why it waits.
struct TaskState {
  std::string state, reason;
};

/// The state of each task that Slurm still knows, by array and index; it forgets tasks some minutes after their end.
using TaskStates = std::map<std::pair<std::string, int>, TaskState>;

inline TaskStates task_states(const std::vector<std::string>& arrays) {
  std::string names;
  for (const std::string& name : arrays) names += (names.empty() ? "" : ",") + name;
  const std::string table = slurm_answer(
      {"squeue", "--noheader", "--array", "--states=all", "--name=" + names, "--format=%j %K %T %r"});
  TaskStates states;
  for (std::size_t from = 0, to; (to = table.find('\n', from)) != table.npos; from = to + 1) {
    const std::string line = table.substr(from, to - from);
    const std::size_t first = line.find(' '), second = line.find(' ', first + 1),
                      third = line.find(' ', second + 1);
    int index = 0;
    if (second == line.npos || third == line.npos) continue;  // a warning
    if (std::from_chars(line.data() + first + 1, line.data() + second, index).ptr == line.data() + second)
      states[{line.substr(0, first), index}] = {line.substr(second + 1, third - second - 1),
                                                line.substr(third + 1)};
  }
  return states;
}

inline void cancel_array(const std::string& name) { slurm_answer({"scancel", "--name=" + name}); }

/// Whether it is; sbatch may fail after Slurm has taken the array.
inline bool is_cancelled(const std::string& name) {
  try {
    cancel_array(name);
    return true;
  } catch (const SlurmError&) {
    return false;
  }
}

/// Whether a task in this state neither runs nor will run.
inline bool is_over(const std::string& state) {
  static const std::set<std::string> over = {"COMPLETED", "FAILED",  "NODE_FAIL", "BOOT_FAIL",    "PREEMPTED",
                                             "CANCELLED", "TIMEOUT", "DEADLINE",  "OUT_OF_MEMORY"};
  return over.contains(state);
}

/// Says what a state means in which a task ended without a reply; empty where the state says it.
inline std::string meaning_of(const std::string& state) {
  if (state == "OUT_OF_MEMORY") return ": it needed more memory than Slurm gives it; ask for more with --mem";
  if (state == "TIMEOUT") return ": Slurm's time limit ended it; ask for more with --time";
  if (state == "DEADLINE") return ": its deadline passed";
  if (state == "CANCELLED") return ": somebody cancelled it, as by scancel";
  return "";
}

/// Until no task of these arrays runs, so that two processes of one run are never at work together; for a
/// minute at most: what a node holds beyond that Slurm has given up.
inline void await_end(const std::set<std::string>& arrays) {
  using Clock = std::chrono::steady_clock;
  const auto patience = Clock::now() + std::chrono::seconds(60);
  const auto runs = [](const auto& task) { return !is_over(task.second.state); };
  while (Clock::now() < patience) {
    const TaskStates states = task_states({arrays.begin(), arrays.end()});
    if (std::none_of(states.begin(), states.end(), runs)) return;
    poll(nullptr, 0, 500);
  }
}

}  // namespace drawpoint::doe::detail
