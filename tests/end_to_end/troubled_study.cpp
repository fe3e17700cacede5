// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A study that misbehaves on demand, for the tests: the environment variable TROUBLE says how. Runs with x >
/// 0.5 are the bad ones; with "held", those from number HELD_FROM on, which take five minutes.

#include <drawpoint/studies/study.hpp>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>

using namespace drawpoint;

namespace {

std::string trouble() {
  const char* value = std::getenv("TROUBLE");
  return value == nullptr ? "" : value;
}

/// What the run measures, on its log: hours and wear, of which the responses follow.
void write_measures(const std::filesystem::path& file, double x, double y) {
  std::ofstream log(file);
  log.precision(17);
  log << x * x + y << ' ' << (x - 1.0) * (x - 1.0) + 0.5 * y << '\n';
}

doe::Outcome responses_of(const std::filesystem::path& file, const studies::OptionValues& options) {
  std::ifstream log(file);
  double hours = 0, wear = 0;
  if (!(log >> hours >> wear)) throw std::runtime_error("the log ends early");
  return {std::stod(options.at("price")) * hours, wear};
}

/// A run log of so many bytes.
void write_log(const std::filesystem::path& file, std::size_t bytes) {
  std::ofstream log(file, std::ios::binary);
  log << std::string(bytes, 'x');
  log.close();
  if (!log) throw std::runtime_error("cannot write the run log");
}

bool is_held(const std::filesystem::path& log) {
  const std::string name = log.stem().string();  // run_0007
  const char* from = std::getenv("HELD_FROM");
  if (from == nullptr) throw std::runtime_error("TROUBLE=held needs HELD_FROM, the number of a run");
  return std::stoi(name.substr(name.find('_') + 1)) >= std::stoi(from);
}

doe::Outcome good(double x, double y) { return {x * x + y, (x - 1.0) * (x - 1.0) + 0.5 * y}; }

doe::Outcome misbehave(const std::string& how, double x, double y) {
  if (how == "throw") throw std::runtime_error("the bucket is stuck");
  if (how == "nan") return {x, std::nan("")};
  if (how == "count") return {x, y, 3.0};
  if (how == "exit") std::exit(7);
  if (how == "parts") std::raise(SIGKILL);
  if (how == "hang") std::this_thread::sleep_for(std::chrono::seconds(300));
  if (how == "crash") {
    std::cerr << "about to crash\n" << std::flush;
    std::raise(SIGSEGV);
  }
  return good(x, y);
}

doe::Outcome simulate(const Eigen::VectorXd& x, doe::Seed, const studies::RunContext& context) {
  const std::string how = trouble();
  std::cout << (how == "print" ? "a black box that prints\n" : "");
  if (how == "options" && context.options.at("rock") == "waste") return doe::Failure{"only waste"};
  if (how == "slow") std::this_thread::sleep_for(std::chrono::milliseconds(150));
  if (how == "held" && is_held(context.log)) std::this_thread::sleep_for(std::chrono::seconds(300));
  if (how == "logged") {
    if (x[0] > 0.9) return doe::Failure{"jammed"};
    write_measures(context.log, x[0], x[1]);
    return responses_of(context.log, context.options);
  }
  if (how == "drawn" || how == "filmed" || how == "cycles") {
    if (x[0] > 0.9) return doe::Failure{"jammed"};
    write_measures(context.log, x[0], x[1]);
    return x[0] > 0.5 ? doe::Outcome(doe::Failure{"spilled"}) : good(x[0], x[1]);
  }
  if (how == "parts") {
    std::ofstream(context.log) << "first\n";
    std::ofstream(context.log.string() + ".more") << "second\n";
  }
  if (how == "large") write_log(context.log, 300'000);
  if (how == "huge") write_log(context.log, 2'000'000);
  if (how == "shared" || how == "unprepared") {
    if (!std::filesystem::exists(context.shared / "pile.txt")) return doe::Failure{"no pile"};
    write_log(context.log, 10);
  }
  return x[0] > 0.5 || how == "all" ? misbehave(how == "all" ? "throw" : how, x[0], x[1]) : good(x[0], x[1]);
}

nlohmann::json box(double x, double y, double z) {
  nlohmann::json corners = nlohmann::json::array();
  for (int k = 0; k < 8; ++k) corners.push_back({k & 1 ? x : -x, k & 2 ? y : -y, k & 4 ? z : -z});
  return {{"vertices", corners},
          {"faces", {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}}};
}

/// A red box that goes 4 m along x in 2 s, on a floor, at a place of y.
nlohmann::json scene(double y = 0) {
  nlohmann::json frames = nlohmann::json::array();
  for (int t = 0; t <= 2; ++t)
    frames.push_back({{"t", t},
                      {"label", "at " + std::to_string(t)},
                      {"poses", {{0, 0, -0.1, 1, 0, 0, 0}, {2.0 * t - 2.0, y, 0.6, 1, 0, 0, 0}}}});
  return {{"type", "scene"},
          {"title", "A box"},
          {"caption", "It goes."},
          {"shapes", {box(5, 2, 0.1), box(0.6, 0.5, 0.6)}},
          {"bodies", {{{"shape", 0}, {"color", "#a09080"}}, {{"shape", 1}, {"color", "#d01010"}}}},
          {"frames", frames},
          {"follow", 1},
          {"camera", {{"eye", {0, -12, 3}}, {"target", {0, 0, 0.5}}}}};
}

/// A table of what the log has.
nlohmann::json illustrate(const std::filesystem::path& file) {
  std::ifstream log(file);
  double hours = 0, wear = 0;
  if (!(log >> hours >> wear)) throw std::runtime_error("the log ends early");
  nlohmann::json figures = nlohmann::json::array({{{"type", "table"},
                                                   {"title", "measured"},
                                                   {"caption", "all"},
                                                   {"columns", {"hours", "wear"}},
                                                   {"rows", {{hours, wear}}}}});
  if (trouble() == "filmed") figures.push_back(scene());
  return figures;
}

/// A table of the run, and of each of two cycles a scene with a signal that ends after 1 s.
nlohmann::json by_cycles(const std::filesystem::path& file) {
  nlohmann::json figures = illustrate(file);
  for (const int cycle : {1, 2}) {
    figures.push_back(scene(cycle == 1 ? 0.0 : 1.2));
    figures.back()["cycle"] = cycle;
    figures.back()["caption"] = "Cycle " + std::to_string(cycle) + ".";
    figures.back()["note"] = "Drag to turn.";
    figures.back()["signals"] = {{{"name", "Load"},
                                  {"unit", "t"},
                                  {"t", {0.0, 0.5, 1.0}},
                                  {"y", {0.0, 2.0, 3.0}},
                                  {"lines", {{{"name", "payload"}, {"y", 2.5}}}}}};
  }
  return figures;
}

/// Of a log in two files, one.
void join(const std::filesystem::path& log) {
  const std::filesystem::path more = log.string() + ".more";
  std::ofstream(log, std::ios::app) << std::ifstream(more).rdbuf();
  std::filesystem::remove(more);
}

void prepare(const studies::RunContext& context) {
  if (trouble() == "unprepared") throw std::runtime_error("the pile does not settle");
  std::ofstream(context.shared / "pile.txt") << "settled\n";
}

}  // namespace

int main(int argc, char** argv) {
  studies::Study study{
      .name = "troubled",
      .problem = {.variables = {{"x", "m", 0.0, 1.0}, {"y", "deg", -5.0, 25.0}},
                  .responses = {{"cost", "EUR", doe::Goal::minimize}, {"wear", "1", doe::Goal::minimize}}},
      .black_box = simulate,
      .defaults = {.runs = 12, .validation = 4},
      .options = {{"rock", "what is loaded", "ore", {"ore", "waste"}}}};
  if (trouble() == "bounds") std::swap(study.problem.variables[1].lower, study.problem.variables[1].upper);
  if (trouble() == "changed") study.problem.variables[1].upper = 30.0;
  if (trouble() == "shared" || trouble() == "unprepared") study.prepare = prepare;
  if (trouble() == "drawn" || trouble() == "filmed" || trouble() == "cycles")
    study.presentation.illustrate = illustrate;
  if (trouble() == "cycles") study.presentation.replay = by_cycles;
  if (trouble() == "parts") study.logs.finish = join;
  if (trouble() == "logged") {
    study.logs.responses = responses_of;
    study.options.push_back({.name = "price", .value = "1", .least = 1, .most = 9, .of_responses = true});
  }
  return studies::run(argc, argv, study);
}
