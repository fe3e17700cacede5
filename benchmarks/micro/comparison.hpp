// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/benchmarks/micro/evaluated_solve.hpp>
#include <string>
#include <vector>

/// Methods on one problem over ladders of work, and the picture of it.
///
/// Whole steps (S = 1) get up to 500 iterations; methods that take substeps also 16 of them, the engine's default,
/// with up to 40 iterations each. Residuals and distances belong to their S: to the law of a step or of a substep,
/// and to the limit of as many substeps.
namespace drawpoint::benchmarks {

struct Measured {
  std::string method;
  int substeps = 1, iterations = 1;  ///< per substep
  Evaluation evaluation;
};

/// In the order of methods, substeps, iterations. `each` sees every row when it is there.
template <class Each>
std::vector<Measured> compare(const engine::ContactProblem& problem,
                              const std::vector<ContactMethod>& methods, ConvergedSolutions& converged,
                              int threads, int repeats, const Each& each) {
  const std::vector<int> of_steps{1, 4, 16, 50, 150, 500}, of_substeps{1, 2, 5, 10, 20, 40};
  std::vector<Measured> rows;
  for (const ContactMethod& method : methods)
    for (const int substeps : {1, 16}) {
      if (substeps > 1 && !method.takes_substeps) continue;
      for (const int iterations : substeps == 1 ? of_steps : of_substeps) {
        const MethodOptions options = fixed_work(substeps, iterations, threads);
        rows.push_back({method.name, substeps, iterations,
                        evaluate(problem, method, options, repeats, converged.of(substeps))});
        each(rows.back());
      }
    }
  return rows;
}

/// A method with its number of substeps, as "batched, S = 16".
std::string series_name(const Measured& row);

/// For each series and each time [ms] the row of least distance that took no longer; nullptr: none did.
struct Best {
  std::string series;
  std::vector<const Measured*> within;
};
std::vector<Best> best_within(const std::vector<Measured>& rows, const std::vector<double>& times);

/// An SVG picture: residual and distance against time, log-log, one line per series with its name at its end. Light
/// and dark by what the viewer prefers.
std::string comparison_svg(const std::vector<Measured>& rows, const std::string& title);

}  // namespace drawpoint::benchmarks
