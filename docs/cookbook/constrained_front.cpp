// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <fstream>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace drawpoint;

const doe::Problem cutting{.variables = {{"depth", "m", 0.1, 0.6}, {"speed", "m/s", 0.3, 2.0}},
                           .responses = {{"production", "t/s", doe::Goal::maximize},
                                         {"power", "kW", doe::Goal::minimize},
                                         {"force", "kN", doe::Goal::at_most, 120.0}}};

// A bucket 3 m wide in rock of 1.8 t/m3; the force grows with the square of the depth.
doe::Outcome cut(const Eigen::VectorXd& x) {
  const double force = 80.0 + 500.0 * x[0] * x[0];
  return {3.0 * 1.8 * x[0] * x[1], force * x[1], force};
}

// The exact front: as deep as the limit allows, or, where little is wanted, as slow as the machine can.
double least_power(double production) {
  const double depth = std::min(std::sqrt((120.0 - 80.0) / 500.0), production / (3.0 * 1.8 * 0.3));
  return (80.0 + 500.0 * depth * depth) * production / (3.0 * 1.8 * depth);
}

int main(int argc, char** argv) {
  const doe::Evaluations runs =
      doe::evaluate(cut, cutting, doe::optimized_latin_hypercube(cutting, 24, {.corners = true}));
  std::vector<kriging::Model> models;
  for (const doe::Response& r : cutting.responses) {
    models.push_back(kriging::fit(runs.X(), runs.y(r.name)));
    if (models.back().status() != kriging::Status::converged)
      throw std::runtime_error(r.name + ": " + models.back().message());
  }

  const pareto::Front front = pareto::nsga2(kriging::Surrogates(models), cutting,
                                            {.search = {.population = 60, .stopping = {.generations = 150}}});
  if (front.status != pareto::SearchStatus::completed) throw std::runtime_error(front.message);

  // Simulate what was found: is it as good as it was said to be, and does it keep the limit?
  const doe::Evaluations confirmed = doe::evaluate(cut, cutting, front.X);
  const Eigen::VectorXd production = confirmed.y("production"), power = confirmed.y("power");
  std::printf("most production %.2f t/s at %.0f kW\n", production.maxCoeff(), power.maxCoeff());
  double excess = 0.0;
  for (int i = 0; i < power.size(); ++i)
    excess = std::max(excess, power[i] / least_power(production[i]) - 1.0);
  std::printf("power above the exact front at most %.0f %%\n", 100.0 * excess);
  std::printf("largest force %.1f kN, limit 120 kN\n", confirmed.y("force").maxCoeff());

  std::ofstream csv(argc > 1 ? argv[1] : "constrained_front.csv");
  csv << "what,production,power,force\n";
  for (const auto& [what, table] : {std::pair("run", &runs), std::pair("front", &confirmed)})
    for (const doe::Evaluation& row : table->rows)
      csv << what << ',' << row.outcome.values()[0] << ',' << row.outcome.values()[1] << ','
          << row.outcome.values()[2] << '\n';
  return 0;
}
