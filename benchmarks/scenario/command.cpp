// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "command.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace drawpoint::benchmarks {
namespace {

constexpr int failure = 1, wrong_usage = 2;

std::string plain(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

// Accepts what `named` does.
template <class Named>
CLI::Validator known_name(const Named& named) {
  return CLI::Validator(
      [named](std::string& name) -> std::string {
        try {
          named(name);
          return {};
        } catch (const std::invalid_argument& error) {
          return error.what();
        }
      },
      "NAME");
}

}  // namespace

CLI::Validator between(double low, double high, const std::string& unit, const std::string& advice) {
  const std::string range = plain(low) + " to " + plain(high) + (unit.empty() ? "" : " " + unit);
  const auto check = [=](std::string& text) -> std::string {
    std::size_t read = 0;
    double value = std::nan("");
    try {
      value = std::stod(text, &read);
    } catch (const std::logic_error&) {
      read = 0;
    }
    if (read == text.size() && value >= low && value <= high) return {};
    return "\"" + text + "\" is not in the range " + range + "; " + advice;
  };
  return CLI::Validator(check, "[" + range + "]");
}

void add_method_flags(CLI::App& app, EngineFlags& flags) {
  flags.method = to_string(flags.world.solver.method);
  flags.narrow = to_string(flags.world.contacts.narrow);
  app.add_option("--method", flags.method, "contact solver: sequential (the reference) or batched")
      ->check(known_name(engine::method_named))
      ->capture_default_str();
  app.add_option(
         "--narrow", flags.narrow,
         "who finds the axis of two shapes: separating_axes, or FCL by fcl_libccd or fcl_indep, checked")
      ->check(known_name(engine::narrow_method_named))
      ->capture_default_str();
  app.add_option("--threads", flags.world.threads, "threads; they change the time only")
      ->check(between(1, 256, "", "no more than there are cores"))
      ->capture_default_str();
}

CLI::Validator one_of(std::span<const std::string_view> names) {
  return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

std::function<std::string(const std::string&)> taken_by(std::function<void(const std::string&)> parse) {
  return [parse = std::move(parse)](const std::string& text) -> std::string {
    try {
      parse(text);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
}

void add_engine_flags(CLI::App& app, EngineFlags& flags) {
  app.add_option("--dt", flags.world.step, "time step [s]")
      ->check(between(1e-5, 0.1, "s", "rocks of 0.3 m need 0.002 to 0.01 s"))
      ->capture_default_str();
  app.add_option("--substeps", flags.world.solver.substeps, "substeps of the contact solver per step")
      ->check(between(1, 1000, "", "1 to 16 are usual"))
      ->capture_default_str();
  app.add_option("--iterations", flags.world.solver.iterations,
                 "iterations of the contact solver per substep, at least")
      ->check(between(1, 1e6, "", "1 to 150 are usual, 1000 and more a reference"))
      ->capture_default_str();
  app.add_option("--iteration-budget", flags.world.solver.iteration_budget,
                 "iterations times points up to which a substep of a small problem goes on; 0: never")
      ->check(between(0, 1e9, "", "0 keeps to --iterations"))
      ->capture_default_str();
  app.add_option("--tolerance", flags.world.solver.tolerance,
                 "change of an iteration, of the load, below which a substep of a small problem ends")
      ->check(between(0, 1, "", "0.02 is the loading case's, 0 always uses up the budget"))
      ->capture_default_str();
  add_method_flags(app, flags);
}

void add_material_flags(CLI::App& app, MaterialFlags& flags) {
  app.add_option("--rolling", flags.rolling, "rolling resistance of the rocks [1]")
      ->check(between(0, 2, "", "0 to 0.1 is calibrated ore, 0.5 what spheres need to lie like it"))
      ->capture_default_str();
  app.add_option("--spinning", flags.spinning, "spinning resistance of the rocks [1]")
      ->check(between(0, 2, "", "0 is usual"))
      ->capture_default_str();
}

engine::WorldOptions world_options(const EngineFlags& flags) {
  engine::WorldOptions options = flags.world;
  options.solver.method = engine::method_named(flags.method);
  options.contacts.narrow = engine::narrow_method_named(flags.narrow);
  return options;
}

nlohmann::json described(const engine::WorldOptions& options) {
  return {{"dt_s", options.step},
          {"method", to_string(options.solver.method)},
          {"substeps", options.solver.substeps},
          {"iterations", options.solver.iterations},
          {"iteration_budget", options.solver.iteration_budget},
          {"tolerance", options.solver.tolerance},
          {"narrow", to_string(options.contacts.narrow)},
          {"threads", options.threads}};
}

std::string in_words(const nlohmann::json& j) {
  std::ostringstream text;
  text << "dt " << 1e3 * j.at("dt_s").get<double>() << " ms, " << j.at("method").get<std::string>() << ", "
       << j.at("substeps") << " x " << j.at("iterations") << " iterations to "
       << j.at("tolerance").get<double>() << ", threads " << j.at("threads");
  return text.str();
}

void add_json_flag(CLI::App& app, bool& as_json) { app.add_flag("--json", as_json, "print one JSON object"); }

int show(const nlohmann::json& result, bool as_json,
         const std::function<void(const nlohmann::json&)>& print) {
  if (as_json)
    std::printf("%s\n", result.dump().c_str());
  else
    print(result);
  return 0;
}

int run_command(CLI::App& app, int argc, char** argv, const std::function<int()>& action) {
  const auto complain = [&](const char* what, int code) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), what);
    return code;
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    const std::string text = std::string(error.what()) + "; see " + app.get_name() + " --help";
    return complain(text.c_str(), wrong_usage);
  }
  try {
    const int code = action();
    if (std::fflush(stdout) == 0) return code;
    return complain("cannot write to standard output; is the disk full?", failure);
  } catch (const std::invalid_argument& error) {
    return complain(error.what(), wrong_usage);
  } catch (const std::exception& error) {
    return complain(error.what(), failure);
  }
}

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::show(const std::string& what, int done, int total) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || (done < total && now - shown_ < std::chrono::milliseconds(200))) return;
  shown_ = now;
  std::fprintf(stderr, "\r\033[K%s %d/%d", what.c_str(), done, total);
  std::fflush(stderr);
}

}  // namespace drawpoint::benchmarks
