// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/benchmarks/micro/converged_solution.hpp>
#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <drawpoint/engine/record/file.hpp>
#include <drawpoint/engine/solver/solver.hpp>
#include <limits>
#include <stdexcept>

namespace drawpoint::benchmarks {
namespace {

using namespace engine;
using record::Reader;
using record::Writer;

const record::FileKind solution_kind{"drawpoint contact solution", 1};
constexpr int computed_iterations = 16000;  // of all substeps, where no file has the solution

std::string hash_text(const ContactProblem& problem) { return std::to_string(record::problem_hash(problem)); }

template <class T, class Items, class Get>
std::vector<T> numbers_of(const Items& items, Get get) {
  std::vector<T> values;
  for (const auto& item : items)
    for (const double x : get(item)) values.push_back(static_cast<T>(x));
  return values;
}

template <class T>
void write(Writer& file, const std::string& path, const std::vector<T>& values, std::size_t width,
           const std::string& unit, const std::string& description) {
  file.array(path, std::span<const T>(values), {values.size() / width, width});
  file.describe(path, unit, description);
}

void write(Writer& file, const Converged& c) {
  const std::string group = "substeps_" + std::to_string(c.substeps) + "/";
  file.integer(group, "substeps", c.substeps);
  file.integer(group, "most iterations per substep", c.iterations);
  file.number(group, "last change", c.last_change);
  file.number(group, "uncertainty", c.uncertainty);
  file.number(group, "residual complementarity", c.residual.complementarity);
  file.number(group, "residual cone", c.residual.cone);
  file.number(group, "residual moments", c.residual.moments);
  file.number(group, "residual rows", c.residual.rows);
  const ContactProblem& p = c.solved.problem;
  write(file, group + "velocity",
        numbers_of<double>(
            p.bodies, [](const auto& b) -> const auto& { return b.velocity; }),
        3, "m/s", "of the bodies after the step");
  write(file, group + "angular_velocity",
        numbers_of<double>(
            p.bodies, [](const auto& b) -> const auto& { return b.angular_velocity; }),
        3, "rad/s", "of the bodies after the step");
  write(file, group + "impulse",
        numbers_of<float>(
            p.points, [](const auto& q) -> const auto& { return q.impulse; }),
        3, "N s", "of the points on b over the step");
  write(file, group + "moment",
        numbers_of<float>(
            p.pairs, [](const auto& q) -> const auto& { return q.impulse; }),
        3, "N m s", "of the pairs on b over the step");
  if (!p.machine) return;
  const SuperBodySolution& machine = c.solved.report.machine;
  const std::vector<double> w(machine.velocity.data(), machine.velocity.data() + machine.velocity.size());
  write(file, group + "machine_velocity", w, 1, "sqrt(kg) m/s", "w after the step");
  write(file, group + "row_impulses", machine.row_impulses, 1, "N s or N m s",
        "of the machine's motors and stops over the step");
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& fault) {
  throw std::runtime_error("converged solution " + path.string() + ": " + fault +
                           "; make it anew: contact_problem converge");
}

template <class T>
std::vector<T> counted(const std::filesystem::path& path, record::Array<T> read, std::size_t rows,
                       std::size_t width) {
  if (read.shape != std::vector<std::size_t>{rows, width})
    refuse(path, "an array has not the problem's size");
  return std::move(read.values);
}

template <class T, class Items, class Get>
void fill(Items& items, const std::vector<T>& values, Get get) {
  for (std::size_t k = 0; k < items.size(); ++k)
    for (Eigen::Index i = 0; i < 3; ++i) get(items[k])[i] = static_cast<double>(values[3 * k + i]);
}

// A whole step's solution must leave the residual that it left when it was made. Impulses in float32 change it by some
// 1e-7, a point that they push over a jump of the law by its own share of the load.
Converged of_todays_law(const std::filesystem::path& path, const Converged& c) {
  constexpr double allowed = 1e-4;
  if (c.substeps != 1) return c;
  Solved solved = c.solved;
  for (SolverBody& body : solved.problem.bodies) {
    body.displacement = solved.problem.step * body.velocity;
    body.rotation_vector = solved.problem.step * body.angular_velocity;
  }
  for (ContactPoint& point : solved.problem.points) point.start = point.impulse;
  for (ContactPair& pair : solved.problem.pairs) pair.start = pair.impulse;
  SuperBodySolution& machine = solved.report.machine;
  machine.mean_velocity = machine.velocity;
  machine.row_starts = machine.row_impulses;
  const double today = residual(solved.problem, machine, 1).contacts();
  if (!(std::abs(today - c.residual.contacts()) < allowed))
    refuse(path, "its residual is " + std::to_string(today) + ", not " +
                     std::to_string(c.residual.contacts()) + ": the law of contacts has changed");
  return c;
}

Converged read(const Reader& file, const std::string& name, const ContactProblem& problem) {
  const std::filesystem::path& path = file.path();
  Converged c;
  c.substeps = static_cast<int>(file.integer(name, "substeps"));
  c.iterations = static_cast<int>(file.integer(name, "most iterations per substep"));
  c.last_change = file.number(name, "last change");
  c.uncertainty = file.number(name, "uncertainty");
  c.residual = {file.number(name, "residual complementarity"), file.number(name, "residual cone"),
                file.number(name, "residual moments"), file.number(name, "residual rows")};
  ContactProblem& p = c.solved.problem;
  p = problem;
  const auto doubles = [&](const char* field, std::size_t rows, std::size_t width) {
    return counted(path, file.doubles(name + "/" + field), rows, width);
  };
  const auto floats = [&](const char* field, std::size_t rows) {
    return counted(path, file.floats(name + "/" + field), rows, 3);
  };
  fill(
      p.bodies, doubles("velocity", p.bodies.size(), 3), [](auto& b) -> auto& { return b.velocity; });
  fill(
      p.bodies, doubles("angular_velocity", p.bodies.size(), 3),
      [](auto& b) -> auto& { return b.angular_velocity; });
  fill(
      p.points, floats("impulse", p.points.size()), [](auto& q) -> auto& { return q.impulse; });
  fill(
      p.pairs, floats("moment", p.pairs.size()), [](auto& q) -> auto& { return q.impulse; });
  if (!p.machine) return of_todays_law(path, c);
  const auto w = doubles("machine_velocity", static_cast<std::size_t>(p.machine->velocity.size()), 1);
  c.solved.report.machine.velocity =
      Eigen::Map<const Eigen::VectorXd>(w.data(), static_cast<Eigen::Index>(w.size()));
  c.solved.report.machine.row_impulses = doubles("row_impulses", p.machine->rows.size(), 1);
  return of_todays_law(path, c);
}

Solved solved_by(const ContactProblem& problem, int substeps, int iterations) {
  constexpr double settled = 1e-14;
  SolverOptions options{.method = Method::sequential, .substeps = substeps, .tolerance = settled};
  const double budget = static_cast<double>(iterations) * static_cast<double>(problem.points.size());
  options.iteration_budget = static_cast<int>(std::min<double>(budget, std::numeric_limits<int>::max()));
  Solved solved{problem, {}};
  solved.report = solve(solved.problem, options);
  return solved;
}

}  // namespace

Converged converge(const ContactProblem& problem, int substeps, int most_iterations) {
  Converged c;
  c.substeps = substeps;
  c.iterations = std::max(1, most_iterations / substeps);
  c.solved = solved_by(problem, substeps, c.iterations);
  const ContactProblem& solved = c.solved.problem;
  const SuperBodySolution& machine = c.solved.report.machine;
  c.last_change = c.solved.report.last_change;
  c.residual = residual(solved, machine, substeps);
  const Solved half = solved_by(problem, substeps, std::max(1, c.iterations / 2));
  c.uncertainty = distance(half.problem, half.report.machine, solved, machine).velocities;
  return c;
}

std::filesystem::path solution_file(const std::filesystem::path& problem_file) {
  std::filesystem::path file = problem_file;
  return file.replace_extension(".solution.h5");
}

void write_converged(const std::filesystem::path& path, const ContactProblem& problem,
                     const std::vector<Converged>& solutions) {
  Writer file(path, solution_kind);
  file.text("/", "problem", hash_text(problem));
  for (const Converged& solution : solutions) write(file, solution);
  file.commit();
}

std::vector<Converged> read_converged(const std::filesystem::path& path, const ContactProblem& problem) {
  const Reader file(path, solution_kind);
  if (file.text("/", "problem") != hash_text(problem)) refuse(path, "it is of another problem");
  std::vector<Converged> solutions;
  for (const std::string& name : file.children("/")) solutions.push_back(read(file, name, problem));
  return solutions;
}

ConvergedSolutions::ConvergedSolutions(const ContactProblem& problem, const std::filesystem::path& file)
    : problem_(problem) {
  if (!std::filesystem::exists(file)) return;
  try {
    for (Converged& c : read_converged(file, problem)) known_[c.substeps] = std::move(c);
  } catch (const std::runtime_error& error) {
    fault_ = error.what();
  }
}

const Converged& ConvergedSolutions::of(int substeps) {
  const auto found = known_.find(substeps);
  if (found != known_.end()) return found->second;
  return known_[substeps] = converge(problem_, substeps, computed_iterations);
}

}  // namespace drawpoint::benchmarks
