// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Comfort or grip? The whole way from a simulator to a confirmed front, with all three modules: a first
// design, models that are fitted and scored, further runs until the scores hold, the front of the models, and
// its points simulated.
//
// A quarter of a car (body 350 kg, wheel 40 kg) runs over a bump of 5 cm in 1 m at 10 m/s.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/pareto/nsga2.hpp>

using namespace drawpoint;

namespace {

const doe::Problem car{.variables = {{"spring", "N/m", 10e3, 60e3}, {"damper", "N s/m", 500.0, 5000.0}},
                       .responses = {{"body_acceleration", "m/s2", doe::Goal::minimize},
                                     {"tyre_force_variation", "N", doe::Goal::minimize},
                                     {"travel", "m", doe::Goal::at_most, 0.06}}};

struct Quarter {
  double spring, damper, tyre = 200e3, body_mass = 350.0, wheel_mass = 40.0;

  static double road(double t) {
    return t < 0.1 ? 0.025 * (1.0 - std::cos(2.0 * std::acos(-1.0) * t / 0.1)) : 0.0;
  }
  // State: body and wheel, heights [m] and speeds [m/s].
  Eigen::Array4d change(const Eigen::Array4d& s, double t) const {
    const double strut = spring * (s[1] - s[0]) + damper * (s[3] - s[2]), ground = tyre * (road(t) - s[1]);
    return {s[2], s[3], strut / body_mass, (ground - strut) / wheel_mass};
  }
};

// Root mean squares over 2 s and the largest travel, by the classical Runge-Kutta method in steps of 1 ms.
doe::Outcome simulate(const Eigen::VectorXd& x) {
  const Quarter q{x[0], x[1]};
  const double dt = 1e-3;
  const int steps = 2000;
  Eigen::Array4d s = Eigen::Array4d::Zero();
  double acceleration = 0.0, force = 0.0, travel = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double t = i * dt;
    const Eigen::Array4d a = q.change(s, t), b = q.change(s + 0.5 * dt * a, t + 0.5 * dt);
    const Eigen::Array4d c = q.change(s + 0.5 * dt * b, t + 0.5 * dt), d = q.change(s + dt * c, t + dt);
    s += dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    acceleration += a[2] * a[2] / steps;
    force += std::pow(q.tyre * (q.road(t) - s[1]), 2) / steps;
    travel = std::max(travel, std::abs(s[1] - s[0]));
  }
  return {std::sqrt(acceleration), std::sqrt(force), travel};
}

// The error of the models beside what was then simulated, as a share of the simulated range; the worst
// response.
double front_error(const pareto::Front& front, const doe::Evaluations& confirmed) {
  double worst = 0.0;
  for (std::size_t j = 0; j < 2; ++j) {
    const Eigen::VectorXd y = confirmed.y(car.responses[j].name);
    const Eigen::VectorXd error = front.responses.col(static_cast<Eigen::Index>(j)) - y;
    worst = std::max(worst, std::sqrt(error.squaredNorm() / static_cast<double>(y.size())) /
                                (y.maxCoeff() - y.minCoeff()));
  }
  return worst;
}

}  // namespace

int main() {
  //! [refine]
  std::vector<kriging::Model> models;
  doe::RefineOptions options{.max_points = 120};
  options.enough = [&](const doe::Evaluations& runs) {
    models.clear();
    for (const doe::Response& r : car.responses) models.push_back(kriging::fit(runs.X(), runs.y(r.name)));
    return std::all_of(models.begin(), models.end(),
                       [](const kriging::Model& m) { return kriging::leave_one_out(m).nrmse < 0.005; });
  };
  const doe::Refinement study = doe::refine(
      simulate, car, doe::optimized_latin_hypercube(car, 16, {.corners = true}), doe::LolaVoronoi(), options);
  const pareto::Front front = pareto::nsga2(kriging::Surrogates(models), car, {.search = {.population = 50}});
  const doe::Evaluations confirmed = doe::evaluate(simulate, car, front.X);
  //! [refine]

  const double error = front_error(front, confirmed);
  std::printf(
      "%s; front of %d from %.2f m/s2 and %.0f N to %.2f m/s2 and %.0f N, models off by %.1f %% of it\n",
      study.message.c_str(), static_cast<int>(front.Y.rows()), front.Y.col(0).minCoeff(),
      front.Y.col(1).maxCoeff(), front.Y.col(0).maxCoeff(), front.Y.col(1).minCoeff(), 100.0 * error);
  return study.status == doe::RefineStatus::criterion_met && front.Y.rows() == 50 && error < 0.05 ? 0 : 1;
}
