// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Asks runs to stop when their time is up or when the study is cancelled.
///
/// One thread waits for the next deadline. A run is asked, never forced: a function that does not look at its
/// std::stop_token ends when it ends. For a hard limit run the simulation as a process of its own.

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace drawpoint::doe::detail {

class Watchdog {
 public:
  using Clock = std::chrono::steady_clock;

  /// `limit` of each run in seconds, ∞ for none.
  Watchdog(double limit, std::stop_token cancelled)
      : limit_(limit), cancelled_(std::move(cancelled), [this] { stop_all(); }) {
    if (has_limit()) thread_ = std::jthread([this](const std::stop_token& end) { watch(end); });
  }

  /// The token of a run that starts now; forget it when the run has ended.
  std::pair<int, std::stop_token> start() {
    const std::scoped_lock lock(mutex_);
    std::stop_source source;
    if (all_stopped_) source.request_stop();
    const Clock::time_point deadline =
        has_limit() ? Clock::now() +
                          std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit_))
                    : Clock::time_point::max();
    running_.emplace(next_, Run{deadline, source});
    changed_.notify_one();
    return {next_++, source.get_token()};
  }

  void forget(int run) {
    const std::scoped_lock lock(mutex_);
    running_.erase(run);
  }

 private:
  struct Run {
    Clock::time_point deadline;
    std::stop_source source;
  };

  bool has_limit() const { return limit_ < longest; }

  void stop_all() {
    std::vector<std::stop_source> sources;
    {
      const std::scoped_lock lock(mutex_);
      all_stopped_ = true;
      for (const auto& run : running_) sources.push_back(run.second.source);
    }
    for (std::stop_source& source : sources) source.request_stop();  // calls what the runs have registered
  }

  void watch(const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    while (!end.stop_requested()) {
      // Equal limits: the run that started first is due first.
      const auto due = running_.empty() ? Clock::time_point::max() : running_.begin()->second.deadline;
      if (due == Clock::time_point::max()) {
        changed_.wait(lock, end, [&] { return !running_.empty(); });
      } else if (Clock::now() < due) {
        changed_.wait_until(lock, end, due, [] { return false; });
      } else {
        std::stop_source source = running_.begin()->second.source;
        running_.erase(running_.begin());
        lock.unlock();
        source.request_stop();  // calls what the run has registered
        lock.lock();
      }
    }
  }

  static constexpr double longest = 1e9;  // seconds, 30 years; the clock overflows beyond 292

  double limit_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool all_stopped_ = false;
  int next_ = 0;
  std::map<int, Run> running_;
  std::stop_callback<std::function<void()>> cancelled_;
  std::jthread thread_;
};

}  // namespace drawpoint::doe::detail
