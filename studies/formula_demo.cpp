// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The whole pipeline on a formula, in seconds. The bucket follows a path that cuts into a pile: its
/// steepness alpha and depth beta fill it, its curl gamma lifts, its speed kappa saves time. A fuller bucket
/// carries more, stresses the joint more and spills more. The seed scatters every response by one to two per
/// cent, as another pile of the same rocks would; --noise says how many times that.

#include <drawpoint/doe/seed.hpp>
#include <drawpoint/studies/study.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace drawpoint;

const doe::Problem problem{
    .variables = {{"alpha", "1", 0.2, 2.0},
                  {"beta", "1", 0.0, 1.0},
                  {"gamma", "1", 0.0, 1.0},
                  {"kappa", "1", 0.0, 1.0}},
    .responses = {{.name = "production", .unit = "kg/s", .goal = doe::Goal::maximize, .lower = 0},
                  {.name = "joint_damage", .unit = "s", .goal = doe::Goal::minimize, .lower = 0},
                  {.name = "rock_spill", .unit = "1", .goal = doe::Goal::minimize, .lower = 0}}};

doe::Outcome load(const Eigen::VectorXd& x, doe::Seed seed, const studies::RunContext& run) {
  const double noise = std::stod(run.options.at("noise"));
  const double alpha = x[0], beta = x[1], gamma = x[2], kappa = x[3];
  doe::RandomStream random(seed);
  const auto scattered = [&](double value, double share) {
    return value * std::max(1.0 + noise * share * random.normal(), 0.0);
  };
  const double fill = 1.0 - std::exp(-alpha * (0.6 + beta) * (1.2 - 0.5 * gamma));  // [1] of a heaped bucket
  const double mass = scattered(14000.0 * fill, 0.01);                              // [kg]
  const double time = (14.0 + 6.0 * fill) * (1.3 - 0.6 * kappa);                    // [s] per cycle
  const double load_ratio = fill * (0.7 + 0.5 * kappa + 0.3 * beta * beta);  // [1] of the joint's rated load
  const double damage = scattered(time * std::pow(load_ratio, 3), 0.02);     // [s] at rated load
  const double spill = scattered(0.02 + 0.25 * fill * fill * (0.3 + kappa * (1.0 - 0.6 * gamma)), 0.02);
  return {mass / time, damage, spill};
}

int main(int argc, char** argv) {
  return studies::run(argc, argv,
                      {.name = "formula_demo",
                       .problem = problem,
                       .black_box = load,
                       .about = "A loading cycle as a formula: the whole pipeline in seconds.",
                       .options = {{.name = "noise",
                                    .help = "times the scatter of 1 to 2 per cent that runs have",
                                    .value = "1",
                                    .least = 0,
                                    .most = 50}}});
}
