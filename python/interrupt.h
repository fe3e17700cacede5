// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/python/bind.h>

#include <chrono>
#include <exception>
#include <future>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

/// How an exception of Python that is no failed run (Ctrl-C, sys.exit, a fault of a callback) ends a search: it
/// is kept, the search is asked to stop, and it is thrown again when the search has returned.

namespace drawpoint::python {

class Interrupt {
 public:
  std::stop_token token() const { return stop_.get_token(); }
  bool requested() const { return stop_.stop_requested(); }

  /// Within a catch; the first exception counts.
  void keep_current() {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = std::current_exception();
    stop_.request_stop();
  }

  /// With the GIL: lets Python's own handlers of signals run, on its main thread.
  void check_signals() {
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } catch (py::error_already_set&) {
      keep_current();
    }
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

  /// Runs body without the GIL, on another thread where `apart`, so that this one can meanwhile answer signals.
  /// Throws what was kept, else what body throws.
  template <class Body>
  auto run(bool apart, const Body& body) -> decltype(body()) {
    const py::gil_scoped_release release;
    if (!apart) {
      try {
        auto result = body();
        rethrow();
        return result;
      } catch (...) {
        rethrow();
        throw;
      }
    }
    std::packaged_task<decltype(body())()> task(body);
    auto result = task.get_future();
    std::jthread worker(std::move(task));
    while (result.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
      const py::gil_scoped_acquire gil;
      check_signals();
    }
    worker.join();
    rethrow();
    return result.get();
  }

 private:
  std::stop_source stop_;
  std::mutex mutex_;
  std::exception_ptr error_;
};

}  // namespace drawpoint::python
