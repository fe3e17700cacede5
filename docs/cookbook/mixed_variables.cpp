// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <cmath>
#include <cstdio>
#include <drawpoint/doe/bounds.hpp>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <fstream>
#include <stdexcept>

using namespace drawpoint;

const doe::Problem loading{.variables = {{"bucket", "m3", 3.0, 12.0},
                                         doe::integer_variable("passes", "1", 2, 8),
                                         doe::categorical_variable("lip", {"straight", "spade", "toothed"})},
                           .responses = {{"cost", "EUR/t", doe::Goal::minimize}}};

// A loader fills a truck in some passes; the truck is as large as they need, and dear if it is large.
double cost(const Eigen::VectorXd& x) {
  const double fill[] = {0.80, 0.95, 0.90}, resistance[] = {1.0, 1.1, 0.8}, wear[] = {10.0, 25.0, 60.0};
  const int lip = static_cast<int>(x[2]);
  const double payload = 1.6 * x[0] * x[1] * fill[lip];  // t
  const double hours = (x[1] * (25.0 + 0.4 * resistance[lip] * x[0] * x[0]) + 200.0) / 3600.0;
  return (200.0 + 15.0 * x[0] + 0.3 * std::pow(payload, 1.5) + wear[lip]) * hours /
         payload;  // EUR/h times h/t
}

int main(int argc, char** argv) {
  const doe::Evaluations runs = doe::evaluate(cost, loading, doe::optimized_latin_hypercube(loading, 60));
  const kriging::Model model = kriging::fit(runs.X(), runs.y("cost"), {.levels = doe::level_counts(loading)});
  if (model.status() != kriging::Status::converged) throw std::runtime_error(model.message());

  const pareto::Front found = pareto::nsga2(kriging::Surrogates({model}), loading,
                                            {.search = {.population = 60, .stopping = {.generations = 60}}});
  if (found.status != pareto::SearchStatus::completed) throw std::runtime_error(found.message);
  const Eigen::VectorXd x = found.X.row(0);
  std::printf("a bucket of %.0f m3, %.0f passes, %s lip\n", x[0], x[1],
              loading.variables[2].levels[static_cast<std::size_t>(x[2])].c_str());
  std::printf("predicted %.2f EUR/t, simulated %.3f EUR/t\n", found.Y(0, 0), cost(x));

  std::ofstream csv(argc > 1 ? argv[1] : "mixed_variables.csv");
  csv << "what,bucket,passes,lip,cost\n";
  for (const doe::Evaluation& run : runs.rows)
    csv << "run," << run.x[0] << ',' << run.x[1] << ',' << run.x[2] << ',' << run.outcome.values()[0] << '\n';
  for (int lip = 0; lip < 3; ++lip)
    for (double bucket = 3.0; bucket <= 12.0; bucket += 0.1) {
      const Eigen::Vector3d at(bucket, x[1], lip);
      csv << "model," << bucket << ',' << x[1] << ',' << lip << ',' << model(at) << '\n';
      csv << "exact," << bucket << ',' << x[1] << ',' << lip << ',' << cost(at) << '\n';
    }
  csv << "found," << x[0] << ',' << x[1] << ',' << x[2] << ',' << cost(x) << '\n';
  return 0;
}
