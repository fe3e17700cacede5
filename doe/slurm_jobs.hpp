// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Processes on the nodes of an existing Slurm cluster, as tasks of job arrays.
///
/// Like ProcessPool (processes.hpp): processes are started, and wait() gives their ends, with the reply that
/// each wrote to file descriptor 3. What differs is where they run, and that they outlive the one who
/// started them.
///
/// Tasks and the caller know of each other by files in `folder`, which all nodes must reach under the same
/// name, as they must the programs and where these write; nothing else is needed, no accounting and no
/// database. A reply appears complete or not at all. A task that ends without one is submitted again: its
/// node was lost, or something with more right took it (NODE_FAIL, BOOT_FAIL, PREEMPTED), or Slurm knows no
/// more of it. One that was cancelled, ran out of memory or out of the time that Slurm gives has failed. A
/// reply counts however late it comes, that of an earlier submission, too. Where Slurm refuses an array, as
/// beyond a limit on jobs submitted, half of it is tried. Variables of the environment that change what its
/// commands do (SBATCH_*, SQUEUE_*, SCANCEL_*, SACCT_*) are not followed: `options` say what is meant.
///
/// If the caller dies, or goes, tasks run on. Whoever then makes a SlurmJobs of the same folder and starts
/// the same processes (id, words, output, time limit) gets their ends and no second task; an array of which
/// it has started nothing by the first wait() is cancelled. Two at a time must not use one folder. A task is
/// one core unless `options` say else, with one thread (OMP_NUM_THREADS and its like are 1), nothing on
/// standard input, and the caller's working directory and environment. Linux only.

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/slurm_commands.hpp>
#include <drawpoint/doe/detail/task_files.hpp>
#include <drawpoint/doe/detail/task_folder.hpp>
#include <drawpoint/doe/processes.hpp>

namespace drawpoint::doe {

struct SlurmOptions {
  std::filesystem::path folder = {};  ///< shared by all nodes; made where it is not there, empty at the end
  int at_once = 0;                    ///< tasks at a time; 0: as many as the cluster gives
  int per_array = 0;                  ///< tasks of one job array; 0: as many as Slurm takes, up to 1000
  std::vector<std::string> options = {};  ///< words for sbatch, such as "--partition=short", "--mem=2G"
  int submissions = 3;                    ///< of one task, before it counts as failed
  double poll = 5.0;                      ///< [s] between two questions to Slurm
  /// [s] that a reply may take to be seen here after the task has ended: file systems on a net cache.
  double reply_delay = 60.0;
  double out_of_reach = 600.0;  ///< [s] that Slurm may not answer before that is an error
};

class SlurmJobs {
 public:
  /// Throws std::invalid_argument for options out of range, std::runtime_error where there is no Slurm or no
  /// folder.
  explicit SlurmJobs(SlurmOptions options)
      : options_(checked(std::move(options))),
        most_tasks_(most_tasks(options_.per_array)),
        tasks_now_(most_tasks_),
        folder_(options_.folder),
        earlier_(folder_.take_over()) {}
  SlurmJobs(const SlurmJobs&) = delete;
  SlurmJobs& operator=(const SlurmJobs&) = delete;

  /// Takes a process on; the next wait() submits it.
  void start(const Process& process) {
    Task task{process, detail::script_of(process)};
    if (const auto found = earlier_.find(task.script); found != earlier_.end()) {
      task.place = found->second;
      earlier_.erase(found);
      accepted_ = true;  // then, by Slurm
    } else {
      queue_.push_back(process.id);
    }
    tasks_.emplace(process.id, std::move(task));
  }

  static constexpr bool full() { return false; }  ///< what the cluster has no room for waits here
  int running() const { return static_cast<int>(tasks_.size()); }  ///< started, and not yet ended

  /// Ends that came since the last call, in order of id; waits at most `patience` for the first one. Returns
  /// early, maybe with nothing, when a signal arrives. What the last call gave is taken as dealt with: its
  /// files are removed. Throws std::runtime_error when Slurm refuses the first array, or does not answer.
  std::vector<ProcessEnd> wait(std::chrono::milliseconds patience) {
    forget();
    cancel_earlier();
    submit();
    const auto deadline = Clock::now() + patience;
    std::vector<ProcessEnd> ends = collect();
    while (ends.empty() && !tasks_.empty()) {
      if (Clock::now() >= next_question_) ends = ask();
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
      if (!ends.empty() || left.count() <= 0) break;
      if (::poll(nullptr, 0, static_cast<int>(std::min<std::int64_t>(left.count(), 100))) != 0) break;
      ends = collect();
    }
    std::sort(ends.begin(), ends.end(), [](const ProcessEnd& a, const ProcessEnd& b) { return a.id < b.id; });
    return ends;
  }

  /// The end of this process, given by the last wait(), does not count: whoever starts it again gets a new
  /// one.
  void discard(std::int64_t id) {
    if (const auto found = given_.find(id); found != given_.end()) folder_.remove(found->second);
  }

  /// Removes the files of ends that have been given, and of arrays without others: the caller has dealt with
  /// them.
  void forget() {
    for (const auto& [id, place] : std::exchange(given_, {})) folder_.remove(place);
    std::set<std::string> needed;
    for (const auto& [id, task] : tasks_) {
      needed.insert(task.place.array);
      for (const Place& place : task.former) needed.insert(place.array);
    }
    for (const auto& [script, place] : earlier_) needed.insert(place.array);
    const std::set<std::string> arrays = folder_.arrays();
    for (const std::string& array : arrays)
      if (!needed.contains(array)) folder_.remove(array);
  }

  /// Cancels all that still runs or waits; its ends are dropped.
  void cancel() {
    for (const std::string& array : arrays()) detail::cancel_array(array);
    tasks_.clear();
    queue_.clear();
    earlier_.clear();
    forget();
  }

  /// Names of the job arrays, as in squeue --name and scancel --name.
  const std::set<std::string>& arrays() const { return folder_.arrays(); }

  /// Where the tasks stand, as Slurm last said: "3 at work, 40 waiting (Resources)", with the most frequent
  /// reason for waiting in Slurm's words, if it has looked for one; empty before the first answer, and while none
  /// waits.
  std::string standing() const {
    int waiting = 0, at_work = 0;
    std::map<std::string, int> reasons;
    for (const auto& [id, task] : tasks_) {
      const auto found = states_.find({task.place.array, task.place.index});
      if (found == states_.end()) continue;
      at_work += found->second.state == "RUNNING";
      if (found->second.state != "PENDING") continue;
      ++waiting;
      if (found->second.reason != "None") ++reasons[found->second.reason];
    }
    if (waiting == 0) return "";
    const std::string text = std::to_string(at_work) + " at work, " + std::to_string(waiting) + " waiting";
    if (reasons.empty()) return text;
    const auto often = std::max_element(reasons.begin(), reasons.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
    return text + " (" + often->first + ")";
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Place = detail::TaskPlace;

  struct Task {
    Process process;
    std::string script;
    Place place = {};                                    // no array: not submitted
    std::vector<Place> former = {};                      // of submissions before, whose replies still count
    int submissions = 0;                                 // by this object
    Clock::time_point ended = Clock::time_point::max();  // first seen without a reply
  };

  static SlurmOptions checked(SlurmOptions options) {
    const auto reject = [](const std::string& what) {
      throw std::invalid_argument("doe::SlurmJobs: " + what);
    };
    if (options.folder.empty()) reject("no folder; name one that all nodes reach");
    if (options.at_once < 0)
      reject("at_once is " + std::to_string(options.at_once) + "; allowed is 0 or more");
    if (options.per_array < 0)
      reject("per_array is " + std::to_string(options.per_array) + "; allowed is 0 or more");
    if (options.submissions < 1)
      reject("submissions is " + std::to_string(options.submissions) + "; allowed is 1 or more");
    const auto reject_clusters = [&](const std::string& word) {
      reject(word +
             " is for sbatch alone, and squeue would not find the tasks; set SLURM_CLUSTERS, which all "
             "commands of Slurm follow");
    };
    for (const std::string& word : options.options)
      if (word.starts_with("-M") || word.starts_with("--clusters")) reject_clusters(word);
    if (!(options.poll > 0.0)) reject("poll is " + std::to_string(options.poll) + " s; allowed is above 0 s");
    return options;
  }

  static int most_tasks(int wanted) {
    try {
      const int most = std::min(detail::most_tasks_per_array(), 1000);
      return wanted > 0 ? std::min(most, wanted) : most;
    } catch (const detail::SlurmError& e) {
      throw std::runtime_error(std::string("doe::SlurmJobs: there is no Slurm cluster here: ") + e.what());
    }
  }

  void cancel_earlier() {
    std::set<std::string> arrays;
    for (const auto& [script, place] : std::exchange(earlier_, {})) arrays.insert(place.array);
    for (const auto& [id, task] : tasks_) arrays.erase(task.place.array);
    if (arrays.empty()) return;
    for (const std::string& array : arrays) detail::cancel_array(array);
    detail::await_end(arrays);
    forget();
  }

  int with_slurm() const { return running() - static_cast<int>(queue_.size()); }

  /// Submits as many arrays as there is room for; one at a time where the tasks at a time have a bound, which Slurm
  /// keeps for one array alone.
  void submit() {
    constexpr int most_waiting = 2000;  // with Slurm at a time: queues of clusters have bounds
    if (Clock::now() < next_submission_) return;
    while (!queue_.empty()) {
      const int count = std::min(static_cast<int>(queue_.size()), tasks_now_);
      if (with_slurm() > 0 && (options_.at_once > 0 || with_slurm() + count > most_waiting)) return;
      const std::vector<std::int64_t> ids(queue_.begin(), queue_.begin() + count);
      if (submit(ids)) {
        queue_.erase(queue_.begin(), queue_.begin() + count);
        tasks_now_ = std::min(2 * tasks_now_, most_tasks_);
      } else if (count > 1) {
        tasks_now_ = count / 2;
      } else {
        next_submission_ = Clock::now() + seconds(options_.poll);
        return;
      }
    }
  }

  /// Not one task is taken: a limit while others of ours are there, or trouble that is borne for a while.
  void bear_refusal(const detail::SlurmError& error) {
    if (with_slurm() > 0) {
      refused_ = Clock::time_point::max();
      return;
    }
    if (accepted_) return bear(error, refused_);
    std::string ignored;
    for (const std::string& name : detail::slurm_variables()) ignored += (ignored.empty() ? "" : ", ") + name;
    throw std::runtime_error(
        std::string("doe::SlurmJobs: Slurm takes no job: ") + error.what() +
        (ignored.empty() ? "" : "; not followed is what the environment says: " + ignored));
  }

  /// Whether Slurm has, or may have, taken the array.
  bool submit(const std::vector<std::int64_t>& ids) {
    std::vector<std::string> scripts;
    for (const std::int64_t id : ids) scripts.push_back(tasks_.at(id).script);
    const std::string array = folder_.write(scripts);
    try {
      detail::submit_array(array, folder_.script_of_all(array), static_cast<int>(ids.size()),
                           options_.at_once, options_.options);
    } catch (const detail::SlurmError& e) {
      if (detail::is_cancelled(array)) {
        folder_.remove(array);
        if (ids.size() == 1) bear_refusal(e);
        return false;
      }  // it may have taken the array all the same: squeue will tell
    }
    refused_ = Clock::time_point::max();
    accepted_ = true;
    folder_.add(array);
    for (std::size_t k = 0; k < ids.size(); ++k) {
      Task& task = tasks_.at(ids[k]);
      task.place = {array, static_cast<int>(k)};
      task.ended = Clock::time_point::max();
      ++task.submissions;
    }
    return true;
  }

  std::map<Place, std::int64_t> ids_by_place() const {
    std::map<Place, std::int64_t> ids;
    for (const auto& [id, task] : tasks_) {
      if (!task.place.array.empty()) ids[task.place] = id;
      for (const Place& place : task.former) ids[place] = id;
    }
    return ids;
  }

  /// Those whose replies are there.
  std::vector<ProcessEnd> collect() {
    const std::map<Place, std::int64_t> ids = ids_by_place();
    std::set<Place> wanted;
    for (const auto& [place, id] : ids) wanted.insert(place);
    std::vector<ProcessEnd> ends;
    for (const auto& [place, text] : folder_.replies_of(wanted)) {
      const std::int64_t id = ids.at(place);
      if (!tasks_.contains(id)) continue;  // another submission has replied, too
      const Process& process = tasks_.at(id).process;
      const std::optional<ProcessEnd> end = detail::end_in(text, process);
      if (!end) continue;  // not all of it is seen yet
      detail::remove_if_empty(process.output);
      ends.push_back(*end);
      given_[id] = place;
      std::erase(queue_, id);  // where it was about to be submitted again
      tasks_.erase(id);
    }
    return ends;
  }

  /// Asks Slurm for the tasks without a reply. Those that have failed; lost ones are queued again.
  std::vector<ProcessEnd> ask() {
    next_question_ = Clock::now() + seconds(options_.poll);
    if (arrays().empty()) return {};
    try {
      states_ = detail::task_states({arrays().begin(), arrays().end()});
      unanswered_ = Clock::time_point::max();
    } catch (const detail::SlurmError& e) {
      bear(e, unanswered_);
      return {};
    }
    std::vector<ProcessEnd> ends = collect();  // what ended before Slurm was asked and after the last look
    for (const std::int64_t id : ids_in_order()) {
      Task& task = tasks_.at(id);
      if (task.place.array.empty()) continue;
      const auto found = states_.find({task.place.array, task.place.index});
      const std::string state = found == states_.end() ? "unknown" : found->second.state;
      if (ended_without_reply(task, state)) judge(task, state, ends);
    }
    for (const ProcessEnd& end : ends) {
      if (const auto task = tasks_.find(end.id); task != tasks_.end()) given_[end.id] = task->second.place;
      tasks_.erase(end.id);
    }
    return ends;
  }

  std::vector<std::int64_t> ids_in_order() const {
    std::vector<std::int64_t> ids;
    for (const auto& [id, task] : tasks_) ids.push_back(id);
    return ids;
  }

  bool ended_without_reply(Task& task, const std::string& state) const {
    const bool may_have_replied = state == "COMPLETED" || state == "FAILED" || state == "unknown";
    if (detail::is_over(state) && !may_have_replied) return true;
    if (!may_have_replied) {
      task.ended = Clock::time_point::max();
      return false;
    }
    task.ended = std::min(task.ended, Clock::now());
    return Clock::now() - task.ended >= seconds(options_.reply_delay);
  }

  void judge(Task& task, const std::string& state, std::vector<ProcessEnd>& ends) {
    static const std::set<std::string> final_word = {"CANCELLED", "TIMEOUT", "DEADLINE", "OUT_OF_MEMORY"};
    const bool of_another_time = task.submissions == 0;  // what became of it then does not count
    if (of_another_time || (!final_word.contains(state) && task.submissions < options_.submissions)) {
      folder_.remove_script(task.place);
      task.former.push_back(task.place);
      task.place = {};
      queue_.push_back(task.process.id);
      return;
    }
    std::string how = "ended without a reply, Slurm's state " + state + detail::meaning_of(state);
    if (task.submissions > 1) how += ", submitted " + std::to_string(task.submissions) + " times";
    ends.push_back({.id = task.process.id, .told = how});
  }

  /// Slurm may be out of reach for a while, as when its controller is restarted.
  void bear(const detail::SlurmError& error, Clock::time_point& since) const {
    since = std::min(since, Clock::now());
    if (Clock::now() - since > seconds(options_.out_of_reach))
      throw std::runtime_error(
          std::string("doe::SlurmJobs: Slurm does not answer, or takes no job: ") + error.what() +
          "; tasks that it has may still run, and their replies are not lost: start the same again later");
  }

  static std::chrono::milliseconds seconds(double s) {
    return std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * std::min(s, 1e9)));
  }

  SlurmOptions options_;
  int most_tasks_;  // of one array
  int tasks_now_;   // of the next array: less after Slurm has refused one
  detail::TaskFolder folder_;
  std::map<std::string, Place> earlier_;  // by script
  std::map<std::int64_t, Task> tasks_;
  std::deque<std::int64_t> queue_;  // tasks to submit
  detail::TaskStates states_;       // as last asked for
  bool accepted_ = false;           // an array of this object, by Slurm
  Clock::time_point next_question_ = Clock::now() + seconds(options_.poll);
  Clock::time_point next_submission_ = Clock::now();
  Clock::time_point unanswered_ = Clock::time_point::max();  // since when; of squeue
  Clock::time_point refused_ = Clock::time_point::max();     // since when; of sbatch
  std::map<std::int64_t, Place> given_;                      // ends of the last wait()
};

}  // namespace drawpoint::doe
