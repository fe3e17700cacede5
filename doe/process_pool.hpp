// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A program as a black box: each run is a process of its own, several at a time.
///
///     doe::evaluate(doe::process_pool({"./simulate", "--x={x}", "--seed={seed}"}, {.jobs = 8}), problem, X)
///
/// In the words of the command "{seed}" becomes the seed of the run, and "{x}" its point: the numbers with
/// commas between them, the shortest text that reads back as the same double; a word that is "{x}" alone
/// becomes one word per number. The program writes its values to file descriptor 3 (in a shell, `>&3`), in
/// the order of Problem::responses, parted by blanks, commas or line breaks; or, for a run that failed, the
/// word "failure" and its reason. What may be a decimal comma, as in 3,14, fails the run. A program that ends
/// in any other way is a Failure that says how: a signal, an exit code without values, the time limit.
/// processes.hpp says in what surroundings it runs. Linux only.

#include <Eigen/Core>
#include <chrono>
#include <filesystem>
#include <limits>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/detail/command_runs.hpp>
#include <drawpoint/doe/detail/threads.hpp>
#include <drawpoint/doe/processes.hpp>

namespace drawpoint::doe {

struct ProcessPoolOptions {
  int jobs = 1;  ///< processes at a time, 0: as many as there are cores
  double time_limit = std::numeric_limits<double>::infinity();  ///< of a run [s], above 0; then it is killed
  /// Folder, made if it is not there, for what run i of a call prints: FOLDER/0001.txt; kept if it is not
  /// empty. Without a folder it is dropped.
  std::filesystem::path output = {};
  std::stop_token stop = {};  ///< requested: what runs is ended, and these and the other runs are failures
};

/// What process_pool returns: a batch function.
class ProcessFunction {
 public:
  ProcessFunction(std::vector<std::string> command, ProcessPoolOptions options)
      : command_{std::move(command), options.time_limit, options.output}, options_(std::move(options)) {
    command_.check("doe::process_pool");
    if (options_.jobs < 0)
      throw std::invalid_argument("doe::process_pool: jobs is " + std::to_string(options_.jobs) +
                                  "; allowed is 0 or more; 0 means all cores");
  }

  /// X: n x d, one run per row. Throws std::runtime_error when the system gives no process, and when the
  /// folder for the output cannot be made.
  std::vector<Outcome> operator()(const Eigen::MatrixXd& X, std::span<const Seed> seeds) const {
    ProcessPool pool(detail::thread_count(options_.jobs));
    std::vector<Outcome> outcomes = detail::carry_out(command_, pool, X, seeds, options_.stop);
    pool.terminate(std::chrono::seconds(2));
    return outcomes;
  }

 private:
  detail::RunCommand command_;
  ProcessPoolOptions options_;
};

/// The black box. Throws std::invalid_argument for an empty command, one without {x}, and options out of
/// range.
inline ProcessFunction process_pool(std::vector<std::string> command, ProcessPoolOptions options = {}) {
  return ProcessFunction(std::move(command), std::move(options));
}

static_assert(BatchFunction<ProcessFunction>);

}  // namespace drawpoint::doe
