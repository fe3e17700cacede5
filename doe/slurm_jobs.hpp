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
/// more of it. One that was cancelled, ran out of memory or out of the time that Slurm gives has failed.
///
/// If the caller dies, or goes, tasks run on. Whoever then makes a SlurmJobs of the same folder and starts
/// the same processes (id, words, output, time limit) gets their ends and no second task; an array of which
/// it has started nothing by the first wait() is cancelled. Two at a time must not use one folder. A task is
/// one core unless `options` say else, with one thread (OMP_NUM_THREADS and its like are 1), nothing on
/// standard input, and the caller's working directory and environment. Linux only.

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/hash.hpp>
#include <drawpoint/doe/detail/slurm_commands.hpp>
#include <drawpoint/doe/detail/task_files.hpp>
#include <drawpoint/doe/processes.hpp>

namespace drawpoint::doe {

struct SlurmOptions {
  std::filesystem::path folder = {};  ///< shared by all nodes; made where it is not there, empty at the end
  int at_once = 0;                    ///< tasks of an array at a time; 0: as many as the cluster gives
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
  explicit SlurmJobs(SlurmOptions options) : options_(std::move(options)) {
    check();
    options_.folder = std::filesystem::absolute(options_.folder);
    most_tasks_ = most_tasks();
    std::filesystem::create_directories(options_.folder);
    read_earlier();
  }
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
    if (const auto found = given_.find(id); found != given_.end()) remove_files(found->second);
  }

  /// Removes the files of ends that have been given, and of arrays without others: the caller has dealt with
  /// them.
  void forget() {
    for (const auto& [id, place] : std::exchange(given_, {})) remove_files(place);
    std::set<std::string> needed;
    for (const auto& [id, task] : tasks_) needed.insert(task.place.array);
    for (const auto& [script, place] : earlier_) needed.insert(place.array);
    for (auto array = arrays_.begin(); array != arrays_.end();)
      array = needed.contains(*array) ? std::next(array) : remove_files(array);
  }

  /// Cancels all that still runs or waits; its ends are dropped.
  void cancel() {
    for (const std::string& array : arrays_) detail::cancel_array(array);
    tasks_.clear();
    queue_.clear();
    earlier_.clear();
    forget();
  }

  /// Names of the job arrays, as in squeue --name and scancel --name.
  const std::set<std::string>& arrays() const { return arrays_; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr const char* own_prefix = "drawpoint-";
  static constexpr const char* unfinished = ".unfinished";

  struct Place {
    std::string array;
    int index = 0;
    auto operator<=>(const Place&) const = default;
  };
  struct Task {
    Process process;
    std::string script;
    Place place = {};                                    // no array: not submitted
    int submissions = 0;                                 // by this object
    Clock::time_point ended = Clock::time_point::max();  // first seen without a reply
  };

  void check() const {
    const auto reject = [](const std::string& what) {
      throw std::invalid_argument("doe::SlurmJobs: " + what);
    };
    if (options_.folder.empty()) reject("no folder; name one that all nodes reach");
    if (options_.at_once < 0)
      reject("at_once is " + std::to_string(options_.at_once) + "; allowed is 0 or more");
    if (options_.submissions < 1)
      reject("submissions is " + std::to_string(options_.submissions) + "; allowed is 1 or more");
    const auto reject_clusters = [&](const std::string& word) {
      reject(word +
             " is for sbatch alone, and squeue would not find the tasks; set SLURM_CLUSTERS, which all "
             "commands of Slurm follow");
    };
    for (const std::string& word : options_.options)
      if (word.starts_with("-M") || word.starts_with("--clusters")) reject_clusters(word);
    if (std::getenv("SBATCH_CLUSTERS") != nullptr) reject_clusters("SBATCH_CLUSTERS");
    if (!(options_.poll > 0.0))
      reject("poll is " + std::to_string(options_.poll) + " s; allowed is above 0 s");
  }

  static int most_tasks() {
    try {
      return std::min(detail::most_tasks_per_array(), 1000);
    } catch (const detail::SlurmError& e) {
      throw std::runtime_error(std::string("doe::SlurmJobs: there is no Slurm cluster here: ") + e.what());
    }
  }

  std::filesystem::path folder(const std::string& array) const { return options_.folder / array; }
  std::filesystem::path script(const Place& place) const {
    return folder(place.array) / (std::to_string(place.index) + ".sh");
  }
  static std::filesystem::path reply(std::filesystem::path script) {
    return script.replace_extension(".reply");
  }

  /// The script first: without it nobody takes the reply over.
  void remove_files(const Place& place) {
    std::error_code ignored;
    std::filesystem::remove(script(place), ignored);
    std::filesystem::remove(reply(script(place)), ignored);
  }

  std::set<std::string>::iterator remove_files(std::set<std::string>::iterator array) {
    std::error_code ignored;
    std::filesystem::remove_all(folder(*array), ignored);
    return arrays_.erase(array);
  }

  /// Tasks that another object has left here, by their scripts.
  void read_earlier() {
    for (const auto& entry : std::filesystem::directory_iterator(options_.folder)) {
      const std::string array = entry.path().filename();
      if (!array.starts_with(own_prefix) || !entry.is_directory()) continue;
      if (entry.path().extension() == unfinished) {
        std::filesystem::remove_all(entry.path());
        continue;
      }
      arrays_.insert(array);
      for (const auto& file : std::filesystem::directory_iterator(entry.path())) {
        const std::string stem = file.path().stem();
        if (file.path().extension() != ".sh" || stem == "task") continue;
        const Place place{array, std::stoi(stem)};
        const auto [found, is_new] = earlier_.emplace(detail::text_of(file.path()), place);
        if (!is_new && std::filesystem::exists(reply(file.path()))) found->second = place;
      }
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

  /// As many arrays as there is room for.
  void submit() {
    constexpr int most_waiting = 2000;  // with Slurm at a time: queues of clusters have bounds
    if (Clock::now() < next_submission_) return;
    while (!queue_.empty()) {
      const int waiting = running() - static_cast<int>(queue_.size());
      const int count = std::min(static_cast<int>(queue_.size()), most_tasks_);
      if (waiting > 0 && waiting + count > most_waiting) return;
      const std::vector<std::int64_t> ids(queue_.begin(), queue_.begin() + count);
      if (!submit(ids)) return;
      queue_.erase(queue_.begin(), queue_.begin() + count);
    }
  }

  bool submit(const std::vector<std::int64_t>& ids) {
    const std::string array = new_name();
    const std::filesystem::path draft = folder(array).string() + unfinished;
    std::filesystem::create_directories(draft);
    for (std::size_t k = 0; k < ids.size(); ++k)
      detail::put_text(draft / (std::to_string(k) + ".sh"), tasks_.at(ids[k]).script);
    detail::put_text(draft / "task.sh", detail::script_of_array(folder(array)));
    std::filesystem::rename(draft, folder(array));
    try {
      detail::submit_array(array, folder(array) / "task.sh", static_cast<int>(ids.size()), options_.at_once,
                           options_.options);
    } catch (const detail::SlurmError& e) {
      if (detail::is_cancelled(array)) {
        std::error_code ignored;
        std::filesystem::remove_all(folder(array), ignored);
        if (!accepted_)
          throw std::runtime_error(std::string("doe::SlurmJobs: Slurm takes no job: ") + e.what());
        bear(e, refused_);
        next_submission_ = Clock::now() + seconds(options_.poll);
        return false;
      }  // it may have taken the array all the same: squeue will tell
    }
    refused_ = Clock::time_point::max();
    accepted_ = true;
    arrays_.insert(array);
    for (std::size_t k = 0; k < ids.size(); ++k) {
      Task& task = tasks_.at(ids[k]);
      task.place = {array, static_cast<int>(k)};
      task.ended = Clock::time_point::max();
      ++task.submissions;
    }
    return true;
  }

  /// Unique among all that were ever in the folder, and on the cluster.
  std::string new_name() {
    const auto now = std::chrono::system_clock::now().time_since_epoch().count();
    return own_prefix +
           detail::checksum(options_.folder.string() + " " + std::to_string(getpid()) + " " +
                            std::to_string(now))
               .substr(0, 8) +
           "-" + std::to_string(++serial_);
  }

  std::map<Place, std::int64_t> ids_by_place() const {
    std::map<Place, std::int64_t> ids;
    for (const auto& [id, task] : tasks_)
      if (!task.place.array.empty()) ids[task.place] = id;
    return ids;
  }

  /// Those whose replies are there.
  std::vector<ProcessEnd> collect() {
    std::vector<ProcessEnd> ends;
    const std::map<Place, std::int64_t> ids = ids_by_place();
    for (const std::string& array : arrays_) {
      for (const auto& file : std::filesystem::directory_iterator(folder(array))) {
        if (file.path().extension() != ".reply") continue;
        const auto found = ids.find({array, std::stoi(file.path().stem())});
        if (found == ids.end()) continue;
        const Process& process = tasks_.at(found->second).process;
        const std::optional<ProcessEnd> end = detail::end_in(detail::text_of(file.path()), process);
        if (!end) continue;  // not all of it is seen yet
        detail::remove_if_empty(process.output);
        ends.push_back(*end);
        given_[end->id] = found->first;
        tasks_.erase(found->second);
      }
    }
    return ends;
  }

  /// Asks Slurm for the tasks without a reply. Those that have failed; lost ones are queued again.
  std::vector<ProcessEnd> ask() {
    next_question_ = Clock::now() + seconds(options_.poll);
    if (arrays_.empty()) return {};
    detail::TaskStates states;
    try {
      states = detail::task_states({arrays_.begin(), arrays_.end()});
      unanswered_ = Clock::time_point::max();
    } catch (const detail::SlurmError& e) {
      bear(e, unanswered_);
      return {};
    }
    std::vector<ProcessEnd> ends = collect();  // what ended before Slurm was asked and after the last look
    for (const std::int64_t id : ids_in_order()) {
      Task& task = tasks_.at(id);
      if (task.place.array.empty()) continue;
      const auto found = states.find({task.place.array, task.place.index});
      const std::string state = found == states.end() ? "unknown" : found->second;
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
      std::error_code ignored;
      std::filesystem::remove(script(task.place), ignored);  // so that it is taken for no earlier task
      task.place = {};
      queue_.push_back(task.process.id);
      return;
    }
    std::string how = "ended without a reply, Slurm's state " + state;
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
  int most_tasks_ = 1;  // of one array
  std::map<std::int64_t, Task> tasks_;
  std::deque<std::int64_t> queue_;        // tasks to submit
  std::set<std::string> arrays_;          // those that have a folder
  std::map<std::string, Place> earlier_;  // by script
  bool accepted_ = false;                 // an array of this object, by Slurm
  int serial_ = 0;
  Clock::time_point next_question_ = Clock::now() + seconds(options_.poll);
  Clock::time_point next_submission_ = Clock::now();
  Clock::time_point unanswered_ = Clock::time_point::max();  // since when; of squeue
  Clock::time_point refused_ = Clock::time_point::max();     // since when; of sbatch
  std::map<std::int64_t, Place> given_;                      // ends of the last wait()
};

}  // namespace drawpoint::doe
