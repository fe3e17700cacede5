// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// What does stiffness cost in a welded beam? Two objectives, four limits, nothing but the installed pareto
// module and the doe that it needs.
//
// A bar of length 14 in is welded on and carries 6000 lbf at its end. Weld h x l, bar t x b, all in inches
// (Ragsdell, Phillips 1976; Deb 2000, "An efficient constraint handling method for genetic algorithms", whose
// cheapest design costs 2.38119).

#include <cmath>
#include <cstdio>
#include <drawpoint/pareto/nsga2.hpp>

using namespace drawpoint;

namespace {

//! [problem]
const doe::Problem beam{.variables = {{"weld_height", "in", 0.125, 5.0},
                                      {"weld_length", "in", 0.1, 10.0},
                                      {"bar_depth", "in", 0.1, 10.0},
                                      {"bar_width", "in", 0.125, 5.0}},
                        .responses = {{"cost", "USD", doe::Goal::minimize},
                                      {"deflection", "in", doe::Goal::minimize},
                                      {"shear_stress", "psi", doe::Goal::at_most, 13600.0},
                                      {"bending_stress", "psi", doe::Goal::at_most, 30000.0},
                                      {"bar_beyond_weld", "in", doe::Goal::at_least, 0.0},
                                      {"buckling_load", "lbf", doe::Goal::at_least, 6000.0}}};
//! [problem]

double shear_stress(double h, double l, double t) {
  const double arm = 0.25 * (l * l + (h + t) * (h + t));  // squared, of the weld's ends about its centre
  const double direct = 6000.0 / (std::sqrt(2.0) * h * l);
  const double twist = 6000.0 * (14.0 + 0.5 * l) * std::sqrt(arm) /
                       (2.0 * 0.707 * h * l * (l * l / 12.0 + 0.25 * (h + t) * (h + t)));
  return std::sqrt(direct * direct + twist * twist + l * direct * twist / std::sqrt(arm));
}

doe::Outcome weld(const Eigen::VectorXd& x) {
  const double h = x[0], l = x[1], t = x[2], b = x[3];
  return {1.10471 * h * h * l + 0.04811 * t * b * (14.0 + l),
          2.1952 / (t * t * t * b),
          shear_stress(h, l, t),
          504000.0 / (t * t * b),
          b - h,
          64746.022 * (1.0 - 0.0282346 * t) * t * b * b * b};
}

bool within_limits(const Eigen::MatrixXd& responses) {
  return (responses.col(2).array() <= 13600.0).all() && (responses.col(3).array() <= 30000.0).all() &&
         (responses.col(4).array() >= 0.0).all() && (responses.col(5).array() >= 6000.0).all();
}

}  // namespace

int main() {
  //! [search]
  const pareto::Front front =
      pareto::nsga2(weld, beam, {.search = {.population = 200, .stopping = {.generations = 500}}});
  //! [search]
  const double cheapest = front.Y.col(0).minCoeff(), stiffest = front.Y.col(1).minCoeff();
  std::printf("%d designs, %.2f USD with %.4f in to %.2f USD with %.5f in\n",
              static_cast<int>(front.Y.rows()), cheapest, front.Y.col(1).maxCoeff(),
              front.Y.col(0).maxCoeff(), stiffest);

  // No design can cost less than the known optimum, given to five decimals, nor bend less than the largest
  // bar, which no limit forbids. The cheapest designs stand where four limits meet, and a search of the whole
  // front gets near, not there: with this budget four seeds came to 2.41 to 3.18 USD. Half above the optimum
  // is allowed.
  const double optimum = 2.38119, largest_bar = 2.1952 / (10.0 * 10.0 * 10.0 * 5.0);
  const bool ends = cheapest > optimum - 5e-6 && cheapest < 1.5 * optimum &&
                    stiffest >= largest_bar * (1.0 - 1e-12) && stiffest < 1.01 * largest_bar;
  return front.Y.rows() == 200 && within_limits(front.responses) && ends ? 0 : 1;
}
