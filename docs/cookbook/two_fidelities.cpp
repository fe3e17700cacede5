// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <cmath>
#include <cstdio>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/fit_fidelities.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <fstream>
#include <stdexcept>

using namespace drawpoint;

const doe::Problem lifting{.variables = {{"angle", "deg", -40.0, 50.0}}, .responses = {{"torque", "kN m"}}};

// An hour per run: the torque of the boom over its angle.
double simulate(const Eigen::VectorXd& x) {
  const double a = x[0] * std::acos(-1.0) / 180.0;
  return 90.0 * std::cos(a) + 20.0 * std::sin(5.0 * a);
}

// A second per run: rigid, without friction, a fifth too low and off by what grows with the angle.
double estimate(const Eigen::VectorXd& x) {
  const double a = x[0] * std::acos(-1.0) / 180.0;
  return 0.8 * simulate(x) + 10.0 + 15.0 * a + 3.0 * std::sin(a) * a;
}

int main(int argc, char** argv) {
  const doe::Evaluations rough =
      doe::evaluate(estimate, lifting, doe::optimized_latin_hypercube(lifting, 25, {.corners = true}));
  const doe::Evaluations truth =
      doe::evaluate(simulate, lifting, doe::optimized_latin_hypercube(lifting, 6, {.corners = true}));

  const kriging::FidelityModel model = kriging::fit_fidelities(
      {{"estimate", rough.X(), rough.y("torque")}, {"simulation", truth.X(), truth.y("torque")}});
  for (const kriging::FidelityLevelReport& level : model.report().levels)
    if (level.fit.status != kriging::Status::converged) throw std::runtime_error(level.fit.message);
  const kriging::Model alone = kriging::fit(truth.X(), truth.y("torque"));

  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(181, -40.0, 50.0);
  Eigen::VectorXd exact(x.size());
  for (int i = 0; i < x.size(); ++i) exact[i] = simulate(x.segment(i, 1));
  std::printf("error with the estimates %.2f kN m, without %.0f kN m\n",
              kriging::validate(model, x, exact).rmse, kriging::validate(alone, x, exact).rmse);
  std::printf("the simulation is %.2f times the estimate, plus what differs\n",
              model.report().levels[1].rho[0]);

  std::ofstream csv(argc > 1 ? argv[1] : "two_fidelities.csv");
  csv << "what,angle,exact,both,deviation,alone,estimate\n";
  const kriging::Prediction p = model.predict(x);
  for (int i = 0; i < x.size(); ++i)
    csv << "curve," << x[i] << ',' << exact[i] << ',' << p.mean[i] << ',' << std::sqrt(p.variance[i]) << ','
        << alone(x.segment(i, 1)) << ',' << estimate(x.segment(i, 1)) << '\n';
  for (const doe::Evaluation& run : truth.rows)
    csv << "run," << run.x[0] << ',' << run.outcome.values()[0] << ",,,,\n";
  for (const doe::Evaluation& run : rough.rows)
    csv << "rough," << run.x[0] << ",,,,," << run.outcome.values()[0] << '\n';
  return 0;
}
