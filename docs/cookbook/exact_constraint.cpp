// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <cstdio>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <fstream>
#include <stdexcept>

using namespace drawpoint;

const std::vector<doe::Variable> bucket{{"width", "m", 2.0, 4.0}, {"length", "m", 1.2, 2.8}};

// A simulation in earnest: resistance of the bucket in the pile [kN].
double resistance(const Eigen::VectorXd& x) { return 40.0 * x[0] + 15.0 * x[1] * x[1]; }

// Known exactly and at once: a wedge 1.2 m high [m3].
double volume(const Eigen::VectorXd& x) { return 0.5 * 1.2 * x[0] * x[1]; }

int main(int argc, char** argv) {
  const doe::Problem simulated{.variables = bucket, .responses = {{"resistance", "kN"}}};
  const doe::Evaluations runs =
      doe::evaluate(resistance, simulated, doe::optimized_latin_hypercube(simulated, 16, {.corners = true}));
  const kriging::Model model = kriging::fit(runs.X(), runs.y("resistance"));
  if (model.status() != kriging::Status::converged) throw std::runtime_error(model.message());

  // What is searched: the model of what is dear beside the formula of what is not.
  const doe::Problem searched{
      .variables = bucket,
      .responses = {{"resistance", "kN", doe::Goal::minimize}, {"volume", "m3", doe::Goal::at_least, 4.0}}};
  const auto both = [&](const Eigen::VectorXd& x) { return doe::Outcome{model(x), volume(x)}; };
  const pareto::Front found =
      pareto::nsga2(both, searched, {.search = {.population = 60, .stopping = {.generations = 100}}});
  if (found.status != pareto::SearchStatus::completed) throw std::runtime_error(found.message);
  const Eigen::VectorXd x = found.X.row(0);
  std::printf("width %.1f m, length %.1f m\n", x[0], x[1]);
  std::printf("resistance %.0f kN predicted, %.0f kN simulated; volume %.2f m3\n", found.Y(0, 0),
              resistance(x), volume(x));

  std::ofstream csv(argc > 1 ? argv[1] : "exact_constraint.csv");
  csv << "what,width,length,resistance,volume\n";
  for (const doe::Evaluation& run : runs.rows)
    csv << "run," << run.x[0] << ',' << run.x[1] << ',' << run.outcome.values()[0] << ",\n";
  for (double width = 2.0; width <= 4.001; width += 0.05)
    for (double length = 1.2; length <= 2.801; length += 0.05) {
      const Eigen::Vector2d at(width, length);
      csv << "model," << width << ',' << length << ',' << model(at) << ',' << volume(at) << '\n';
    }
  csv << "found," << x[0] << ',' << x[1] << ',' << resistance(x) << ',' << volume(x) << '\n';
  return volume(x) >= 4.0 ? 0 : 1;  // to the last digit
}
