// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/python/black_box.h>
#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <optional>

/// Fronts, hypervolume and NSGA-II.

namespace drawpoint::python {

namespace {

py::dict dict_of(const pareto::Front& front) {
  py::dict result;
  result["X"] = front.X;
  result["Y"] = front.Y;
  result["responses"] = front.responses;
  result["objectives"] = front.objectives;
  result["evaluations"] = front.evaluations;
  result["failed"] = front.failed;
  result["generations"] = front.generations;
  result["stopped_by"] = std::string(to_string(front.stopped_by));
  result["status"] = std::string(to_string(front.status));
  result["message"] = front.message;
  return result;
}

py::dict searched(const py::object& f, const doe::Problem& problem, std::optional<int> population,
                  int generations, std::optional<int> evaluations, doe::Seed seed,
                  const Eigen::MatrixXd& start, bool vectorized, bool seeded) {
  Interrupt interrupt;
  pareto::Nsga2Options options;
  options.search.population = population;
  options.search.stopping.generations = generations;
  options.search.stopping.evaluations = evaluations;
  options.search.seed = seed;
  options.search.start = start;
  options.search.stop = interrupt.token();
  const Batch batch = batch_of("pareto::nsga2: ", f, vectorized, seeded, problem, interrupt);
  return dict_of(interrupt.run(false, [&] { return pareto::nsga2(batch, problem, options); }));
}

}  // namespace

void bind_searches(py::module_& m) {
  using Points = const Eigen::MatrixXd&;
  using Reference = const Eigen::VectorXd&;
  m.def("nsga2", &searched);
  m.def(
      "non_dominated", [](Points Y) { return pareto::non_dominated(Y); }, ReleaseGil());
  m.def(
      "non_dominated_sort", [](Points Y) { return pareto::non_dominated_sort(Y); }, ReleaseGil());
  m.def(
      "hypervolume", [](Points Y, Reference r) { return pareto::hypervolume(Y, r); }, ReleaseGil());
  m.def(
      "hypervolume_contributions",
      [](Points Y, Reference r) { return pareto::hypervolume_contributions(Y, r); }, ReleaseGil());
}

}  // namespace drawpoint::python
