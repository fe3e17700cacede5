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
/// word "failure" and its reason. A program that ends in any other way is a Failure that says how: a signal, an
/// exit code without values, the time limit. processes.hpp says in what surroundings it runs. Linux only.

#include <Eigen/Core>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
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

namespace detail {

inline std::string joined(const Eigen::VectorXd& x) {
  std::string text;
  for (const double value : x) text += (text.empty() ? "" : ",") + number_text(value);
  return text;
}

inline std::string replaced(std::string word, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = word.find(what, at)) != std::string::npos; at += by.size())
    word.replace(at, what.size(), by);
  return word;
}

/// The words of one run.
inline std::vector<std::string> filled_in(const std::vector<std::string>& command, const Eigen::VectorXd& x,
                                          Seed seed) {
  std::vector<std::string> words;
  for (const std::string& word : command) {
    if (word == "{x}")
      for (const double value : x) words.push_back(number_text(value));
    else
      words.push_back(replaced(replaced(word, "{x}", joined(x)), "{seed}", std::to_string(seed)));
  }
  return words;
}

/// Numbers parted by blanks, commas or line breaks; nothing when there are none or something else.
inline std::optional<Eigen::VectorXd> numbers_in(std::string_view text) {
  constexpr std::string_view gaps = " ,\t\r\n";
  std::vector<double> values;
  while (true) {
    const std::size_t from = text.find_first_not_of(gaps);
    if (from == std::string_view::npos) break;
    text.remove_prefix(from);
    const std::string_view word = text.substr(0, text.find_first_of(gaps));
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    values.push_back(value);
    text.remove_prefix(word.size());
  }
  if (values.empty()) return std::nullopt;
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

inline Outcome outcome_of(const ProcessEnd& end) {
  constexpr std::string_view failure = "failure";
  const std::string_view reply = end.reply;
  if (reply.starts_with(failure)) {
    const std::size_t from = reply.find_first_not_of(" :\n", failure.size());
    const std::size_t last = reply.find_last_not_of(" \r\n");
    if (from == std::string_view::npos) return Failure{"the run's process gave no reason"};
    return Failure{std::string(reply.substr(from, last + 1 - from))};
  }
  const std::optional<Eigen::VectorXd> values = numbers_in(reply);
  if (values && !end.timed_out && end.wait_status == 0) return *values;
  std::string reason = "the run's process " + describe(end);
  if (!end.timed_out && end.wait_status == 0)
    reason += reply.empty() ? " without values on file descriptor 3" : " and wrote what are no numbers";
  return Failure{reason};
}

}  // namespace detail

/// What process_pool returns: a batch function.
class ProcessFunction {
 public:
  ProcessFunction(std::vector<std::string> command, ProcessPoolOptions options)
      : command_(std::move(command)), options_(std::move(options)) {
    const auto reject = [](const std::string& what) {
      throw std::invalid_argument("doe::process_pool: " + what);
    };
    if (command_.empty() || command_.front().empty()) reject("the command is empty; name a program");
    bool takes_point = false;
    for (const std::string& word : command_) takes_point = takes_point || word.find("{x}") != word.npos;
    if (!takes_point) reject("no word of the command holds {x}; say where the point goes, such as --x={x}");
    if (options_.jobs < 0)
      reject("jobs is " + std::to_string(options_.jobs) + "; allowed is 0 or more; 0 means all cores");
    if (!(options_.time_limit > 0.0))
      reject("time_limit is " + detail::number_text(options_.time_limit) + " s; allowed is a time above 0 s");
  }

  /// X: n x d, one run per row. Throws std::runtime_error when the system gives no process, and when the
  /// folder for the output cannot be made.
  std::vector<Outcome> operator()(const Eigen::MatrixXd& X, std::span<const Seed> seeds) const {
    if (!options_.output.empty()) std::filesystem::create_directories(options_.output);
    std::vector<Outcome> outcomes(static_cast<std::size_t>(X.rows()), Failure{"not run: stopped"});
    ProcessPool pool(detail::thread_count(options_.jobs));
    Eigen::Index next = 0;
    while ((next < X.rows() || pool.running() > 0) && !options_.stop.stop_requested()) {
      for (; next < X.rows() && !pool.full(); ++next)
        pool.start(process(next, X.row(next), seeds[static_cast<std::size_t>(next)]));
      for (const ProcessEnd& end : pool.wait(std::chrono::milliseconds(100)))
        outcomes[static_cast<std::size_t>(end.id)] = outcome_of(end);
    }
    pool.terminate(std::chrono::seconds(2));
    return outcomes;
  }

 private:
  std::filesystem::path output(Eigen::Index run) const {
    if (options_.output.empty()) return "/dev/null";
    const std::string number = std::to_string(run + 1);
    return options_.output / (std::string(number.size() < 4 ? 4 - number.size() : 0, '0') + number + ".txt");
  }

  Process process(Eigen::Index run, const Eigen::VectorXd& x, Seed seed) const {
    std::vector<std::string> words = detail::filled_in(command_, x, seed);
    const std::string program = words.front();
    words.erase(words.begin());
    return {.id = run,
            .executable = program,
            .arguments = std::move(words),
            .output = output(run),
            .time_limit = std::isfinite(options_.time_limit) ? options_.time_limit : 0.0};
  }

  Outcome outcome_of(const ProcessEnd& end) const {
    const Outcome outcome = detail::outcome_of(end);
    const std::filesystem::path printed = output(static_cast<Eigen::Index>(end.id));
    std::error_code ignored;
    if (!outcome.failed() || !std::filesystem::is_regular_file(printed, ignored)) return outcome;
    return Failure{outcome.reason() + "; it printed " + printed.string()};
  }

  std::vector<std::string> command_;
  ProcessPoolOptions options_;
};

/// The black box. Throws std::invalid_argument for an empty command, one without {x}, and options out of
/// range.
inline ProcessFunction process_pool(std::vector<std::string> command, ProcessPoolOptions options = {}) {
  return ProcessFunction(std::move(command), std::move(options));
}

static_assert(BatchFunction<ProcessFunction>);

}  // namespace drawpoint::doe
