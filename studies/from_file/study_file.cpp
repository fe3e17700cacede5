// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/from_file/section.h>
#include <drawpoint/studies/from_file/simulator_files.h>
#include <drawpoint/studies/from_file/study_file.h>
#include <drawpoint/studies/run/program/strict_json.h>
#include <drawpoint/studies/run/store/share_file.h>
#include <drawpoint/doe/detail/hash.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/studies/external_program.hpp>

#include <array>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

doe::Variable variable_from(const Section& in) {
  in.allow_only({"name", "unit", "lower", "upper", "kind", "levels", "description"});
  doe::Variable variable{.name = in.text("name"),
                         .unit = in.text("unit", "1"),
                         .lower = 0,
                         .upper = 0,
                         .description = in.text("description", "")};
  if (in.has("kind"))
    variable.kind = in.one_of(
        "kind", {doe::VariableKind::real, doe::VariableKind::integer, doe::VariableKind::categorical});
  if (variable.kind == doe::VariableKind::categorical) {
    variable.levels = in.texts("levels");
    variable.upper = static_cast<double>(variable.levels.size()) - 1.0;
    return variable;
  }
  if (in.has("levels")) in.fail("levels are of a variable of the kind categorical; say so, or remove them");
  variable.lower = in.number("lower");
  variable.upper = in.number("upper");
  return variable;
}

doe::Response response_from(const Section& in) {
  in.allow_only({"name", "unit", "goal", "limit", "lower", "upper", "description", "standard_error",
                 "standard_error_freedom"});
  doe::Response response{.name = in.text("name"), .unit = in.text("unit", "1")};
  response.goal = in.one_of("goal", {doe::Goal::minimize, doe::Goal::maximize, doe::Goal::at_most,
                                     doe::Goal::at_least, doe::Goal::record});
  response.limit = in.number("limit", response.limit);
  response.lower = in.number("lower", response.lower);
  response.upper = in.number("upper", response.upper);
  response.description = in.text("description", "");
  response.standard_error = in.text("standard_error", "");
  response.standard_error_freedom = in.number("standard_error_freedom", 0);
  return response;
}

doe::Problem problem_from(const Section& in) {
  doe::Problem problem;
  for (const Section& entry : in.sections("variables")) problem.variables.push_back(variable_from(entry));
  for (const Section& entry : in.sections("responses")) problem.responses.push_back(response_from(entry));
  problem.deterministic = in.truth("deterministic", false);
  for (const doe::Response& r : problem.responses)
    if (problem.deterministic && !r.standard_error.empty())
      in.fail("deterministic is true, and response \"" + r.name +
              "\" has a standard_error; leave one of them out");
  return problem;
}

std::vector<Mark> marks_from(const Section& in, const doe::Problem& problem) {
  std::vector<Mark> marks;
  for (const Section& entry : in.sections("marks")) {
    entry.allow_only({"name", "x"});
    const std::vector<double> x = entry.numbers("x");
    marks.push_back({entry.text("name"),
                     Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()))});
  }
  try {
    check_marks(problem, marks);
  } catch (const std::invalid_argument& e) {
    in.fail(e.what());
  }
  return marks;
}

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The command with whole names of the files beside the study file, and in words with the checksums of these.
struct Command {
  std::vector<std::string> words;
  std::string simulator;
  std::string note =
      {};  // what is taken as the program beside its own file, where the study file says nothing
};

/// Names (their number, if over five) and checksum of a program's files beside those that its command names.
std::string described(const SimulatorFiles& files, const fs::path& folder) {
  constexpr std::size_t most_names = 5;
  std::string names;
  if (files.names.size() > most_names)
    names = std::to_string(files.names.size()) + " files";
  else
    for (const fs::path& name : files.names)
      names += (names.empty() ? "" : ", ") + name.lexically_relative(folder).string();
  return names + " (checksum " + files.checksum + ")";
}

void add_files(const Section& in, const fs::path& folder, const std::vector<fs::path>& beside,
               Command& command) {
  try {
    if (in.has("files")) {
      const SimulatorFiles files = files_named(in.texts_or_none("files"), folder);
      if (!files.names.empty()) command.simulator += "; files " + described(files, folder);
      return;
    }
    const SimulatorFiles files = files_like(beside, folder);
    if (files.names.empty() && files.note.empty()) return;
    command.note = files.note;
    if (files.names.empty()) return;
    command.simulator += files_beside_it + described(files, folder);
    command.note =
        "the program is taken to be its own file and those beside it that end alike: " +
        described(files, folder) +
        "; runs after one of them has changed are another study's. \"files\" in the study file names "
        "others, or [] none";
  } catch (const std::runtime_error& e) {
    in.fail(e.what());
  }
}

Command command_from(const Section& in, const fs::path& folder) {
  Command command;
  std::vector<fs::path> files;
  for (const std::string& word : in.texts("command")) {
    std::error_code ignored;
    const bool beside = !word.empty() && fs::is_regular_file(folder / word, ignored);
    command.words.push_back(beside ? (folder / word).string() : word);
    command.simulator += (command.simulator.empty() ? "" : " ") + word;
    if (!beside) continue;
    command.simulator += " (checksum " + doe::detail::checksum(content_of(folder / word)) + ")";
    files.push_back(folder / word);
  }
  if (in.has("version")) command.simulator += "; version " + in.text("version");
  add_files(in, folder, files, command);
  return command;
}

bool streams_from(const Section& in) {
  const std::string exchange = in.text("exchange", "files");
  if (exchange != "files" && exchange != "streams")
    in.fail("\"exchange\" is \"" + exchange +
            "\"; give \"files\" (names as the last two words) or \"streams\" (standard input and output)");
  return exchange == "streams";
}

Defaults defaults_from(const Section& in) {
  in.allow_only({"runs", "validation", "adaptive"});
  Defaults defaults;
  defaults.runs = in.integer("runs", defaults.runs, 2);
  defaults.validation = in.integer("validation", defaults.validation, 0);
  defaults.adaptive = in.integer("adaptive", defaults.adaptive, 0);
  return defaults;
}

json parsed(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored) || fs::is_directory(file, ignored) || fs::is_character_file(file, ignored) ||
      !std::ifstream(file))
    throw std::runtime_error(file.string() + ": cannot be read; give the JSON file of a study");
  const std::string text = content_of(file);
  try {
    return strict_json(text);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(file.string() + " " + e.what());
  }
}

/// A file's name, and what it and its simulator were when the study began; empty where it begins now.
struct Word {
  fs::path file;
  std::string checksum;
};

Word parsed_word(const std::string& word) {
  const auto colon = word.find(':');
  if (word.empty() || word[0] != '@' || colon == std::string::npos) return {word, ""};
  return {word.substr(colon + 1), word.substr(1, colon - 1)};
}

/// What changes when a study file, or what its command names, does.
std::string checksum_of(const json& content, const Command& command) {
  return doe::detail::checksum(content.dump() + command.simulator);
}

/// Whether file and program are still those.
bool is_still(const fs::path& file, const std::string& checksum) {
  try {
    const json content = parsed(file);
    return checksum_of(content, command_from(Section(content, file, ""), file.parent_path())) == checksum;
  } catch (const std::runtime_error&) {
    return false;  // gone, or half written
  }
}

/// A run while which the program changed is no run of either.
StudyFunction unchanged(StudyFunction program, const fs::path& file, const std::string& checksum) {
  return [program = std::move(program), file, checksum](const Eigen::VectorXd& x, doe::Seed seed,
                                                        const RunContext& context) -> doe::Outcome {
    const doe::Outcome outcome = program(x, seed, context);
    if (outcome.failed() || is_still(file, checksum)) return outcome;
    return doe::Failure{
        "the study file or its program changed while the run was made; give the command again, with "
        "--retry-failed"};
  };
}

constexpr std::array keys_of_command = {"attempts", "time_limit", "exchange", "files", "version"};

/// For people who have no such program.
std::string without_command(json content) {
  content.erase("command");
  for (const char* key : keys_of_command) content.erase(key);
  return content.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Study study_of(const json& content, const fs::path& file, const std::string& expected) {
  const Section in(content, file, "");
  in.allow_only({"name", "about", "variables", "responses", "deterministic", "command", "exchange", "files",
                 "version", "attempts", "time_limit", "defaults", "marks"});
  Study study{.name = in.text("name"), .problem = problem_from(in), .about = in.text("about", "")};
  if (in.has("defaults")) study.defaults = defaults_from(in.section("defaults"));
  if (in.has("marks")) study.presentation.marks = marks_from(in, study.problem);
  const bool elsewhere = !in.has("command");
  for (const char* key : keys_of_command)
    if (elsewhere && in.has(key))
      in.fail("\"" + std::string(key) +
              "\" is of a command, and there is none; give \"command\", or leave it out: then runs are made "
              "elsewhere");
  const Command command = elsewhere ? Command{} : command_from(in, fs::absolute(file).parent_path());
  study.simulator.note = command.note;
  const std::string checksum = checksum_of(content, command);
  if (!expected.empty() && expected != checksum)
    in.fail("it or its program changed while the study ran; give the command again, with --retry-failed");
  study.simulator.name = command.simulator;
  study.simulator.definition = without_command(content);
  study.simulator.asks_for_chance = !elsewhere && !in.has("deterministic");
  study.simulator.leading_words = {"@" + checksum + ":" + fs::absolute(file).string()};
  if (elsewhere) return study;
  const ExternalProgram program{.command = command.words,
                                .time_limit = in.number("time_limit", 0.0),
                                .attempts = in.integer("attempts", 1, 1),
                                .streams = streams_from(in)};
  try {
    study.black_box = unchanged(external_program(study.problem, program), fs::absolute(file), checksum);
  } catch (const std::invalid_argument& e) {
    in.fail(e.what());
  }
  return study;
}

}  // namespace

Study study_from(const std::string& word) {
  const auto [file, expected] = parsed_word(word);
  return study_of(parsed(file), file, expected);
}

Study study_in_share(const fs::path& share) {
  const std::string text = shared_definition(share);
  if (text.empty())
    throw std::runtime_error(
        "open: " + share.string() +
        " holds no study file; its study is another program's, or name the file that whoever shared "
        "it has: external_program STUDY.json open " +
        share.string());
  const fs::path file = share / definition_name;
  try {
    const nlohmann::json content = strict_json(text);
    if (content.contains("command"))
      throw std::runtime_error(
          "has a \"command\", which share leaves out: what others send makes no runs here");
    return study_of(content, file, "");
  } catch (const std::exception& e) {
    throw std::runtime_error("open: " + file.string() + " " + e.what());
  }
}

}  // namespace drawpoint::studies
