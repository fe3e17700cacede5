// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>
#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/doe/processes.hpp>
#include <drawpoint/studies/external_program.hpp>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <variant>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The two files of a run, gone with it.
class Exchange {
 public:
  Exchange() {
    std::string name = (fs::temp_directory_path() / "drawpoint-run-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::system_error(
          errno, std::generic_category(),
          "studies: cannot make a folder for the request in " + fs::temp_directory_path().string());
    folder_ = name;
  }
  ~Exchange() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  fs::path request() const { return folder_ / "request.json"; }
  fs::path reply() const { return folder_ / "reply.json"; }

 private:
  fs::path folder_;
};

json value_of(const doe::Variable& variable, double x) {
  if (variable.kind == doe::VariableKind::categorical)
    return variable.levels[static_cast<std::size_t>(std::lround(x))];
  if (variable.kind == doe::VariableKind::integer) return std::llround(x);
  return x;
}

json request_of(const doe::Problem& problem, const Eigen::VectorXd& x, doe::Seed seed,
                const RunContext& context) {
  json named = json::object();
  for (std::size_t i = 0; i < problem.variables.size(); ++i)
    named[problem.variables[i].name] = value_of(problem.variables[i], x[static_cast<Eigen::Index>(i)]);
  return {{"x", named},
          {"seed", seed},
          {"log", context.log.string()},
          {"shared", context.shared.string()},
          {"options", json(context.options)}};
}

/// How an attempt crashed: worth another one.
struct Crash {
  std::string reason;
};
using Attempt = std::variant<doe::Outcome, Crash>;

Attempt values_of(const doe::Problem& problem, const json& values) {
  Eigen::VectorXd y(static_cast<Eigen::Index>(problem.responses.size()));
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    const std::string& name = problem.responses[j].name;
    if (!values.contains(name)) return Crash{"its reply has no value for \"" + name + "\""};
    if (!values[name].is_number())
      return Crash{"its reply has " + values[name].dump() + " for \"" + name + "\", which is no number"};
    y[static_cast<Eigen::Index>(j)] = values[name].get<double>();
  }
  return doe::Outcome(y);
}

Attempt reply_in(const fs::path& file, const doe::Problem& problem) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return Crash{"it wrote no reply"};
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const json reply = json::parse(text, nullptr, false);
  if (reply.is_object() && reply.contains("failure") && reply["failure"].is_string())
    return doe::Outcome(doe::Failure{reply["failure"].get<std::string>()});
  if (reply.is_object() && reply.contains("values") && reply["values"].is_object())
    return values_of(problem, reply["values"]);
  return Crash{R"(its reply is neither {"values": {...}} nor {"failure": "..."})"};
}

doe::ProcessEnd run_to_end(const doe::Process& process) {
  doe::ProcessPool pool(1);
  pool.start(process);
  std::vector<doe::ProcessEnd> ends;
  while (ends.empty()) ends = pool.wait(std::chrono::milliseconds(100));
  return ends.front();
}

Attempt attempt(const doe::Problem& problem, const ExternalProgram& program, const Exchange& files) {
  std::vector<std::string> words(program.command.begin() + 1, program.command.end());
  words.push_back(files.request().string());
  words.push_back(files.reply().string());
  std::error_code ignored;
  fs::remove(files.reply(), ignored);
  std::fflush(stdout);
  const doe::ProcessEnd end = run_to_end({.executable = program.command.front(),
                                          .arguments = words,
                                          .output = {},
                                          .time_limit = program.time_limit});
  if (end.wait_status != 0 || end.timed_out) return Crash{"it " + doe::describe(end)};
  return reply_in(files.reply(), problem);
}

void check(const ExternalProgram& program) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("studies::external_program: " + what);
  };
  if (program.command.empty() || program.command.front().empty())
    reject("no command; give the program and its words, such as {\"python3\", \"simulate.py\"}");
  if (!(program.time_limit >= 0.0))
    reject("time_limit is " + std::to_string(program.time_limit) + " s; allowed is 0 or more; 0 means none");
  if (program.attempts < 1)
    reject("attempts is " + std::to_string(program.attempts) + "; allowed is 1 or more");
}

}  // namespace

StudyFunction external_program(const doe::Problem& problem, const ExternalProgram& program) {
  check(program);
  doe::check(problem);
  return [problem, program](const Eigen::VectorXd& x, doe::Seed seed, const RunContext& context) {
    const Exchange files;
    doe::write_file(files.request(), request_of(problem, x, seed, context).dump(2) + "\n");
    std::string reason;
    for (int k = 1; k <= program.attempts; ++k) {
      const Attempt result = attempt(problem, program, files);
      if (const auto* outcome = std::get_if<doe::Outcome>(&result)) return *outcome;
      reason = std::get<Crash>(result).reason;
      std::fprintf(stderr, "attempt %d of %d: %s\n", k, program.attempts, reason.c_str());
    }
    const std::string often =
        program.attempts > 1 ? " in each of " + std::to_string(program.attempts) + " attempts, at last" : "";
    return doe::Outcome(
        doe::Failure{"the program \"" + program.command.front() + "\" crashed" + often + ": " + reason});
  };
}

}  // namespace drawpoint::studies
