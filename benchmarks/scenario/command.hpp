// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <drawpoint/engine/world/world.hpp>
#include <drawpoint/tests/support/rock_pile.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

/// What the commands of this folder share: the flags that choose the engine's step and solver, checked
/// numbers, exit codes and progress.
///
/// Exit codes: 0 done, 1 the run failed (its message is on stderr), 2 wrong usage. Results go to stdout: a
/// table, or with --json one JSON object on one line. Progress goes to stderr, and only to a terminal.
namespace drawpoint::benchmarks {

/// Accepts numbers from low to high; the error names the value, the range and what to choose.
CLI::Validator between(double low, double high, const std::string& unit, const std::string& advice);

/// Accepts one of a preset's names; the error lists them.
CLI::Validator one_of(std::span<const std::string_view> names);

/// For check(): what `parse` throws as std::invalid_argument against a text is the error; what it takes is right.
std::function<std::string(const std::string&)> taken_by(std::function<void(const std::string&)> parse);

/// The flags; the defaults are those of WorldOptions{}.
struct EngineFlags {
  engine::WorldOptions world;
  std::string method, narrow;
};

void add_engine_flags(CLI::App& app, EngineFlags& flags);
/// Adds --method, --narrow and --threads alone.
void add_method_flags(CLI::App& app, EngineFlags& flags);
/// The world's options as the flags choose them; --threads holds for contact finding and solving.
engine::WorldOptions world_options(const EngineFlags& flags);
/// The two coefficients of rocks on everything that studies of materials vary.
struct MaterialFlags {
  double rolling = support::PileMaterial{}.rolling, spinning = support::PileMaterial{}.spinning;  ///< [1]

  /// The material of the pile scene with them.
  support::PileMaterial pile() const {
    support::PileMaterial material;
    material.rolling = rolling;
    material.spinning = spinning;
    return material;
  }
};

/// --rolling and --spinning; the defaults are what `flags` holds.
void add_material_flags(CLI::App& app, MaterialFlags& flags);

/// The options as they go into the results.
nlohmann::json described(const engine::WorldOptions& options);
/// "dt 5 ms, sequential, 1 x 25 iterations to 1e-05, threads 1", from described().
std::string in_words(const nlohmann::json& described);

/// --json, whose help it is.
void add_json_flag(CLI::App& app, bool& as_json);
/// Writes a result: one JSON object on one line, or the table that `print` makes of it. Returns the exit code.
int show(const nlohmann::json& result, bool as_json, const std::function<void(const nlohmann::json&)>& print);

/// Parses, acts and turns what goes wrong into an exit code.
int run_command(CLI::App& app, int argc, char** argv, const std::function<int()>& action);

/// One line on a terminal, rewritten at most five times per second: "settle 120/500".
class Progress {
 public:
  Progress();
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const std::string& what, int done, int total);

 private:
  bool terminal_;
  std::chrono::steady_clock::time_point shown_{};
};

}  // namespace drawpoint::benchmarks
