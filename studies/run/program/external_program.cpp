// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/run/program/printed_text.h>
#include <drawpoint/studies/run/program/program_reply.h>
#include <drawpoint/studies/run/program/program_trouble.h>
#include <signal.h>
#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/doe/detail/stranger_file.hpp>
#include <drawpoint/doe/processes.hpp>
#include <drawpoint/studies/external_program.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;
using doe::detail::clear_away;
using nlohmann::json;

// For the program to end by itself; less than a study's own.
constexpr std::chrono::milliseconds program_time_to_end(1000);
constexpr std::size_t largest_reply = std::size_t{16} << 20;  // [byte]

/// Thrown to leave a run after a signal.
struct Stopped {
  int signal;
};

volatile sig_atomic_t stop_signal = 0;

/// While it lives, the signals that stop a run are noted instead.
class NotedSignals {
 public:
  NotedSignals() {
    struct sigaction noted = {};
    noted.sa_handler = [](int signal) { stop_signal = signal; };
    for (std::size_t k = 0; k < before_.size(); ++k) sigaction(numbers[k], &noted, &before_[k]);
  }
  ~NotedSignals() {
    for (std::size_t k = 0; k < before_.size(); ++k) sigaction(numbers[k], &before_[k], nullptr);
  }
  NotedSignals(const NotedSignals&) = delete;
  NotedSignals& operator=(const NotedSignals&) = delete;

 private:
  static constexpr std::array<int, 3> numbers = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> before_ = {};
};

/// The two files of a run beside its log, gone with it.
class Exchange {
 public:
  explicit Exchange(const fs::path& log)
      : request_(fs::absolute(log).string() + ".request.json"),
        reply_(fs::absolute(log).string() + ".reply.json") {
    clear_away(request_);  // of an attempt that was killed
  }
  ~Exchange() {
    clear_away(request_);
    clear_away(reply_);
  }
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  const fs::path& request() const { return request_; }
  const fs::path& reply() const { return reply_; }

 private:
  fs::path request_, reply_;
};

json value_of(const doe::Variable& variable, double x) {
  if (variable.kind == doe::VariableKind::categorical)
    return variable.levels[static_cast<std::size_t>(std::lround(x))];
  if (variable.kind == doe::VariableKind::integer) return std::llround(x);
  return x;
}

std::string request_text(const doe::Problem& problem, const Eigen::VectorXd& x, doe::Seed seed,
                         const RunContext& context) {
  json named = json::object();
  for (std::size_t i = 0; i < problem.variables.size(); ++i)
    named[problem.variables[i].name] = value_of(problem.variables[i], x[static_cast<Eigen::Index>(i)]);
  std::error_code ignored;
  const bool shares = fs::exists(context.shared, ignored) && !fs::is_empty(context.shared, ignored);
  const json request = {{"x", named},
                        {"seed", seed},
                        {"log", fs::absolute(context.log).string()},
                        {"shared", shares ? fs::absolute(context.shared).string() : ""},
                        {"options", json(context.options)}};
  return request.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

/// The last line that is not empty; what stands before it is passed on as printed.
std::string reply_among(const std::string& printed) {
  const std::size_t last = printed.find_last_not_of(" \t\r\n");
  if (last == std::string::npos) return "";
  const std::size_t line = printed.rfind('\n', last);
  const std::size_t from = line == std::string::npos ? 0 : line + 1;
  std::fwrite(printed.data(), 1, from, stdout);
  std::fflush(stdout);
  return printed.substr(from, last + 1 - from);
}

Attempt reply_in(const fs::path& name, const doe::Problem& problem, const ExternalProgram& program,
                 const RunContext& context) {
  doe::detail::StrangerFile file(name);
  if (file.missing() || (file.fault().empty() && file.size() == 0 && program.streams))
    return Crash{"it wrote no reply"};
  if (!file.fault().empty()) return Crash{"what it left as its reply " + file.fault()};
  if (file.size() > largest_reply)
    return Crash{"its reply has " + std::to_string(file.size()) + " bytes; allowed are " +
                 std::to_string(largest_reply)};
  const std::string text = file.text(0, largest_reply);
  const std::string reply = program.streams ? reply_among(text) : text;
  if (context.shows) context.shows("reply", reply);
  return reply_of(reply, problem);
}

/// Throws Stopped after a signal, the program having been given the time to end.
doe::ProcessEnd run_to_end(const doe::Process& process) {
  const NotedSignals noted;
  doe::ProcessPool pool(1);
  pool.start(process);
  std::vector<doe::ProcessEnd> ends;
  while (ends.empty()) {
    ends = pool.wait(std::chrono::milliseconds(100));
    if (stop_signal == 0) continue;
    pool.terminate(program_time_to_end);
    throw Stopped{stop_signal};
  }
  if (ended_by_stop_signal(ends.front()) && soon([] { return stop_signal != 0; })) throw Stopped{stop_signal};
  return ends.front();
}

doe::Process process_for(const ExternalProgram& program, const Exchange& files) {
  doe::Process process{.executable = program.command.front(),
                       .arguments = {program.command.begin() + 1, program.command.end()},
                       .output = {},
                       .time_limit = program.time_limit,
                       .input = files.request()};
  if (program.streams) {
    process.output = files.reply();
    process.errors_apart = true;
  } else {
    process.arguments.push_back(files.request().string());
    process.arguments.push_back(files.reply().string());
  }
  return process;
}

[[noreturn]] void cannot_start(const ExternalProgram& program, const std::string& why) {
  throw ProgramTrouble(ProgramTrouble::Kind::not_started,
                       "the program \"" + program.command.front() + "\" could not be started: " + why);
}

/// What can be seen before: a wrong line would start the wrong interpreter, or none.
void check_start(const ExternalProgram& program) {
  const std::string complaint =
      doe::detail::interpreter_complaint(doe::detail::program_file(program.command.front()));
  if (!complaint.empty()) cannot_start(program, complaint);
}

Attempt attempt(const doe::Problem& problem, const ExternalProgram& program, const Exchange& files,
                const RunContext& context) {
  clear_away(files.reply());
  std::fflush(stdout);
  const doe::ProcessEnd end = run_to_end(process_for(program, files));
  if (!end.not_started.empty()) cannot_start(program, end.not_started);
  if (end.wait_status != 0 || end.timed_out || !end.told.empty()) return Crash{"it " + doe::describe(end)};
  return reply_in(files.reply(), problem, program, context);
}

doe::Outcome outcome_of_attempts(const doe::Problem& problem, const ExternalProgram& program,
                                 const Exchange& files, const RunContext& context) {
  std::string reason;
  for (int k = 1; k <= program.attempts; ++k) {
    const Attempt result = attempt(problem, program, files, context);
    if (const auto* outcome = std::get_if<doe::Outcome>(&result)) return *outcome;
    reason = std::get<Crash>(result).reason;
    // Not after the last one: the last words are the program's.
    if (k < program.attempts)
      std::fprintf(stderr, "%s%d of %d: %s\n", attempt_begins, k, program.attempts, reason.c_str());
  }
  std::string text = "the program \"" + program.command.front() + "\" gave no result";
  if (program.attempts > 1) text += " in each of " + std::to_string(program.attempts) + " attempts, at last";
  throw ProgramTrouble(ProgramTrouble::Kind::crashed, text + ": " + reason);
}

void check(const ExternalProgram& program) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("studies::external_program: " + what);
  };
  if (program.command.empty() || program.command.front().empty())
    reject("no command; give the program and its words, such as {\"python3\", \"simulate.py\"}");
  if (!(program.time_limit >= 0.0))
    reject("time_limit is " + doe::detail::number_text(program.time_limit) +
           " s; allowed is 0 or more; 0 means none");
  if (program.attempts < 1)
    reject("attempts is " + std::to_string(program.attempts) + "; allowed is 1 or more");
}

}  // namespace

StudyFunction external_program(const doe::Problem& problem, const ExternalProgram& program) {
  check(program);
  doe::check(problem);
  return [problem, program](const Eigen::VectorXd& x, doe::Seed seed, const RunContext& context) {
    try {
      check_start(program);
      const Exchange files(context.log);
      const std::string request = request_text(problem, x, seed, context);
      doe::write_file(files.request(), request);
      if (context.shows) context.shows("request", request);
      return outcome_of_attempts(problem, program, files, context);
    } catch (const Stopped& stopped) {  // as if the signal had found nobody to note it
      ::signal(stopped.signal, SIG_DFL);
      ::raise(stopped.signal);
      throw;
    }
  };
}

}  // namespace drawpoint::studies
