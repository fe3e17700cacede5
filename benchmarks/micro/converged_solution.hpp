// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_problem.hpp>
#include <drawpoint/engine/solver/residual.hpp>
#include <drawpoint/engine/solver/solution_distance.hpp>
#include <drawpoint/engine/solver/solver_report.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// What the methods converge to: the sequential method's solution after very many iterations.
///
/// Each number S of substeps has a solution of its own, since substeps are another discretisation of the same step;
/// a distance between methods of one S is then an error of iteration alone. Iterations end when one changes less
/// than 1e-14 of the load. Solutions of a problem PROBLEM.h5 are kept in PROBLEM.solution.h5 with the hash of the
/// problem, so that they are never taken for those of another one. Format "drawpoint contact solution", version 1,
/// by record/file.hpp: a group "substeps_S" for each, velocities in float64, impulses in float32, whose round-off
/// of 6e-8 is far below the errors that are measured with them.
namespace drawpoint::benchmarks {

struct Solved {
  engine::ContactProblem problem;
  engine::SolverReport report;
};

struct Converged {
  Solved
      solved;  ///< velocities, and impulses over the step; displacements and starts only if not from a file
  int substeps = 1, iterations = 0;  ///< at most so many iterations per substep
  double last_change = 0;            ///< Σ|Δλ| of the last iteration over Σ λ_n
  engine::Residual residual;
  /// Distance::velocities of the solution after half as many iterations from this one: how well the limit is known.
  /// It need not become round-off. A substep may go either of two ways where an approach is about that of an impact,
  /// and friction may have several solutions.
  double uncertainty = 0;
};

/// With at most so many iterations of all substeps together. Cost: with the solution of half as many, for the
/// uncertainty, about 140 ns per point and iteration.
Converged converge(const engine::ContactProblem& problem, int substeps, int most_iterations);

/// PROBLEM.solution.h5 beside PROBLEM.h5.
std::filesystem::path solution_file(const std::filesystem::path& problem_file);

/// One per number of substeps. Throws std::runtime_error if the file cannot be written.
void write_converged(const std::filesystem::path& file, const engine::ContactProblem& problem,
                     const std::vector<Converged>& solutions);

/// Throws std::runtime_error if the file cannot be read, is of another problem, or solves another law than today's.
std::vector<Converged> read_converged(const std::filesystem::path& file,
                                      const engine::ContactProblem& problem);

/// The converged solutions of one problem: those in the file, if it is there and fits; others are computed when asked
/// for.
class ConvergedSolutions {
 public:
  /// Keeps a reference to the problem.
  ConvergedSolutions(const engine::ContactProblem& problem, const std::filesystem::path& file);
  const Converged& of(int substeps);
  const std::map<int, Converged>& known() const { return known_; }
  const std::string& fault() const {
    return fault_;
  }  ///< why the file is not used; empty: it is, or is not there

 private:
  const engine::ContactProblem& problem_;
  std::map<int, Converged> known_;
  std::string fault_;
};

}  // namespace drawpoint::benchmarks
