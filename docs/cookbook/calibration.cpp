// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <cmath>
#include <cstdio>
#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/acquisition.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <fstream>
#include <stdexcept>

using namespace drawpoint;

const doe::Problem soil{.variables = {{"friction", "deg", 20.0, 45.0}, {"cohesion", "kPa", 0.0, 20.0}},
                        .responses = {{"residual", "kN2", doe::Goal::minimize}}};

// Measured: the force on a blade 2.8 m wide at five depths.
const double depth[] = {0.1, 0.2, 0.3, 0.4, 0.5}, measured[] = {7.7, 16.7, 28.2, 40.8, 56.0};  // m, kN

// A simulation in earnest: Rankine's passive pressure on the blade [kN].
double force(double d, const Eigen::VectorXd& x) {
  const double k = std::pow(std::tan((45.0 + 0.5 * x[0]) * std::acos(-1.0) / 180.0), 2);
  return 2.8 * (0.5 * 17.0 * k * d * d + 2.0 * x[1] * std::sqrt(k) * d);
}

// How far the simulator is from the measurements, as a mean square: smooth, where its root has a kink.
double residual(const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (int i = 0; i < 5; ++i) sum += std::pow(force(depth[i], x) - measured[i], 2);
  return sum / 5.0;
}

int main(int argc, char** argv) {
  const doe::Sampler improve = [](const doe::Evaluations& runs) {
    const auto model = kriging::fit(runs.X(), runs.y("residual"), {.nugget_power = 0.0});  // no noise
    return kriging::expected_improvement(model, doe::Goal::minimize);
  };
  doe::RefineOptions options{.max_points = 40};
  options.propose.batch = 1;  // each run decides on the next
  const doe::Refinement study = doe::refine(
      residual, soil, doe::optimized_latin_hypercube(soil, 12, {.corners = true}), improve, options);
  if (study.status != doe::RefineStatus::budget_spent) throw std::runtime_error(study.message);

  Eigen::Index best;
  const double least = study.runs.y("residual").minCoeff(&best);
  const Eigen::VectorXd x = study.runs.X().row(best);
  std::printf("friction %.0f deg, cohesion %.1f kPa, %.1f kN from the measurements\n", x[0], x[1],
              std::sqrt(least));

  std::ofstream csv(argc > 1 ? argv[1] : "calibration.csv");
  csv << "what,first,second,value\n";
  for (const doe::Evaluation& run : study.runs.rows)
    csv << "run," << run.x[0] << ',' << run.x[1] << ',' << run.outcome.values()[0] << '\n';
  for (int i = 0; i < 5; ++i) csv << "measured," << depth[i] << ",," << measured[i] << '\n';
  for (double d = 0.0; d < 0.56; d += 0.05) csv << "calibrated," << d << ",," << force(d, x) << '\n';
  return 0;
}
