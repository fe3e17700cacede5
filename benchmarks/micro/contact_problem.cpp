// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <drawpoint/benchmarks/micro/comparison.hpp>
#include <drawpoint/benchmarks/micro/recorded_scenes.hpp>
#include <drawpoint/engine/base/atomic_file.hpp>
#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

/// Solves recorded contact problems by any method of the table and says how true and how fast.
///
/// usage: contact_problem info FILE | solve FILE [--method NAME ...] | compare FILE... [--method NAME...] [--svg FILE]
/// | converge FILE | export FILE OUT | import FILE OUT | record SCENE FILE info, solve, compare and converge take
/// --json. docs/explanation/contact-solving.md explains the numbers.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using engine::record::RecordedProblem;
using nlohmann::json;

namespace {

struct Arguments {
  std::string file, method = "sequential", scene, target, svg;
  MethodOptions options = fixed_work(1, 25);
  std::vector<std::string> files, methods;  // of compare
  std::vector<int> substeps{1, 16};
  int repeats = 5, most_iterations = 96000;
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

struct Extent {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  void add(double x) { least = std::min(least, x), most = std::max(most, x); }
  json numbers() const { return most < least ? json() : json{least, most}; }
};

void info(const Arguments& arguments) {
  const RecordedProblem recorded = engine::record::read_contact_problem(arguments.file);
  const auto& problem = recorded.problem;
  Extent mass, stiffness, friction, rolling, spinning;
  double deepest = 0;
  for (const auto& b : problem.bodies)
    if (b.inverse_mass > 0) mass.add(1 / b.inverse_mass);
  for (const auto& p : problem.points) {
    stiffness.add(p.stiffness);
    friction.add(p.friction);
    deepest = std::max(deepest, -p.gap);
  }
  for (const auto& p : problem.pairs) rolling.add(p.rolling_arm), spinning.add(p.spinning_arm);
  print({{"note", recorded.note},
         {"step_s", problem.step},
         {"bodies", problem.bodies.size()},
         {"pairs", problem.pairs.size()},
         {"contacts", problem.points.size()},
         {"body_mass_kg", mass.numbers()},
         {"friction", friction.numbers()},
         {"rolling_arm_m", rolling.numbers()},
         {"spinning_arm_m", spinning.numbers()},
         {"stiffness_n_per_m", stiffness.numbers()},
         {"deepest_overlap_m", deepest},
         {"machine_freedoms", problem.machine ? problem.machine->velocity.size() : 0},
         {"machine_rows", problem.machine ? problem.machine->rows.size() : 0}},
        arguments.as_json);
}

void say_fault(const ConvergedSolutions& solutions) {
  if (!solutions.fault().empty())
    std::fprintf(stderr, "contact_problem: %s; computed here instead\n", solutions.fault().c_str());
}

void solve(const Arguments& arguments) {
  const RecordedProblem recorded = engine::record::read_contact_problem(arguments.file);
  const ContactMethod method = contact_method(arguments.method);
  ConvergedSolutions solutions(recorded.problem, solution_file(arguments.file));
  say_fault(solutions);
  const Converged& converged = solutions.of(std::max(1, arguments.options.substeps));
  json out = numbers(evaluate(recorded.problem, method, arguments.options, arguments.repeats, converged));
  out["uncertainty_of_converged"] = converged.uncertainty;
  out["residual_of_converged"] = converged.residual.contacts();
  out["method"] = method.name;
  out["contacts"] = recorded.problem.points.size();
  out["substeps"] = arguments.options.substeps;
  out["iterations"] = arguments.options.iterations;
  out["threads"] = arguments.options.threads;
  out["ns_per_contact_iteration"] =
      nanoseconds_per_point_and_iteration(recorded.problem, method, arguments.options, arguments.repeats);
  print(out, arguments.as_json);
}

void print_at_equal_time(const std::vector<Measured>& rows) {
  const std::vector<double> times{1, 3, 10, 30, 100, 300, 1000};
  std::printf("\nleast distance (and its residual) within a time\n%-28s", "");
  for (const double time : times) std::printf(" %14.0f ms", time);
  for (const Best& best : best_within(rows, times)) {
    std::printf("\n%-28s", best.series.c_str());
    for (const Measured* row : best.within)
      if (row)
        std::printf(" %8.1e %8.1e", row->evaluation.distance.velocities, row->evaluation.residual.contacts());
      else
        std::printf(" %17s", "-");
  }
  std::printf("\n");
}

std::vector<ContactMethod> chosen_methods(const std::vector<std::string>& names) {
  std::vector<ContactMethod> methods;
  for (const std::string& name : names) methods.push_back(contact_method(name));
  return names.empty() ? contact_methods() : methods;
}

// The rows of one set, which are printed or put into `all`.
void compare_methods(const Arguments& arguments, const std::string& file, json& all) {
  const RecordedProblem recorded = engine::record::read_contact_problem(file);
  const std::size_t points = recorded.problem.points.size();
  ConvergedSolutions converged(recorded.problem, solution_file(file));
  say_fault(converged);
  if (!arguments.as_json && arguments.files.size() > 1) std::printf("\n%s\n", file.c_str());
  if (!arguments.as_json)
    std::printf("%-22s %8s %10s %15s %9s %10s %10s %10s\n", "method", "substeps", "iterations",
                "point-iterations", "ms", "residual", "distance", "impulses");
  const auto show = [&](const Measured& row) {
    const Evaluation& e = row.evaluation;
    const auto work = points * row.substeps * row.iterations;
    if (!arguments.as_json)
      std::printf("%-22s %8d %10d %15zu %9.3f %10.2e %10.2e %10.2e\n", row.method.c_str(), row.substeps,
                  row.iterations, work, e.milliseconds, e.residual.contacts(), e.distance.velocities,
                  e.distance.impulses);
    all.push_back(numbers(e));
    all.back().update({{"method", row.method},
                       {"substeps", row.substeps},
                       {"iterations", row.iterations},
                       {"point_iterations", work}});
    if (arguments.files.size() > 1) all.back()["set"] = file;
  };
  const auto rows = compare(recorded.problem, chosen_methods(arguments.methods), converged,
                            arguments.options.threads, arguments.repeats, show);
  if (!arguments.as_json) print_at_equal_time(rows);
  if (arguments.svg.empty()) return;
  const std::string svg = comparison_svg(rows, recorded.note + ": " + std::to_string(points) + " points");
  engine::write_atomically(arguments.svg, std::as_bytes(std::span(svg)));
}

void compare_sets(const Arguments& arguments) {
  if (!arguments.svg.empty() && arguments.files.size() > 1)
    throw std::invalid_argument("--svg is the picture of one set; " + std::to_string(arguments.files.size()) +
                                " are given: ask for one at a time");
  chosen_methods(arguments.methods);  // before anything takes long
  json all = json::array();
  for (const std::string& file : arguments.files) compare_methods(arguments, file, all);
  if (arguments.as_json) std::printf("%s\n", all.dump().c_str());
}

void write_solutions(const Arguments& arguments) {
  const RecordedProblem recorded = engine::record::read_contact_problem(arguments.file);
  std::vector<Converged> solutions;
  json all = json::array();
  for (const int substeps : arguments.substeps) {
    const Converged& c =
        solutions.emplace_back(converge(recorded.problem, substeps, arguments.most_iterations));
    all.push_back({{"substeps", c.substeps},
                   {"most_iterations_per_substep", c.iterations},
                   {"last_change", c.last_change},
                   {"residual", c.residual.contacts()},
                   {"uncertainty", c.uncertainty},
                   {"machine_rows", c.residual.rows}});
    const Solved &first = solutions.front().solved, &now = c.solved;
    all.back()["distance_to_first"] =
        distance(now.problem, now.report.machine, first.problem, first.report.machine).velocities;
    if (!arguments.as_json) print(all.back(), false);
  }
  const auto file = arguments.target.empty() ? solution_file(arguments.file).string() : arguments.target;
  write_converged(file, recorded.problem, solutions);
  if (arguments.as_json) std::printf("%s\n", all.dump().c_str());
}

void export_plain(const Arguments& arguments) {
  const RecordedProblem recorded = engine::record::read_contact_problem(arguments.file);
  engine::record::export_contact_problem(arguments.target, recorded.problem, recorded.note);
}

void import_plain(const Arguments& arguments) {
  const RecordedProblem recorded = engine::record::import_contact_problem(arguments.file);
  engine::record::write_contact_problem(arguments.target, recorded.problem, recorded.note);
}

std::string scenes() {
  std::string text;
  for (const std::string& name : scene_names()) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none in this build" : text;
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
  CLI::App* compare_command = command("compare", "methods over a ladder of work");
  CLI::App* converge_command = command("converge", "write the converged solution beside a file");
  CLI::App* export_command = command("export", "write as a plain file for other programs");
  CLI::App* import_command = command("import", "check a plain file and write it as a checksummed one");
  CLI::App* record_command = command("record", "make a recorded problem");
  for (CLI::App* sub : {info_command, solve_command, converge_command, export_command, import_command})
    sub->add_option("file", arguments.file, "contact problem")->required();
  compare_command->add_option("files", arguments.files, "contact problems")->required();
  for (CLI::App* sub : {solve_command, compare_command}) {
    sub->add_option("--threads", arguments.options.threads);
    sub->add_option("--repeats", arguments.repeats,
                    "solves that are timed at least; more until 0.4 s have passed")
        ->capture_default_str();
  }
  for (CLI::App* sub : {export_command, import_command})
    sub->add_option("out", arguments.target, "file to write")->required();
  solve_command->add_option("--method", arguments.method);
  solve_command->add_option("--iterations", arguments.options.iterations, "a substep");
  solve_command->add_option("--substeps", arguments.options.substeps);
  compare_command
      ->add_option("--method", arguments.methods, "these alone, with commas between; all of the table else")
      ->delimiter(',');
  compare_command->add_option("--svg", arguments.svg, "picture to write");
  converge_command->add_option("--out", arguments.target, "file to write instead of FILE's .solution.h5");
  converge_command->add_option("--substeps", arguments.substeps, "one solution for each")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  converge_command->add_option("--iterations", arguments.most_iterations, "at most, of all substeps together")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  record_command->add_option("scene", arguments.scene, scenes())->required();
  record_command->add_option("file", arguments.file)->required();
  CLI11_PARSE(app, argc, argv);
  try {
    if (*info_command) info(arguments);
    if (*solve_command) solve(arguments);
    if (*compare_command) compare_sets(arguments);
    if (*converge_command) write_solutions(arguments);
    if (*export_command) export_plain(arguments);
    if (*import_command) import_plain(arguments);
    if (*record_command) record_scene(arguments.scene, arguments.file);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contact_problem: %s\n", error.what());
    return 1;
  }
}
