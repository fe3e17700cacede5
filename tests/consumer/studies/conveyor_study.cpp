// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A study in somebody else's project: a belt conveyor lifts ore by 20 m. Wide belts cost more, steep ones are
/// shorter but let rocks roll back, fast ones throw dust. How much ore for what price, with little dust?

#include <drawpoint/studies/study.hpp>

#include <cmath>

using namespace drawpoint;

//! [study]
const doe::Problem problem{
    .variables = {{"width", "m", 0.6, 1.4}, {"speed", "m/s", 1.0, 4.0}, {"angle", "deg", 8.0, 20.0}},
    .responses = {{"flow", "kg/s", doe::Goal::maximize},
                  {"price", "kEUR", doe::Goal::minimize},
                  {"dust", "g/s", doe::Goal::at_most, 40.0}}};

doe::Outcome convey(const Eigen::VectorXd& x, doe::Seed seed) {
  const double width = x[0], speed = x[1], angle = x[2];
  if (angle > 19.0 && speed < 1.2) return doe::Failure{"the ore slides back"};
  const double lying = 1.0 - 0.5 * std::pow(angle / 20.0, 2);              // [1] of what a level belt holds
  const double flow = 1700.0 * 0.1 * width * width * lying * speed;        // [kg/s]
  const double length = 20.0 / std::sin(angle * std::acos(-1.0) / 180.0);  // [m]
  const double price = length * (0.8 + 2.2 * width) + 30.0 * speed;        // [kEUR]
  const double gust = 0.01 * static_cast<double>(seed % 11);               // [1] what another day would bring
  return {flow, price, 0.02 * flow * speed * (1.0 + gust)};
}

int main(int argc, char** argv) {
  return studies::run(argc, argv,
                      {.name = "conveyor", .problem = problem, .black_box = convey, .about = "Ore uphill."});
}
//! [study]
