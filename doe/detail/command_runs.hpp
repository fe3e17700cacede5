// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Runs of a program as processes, whatever carries these out: a pool on this machine or a cluster.

#include <Eigen/Core>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/processes.hpp>

namespace drawpoint::doe::detail {

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

/// The first word with a comma between two digits that may be a decimal comma, such as 3,14 or 1,5e-05: no
/// point in the word and no exponent before the comma.
inline std::string_view ambiguous_word(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  for (std::size_t from = 0; (from = text.find_first_not_of(blanks, from)) != text.npos;) {
    const std::string_view word = text.substr(from, text.find_first_of(blanks, from) - from);
    const auto digit = [&](std::size_t at) { return at < word.size() && word[at] >= '0' && word[at] <= '9'; };
    for (std::size_t at = 1, start = 0; at + 1 < word.size(); ++at) {
      if (word[at] != ',') continue;
      const bool whole = word.substr(start, at - start).find_first_of("eE") == word.npos;
      if (whole && digit(at - 1) && digit(at + 1) && word.find('.') == word.npos) return word;
      start = at + 1;
    }
    from += word.size();
  }
  return {};
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
  const bool whole = !end.timed_out && end.wait_status == 0;
  if (const std::string_view word = ambiguous_word(reply); whole && !word.empty())
    return Failure{"the run's process wrote \"" + std::string(word) +
                   "\", which may be one number with a decimal comma or several; write decimal points, and "
                   "blanks or line breaks between numbers"};
  const std::optional<Eigen::VectorXd> values = numbers_in(reply);
  if (values && whole) return *values;
  std::string reason = "the run's process " + describe(end);
  if (whole)
    reason += reply.empty() ? " without values on file descriptor 3" : " and wrote what are no numbers";
  return Failure{reason};
}

/// A command whose words take a point and a seed, and where its runs print.
struct RunCommand {
  std::vector<std::string> words;
  double time_limit;             // [s], infinite: none
  std::filesystem::path output;  // folder; empty: what runs print is dropped

  /// Throws std::invalid_argument in the name of `owner`.
  void check(const std::string& owner) const {
    const auto reject = [&](const std::string& what) { throw std::invalid_argument(owner + ": " + what); };
    if (words.empty() || words.front().empty()) reject("the command is empty; name a program");
    bool takes_point = false;
    for (const std::string& word : words) takes_point = takes_point || word.find("{x}") != word.npos;
    if (!takes_point) reject("no word of the command holds {x}; say where the point goes, such as --x={x}");
    if (!(time_limit > 0.0))
      reject("time_limit is " + number_text(time_limit) + " s; allowed is a time above 0 s");
  }

  std::filesystem::path printed(Eigen::Index run) const {
    if (output.empty()) return "/dev/null";
    const std::string number = std::to_string(run + 1);
    return output / (std::string(number.size() < 4 ? 4 - number.size() : 0, '0') + number + ".txt");
  }

  Process process(Eigen::Index run, const Eigen::VectorXd& x, Seed seed) const {
    std::vector<std::string> filled = filled_in(words, x, seed);
    const std::string program = filled.front();
    filled.erase(filled.begin());
    return {.id = run,
            .executable = program,
            .arguments = std::move(filled),
            .output = printed(run),
            .time_limit = std::isfinite(time_limit) ? time_limit : 0.0};
  }

  Outcome outcome(const ProcessEnd& end) const {
    const Outcome outcome = outcome_of(end);
    const std::filesystem::path file = printed(static_cast<Eigen::Index>(end.id));
    std::error_code ignored;
    if (!outcome.failed() || !std::filesystem::is_regular_file(file, ignored)) return outcome;
    return Failure{outcome.reason() + "; it printed " + file.string()};
  }
};

/// One run per row of X by `workers`, which starts processes, says whether it is full and gives their ends.
/// What has not ended when a stop is requested has failed; `workers` may still be at it.
template <class Workers>
std::vector<Outcome> carry_out(const RunCommand& command, Workers& workers, const Eigen::MatrixXd& X,
                               std::span<const Seed> seeds, const std::stop_token& stop) {
  if (!command.output.empty()) std::filesystem::create_directories(command.output);
  std::vector<Outcome> outcomes(static_cast<std::size_t>(X.rows()), Failure{"not run: stopped"});
  Eigen::Index next = 0;
  while ((next < X.rows() || workers.running() > 0) && !stop.stop_requested()) {
    for (; next < X.rows() && !workers.full(); ++next)
      workers.start(command.process(next, X.row(next), seeds[static_cast<std::size_t>(next)]));
    for (const ProcessEnd& end : workers.wait(std::chrono::milliseconds(100)))
      outcomes[static_cast<std::size_t>(end.id)] = command.outcome(end);
  }
  return outcomes;
}

}  // namespace drawpoint::doe::detail
