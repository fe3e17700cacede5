// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <drawpoint/benchmarks/micro/evaluated_solve.hpp>
#include <drawpoint/benchmarks/micro/recorded_scenes.hpp>
#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <nlohmann/json.hpp>

/// Solves recorded contact problems by any method of the table and says how true and how fast.
///
/// usage: contact_problem info FILE | solve FILE [--method NAME ...] | compare FILE | record SCENE FILE
/// Every command takes --json. docs/contact-solving.md explains the numbers.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using engine::SolverOptions;
using engine::record::RecordedProblem;
using nlohmann::json;

namespace {

struct Arguments {
  std::string file, method = "sequential", scene;
  MethodOptions options = fixed_work(1, 25);
  int repeats = 5;
  bool as_json = false;
};

void print(const json& object, bool as_json) {
  if (as_json) {
    std::printf("%s\n", object.dump().c_str());
    return;
  }
  for (const auto& [name, value] : object.items())
    std::printf("%-26s %s\n", name.c_str(),
                (value.is_string() ? value.get<std::string>() : value.dump()).c_str());
}

json numbers(const Evaluation& j) {
  return {{"residual", j.residual.contacts()},
          {"complementarity", j.residual.complementarity},
          {"cone", j.residual.cone},
          {"moments", j.residual.moments},
          {"machine_rows", j.residual.rows},
          {"distance_to_converged", j.distance.velocities},
          {"impulse_distance_to_converged", j.distance.impulses},
          {"momentum_defect", j.momentum_defect},
          {"ms", j.milliseconds}};
}

void info(const Arguments& arguments) {
  const RecordedProblem recorded = engine::record::read_contact_problem(arguments.file);
  const auto& problem = recorded.problem;
  double stiffest = 0, deepest = 0;
  for (const auto& p : problem.points) {
    stiffest = std::max(stiffest, p.stiffness);
    deepest = std::max(deepest, -p.gap);
  }
  print({{"note", recorded.note},
         {"step_s", problem.step},
         {"bodies", problem.bodies.size()},
         {"pairs", problem.pairs.size()},
         {"contacts", problem.points.size()},
         {"deepest_overlap_m", deepest},
         {"greatest_stiffness_n_per_m", stiffest},
         {"machine_freedoms", problem.machine ? problem.machine->velocity.size() : 0},
         {"machine_rows", problem.machine ? problem.machine->rows.size() : 0}},
        arguments.as_json);
}

void solve(const Arguments& arguments) {
  const RecordedProblem recorded = engine::record::read_contact_problem(arguments.file);
  const ContactMethod method = contact_method(arguments.method);
  const auto converged = converged_solution(recorded.problem);
  json out = numbers(evaluate(recorded.problem, method, arguments.options, arguments.repeats, converged));
  out["method"] = method.name;
  out["contacts"] = recorded.problem.points.size();
  out["substeps"] = arguments.options.substeps;
  out["iterations"] = arguments.options.iterations;
  out["threads"] = arguments.options.threads;
  out["ns_per_contact_iteration"] =
      nanoseconds_per_point_and_iteration(recorded.problem, method, arguments.options, arguments.repeats);
  print(out, arguments.as_json);
}

// Every method over a ladder of work: iterations of whole steps, and substeps of one or two iterations.
void compare(const Arguments& arguments) {
  const RecordedProblem recorded = engine::record::read_contact_problem(arguments.file);
  const auto converged = converged_solution(recorded.problem);
  std::vector<std::pair<int, int>> ladder;  // substeps, iterations
  for (const int iterations : {1, 4, 16, 50, 150, 500}) ladder.emplace_back(1, iterations);
  for (const int substeps : {2, 4, 8, 16})
    for (const int iterations : {1, 2}) ladder.emplace_back(substeps, iterations);
  json all = json::array();
  if (!arguments.as_json)
    std::printf("%-12s %8s %6s %13s %9s %10s %10s %10s\n", "method", "substeps", "iterations",
                "point-iterations", "ms", "residual", "distance", "impulses");
  for (const ContactMethod& method : contact_methods())
    for (const auto& [substeps, iterations] : ladder) {
      if (substeps > 1 && !method.takes_substeps) continue;
      const MethodOptions options = fixed_work(substeps, iterations, arguments.options.threads);
      json row = numbers(evaluate(recorded.problem, method, options, arguments.repeats, converged));
      const auto work = recorded.problem.points.size() * substeps * iterations;
      row.update({{"method", method.name},
                  {"substeps", substeps},
                  {"iterations", iterations},
                  {"point_iterations", work}});
      if (!arguments.as_json)
        std::printf("%-12s %8d %6d %13zu %9.3f %10.2e %10.2e %10.2e\n", method.name.c_str(), substeps,
                    iterations, work, row["ms"].get<double>(), row["residual"].get<double>(),
                    row["distance_to_converged"].get<double>(),
                    row["impulse_distance_to_converged"].get<double>());
      all.push_back(std::move(row));
    }
  if (arguments.as_json) std::printf("%s\n", all.dump().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Solves recorded contact problems by any method");
  app.require_subcommand(1);
  const auto command = [&](const char* name, const char* help) {
    CLI::App* sub = app.add_subcommand(name, help);
    sub->add_flag("--json", arguments.as_json, "print JSON");
    return sub;
  };
  CLI::App* info_command = command("info", "what is in a file");
  CLI::App* solve_command = command("solve", "solve by one method");
  CLI::App* compare_command = command("compare", "every method over a ladder of work");
  CLI::App* record_command = command("record", "make a recorded problem");
  for (CLI::App* sub : {info_command, solve_command, compare_command})
    sub->add_option("file", arguments.file, "contact problem")->required();
  for (CLI::App* sub : {solve_command, compare_command}) {
    sub->add_option("--threads", arguments.options.threads);
    sub->add_option("--repeats", arguments.repeats,
                    "solves that are timed at least; more until 0.4 s have passed")
        ->capture_default_str();
  }
  solve_command->add_option("--method", arguments.method);
  solve_command->add_option("--iterations", arguments.options.iterations, "a substep");
  solve_command->add_option("--substeps", arguments.options.substeps);
  record_command->add_option("scene", arguments.scene, "settled_pile, bucket_full or bucket_at_breakout")
      ->required();
  record_command->add_option("file", arguments.file)->required();
  CLI11_PARSE(app, argc, argv);
  try {
    if (*info_command) info(arguments);
    if (*solve_command) solve(arguments);
    if (*compare_command) compare(arguments);
    if (*record_command) record_scene(arguments.scene, arguments.file);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contact_problem: %s\n", error.what());
    return 1;
  }
}
