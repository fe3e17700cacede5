// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <functional>

using namespace drawpoint;

double number(const Eigen::VectorXd& x) { return x[0]; }
Eigen::VectorXd vector(const Eigen::VectorXd& x) { return x; }

struct Table {
  std::vector<doe::Outcome> operator()(const Eigen::MatrixXd& X, std::span<const doe::Seed>) const {
    return std::vector<doe::Outcome>(static_cast<std::size_t>(X.rows()), doe::Failure{"empty"});
  }
};

// Every accepted form: functions, lambdas, objects and std::function, with and without a seed or a stop
// token, one point or many.
void accepted(const doe::Problem& problem, const Eigen::MatrixXd& X) {
  doe::evaluate(number, problem, X);
  doe::evaluate(&vector, problem, X);
  doe::evaluate([](const Eigen::VectorXd& x, doe::Seed) -> doe::Outcome { return {x[0], x[1]}; }, problem, X);
  doe::evaluate([](const auto& x) { return x[0]; }, problem, X);
  doe::evaluate([](Eigen::VectorXd x) -> doe::Outcome { return doe::Failure{x.size() ? "stuck" : "empty"}; },
                problem, X);
  doe::evaluate(Table{}, problem, X);
  doe::evaluate([](const Eigen::VectorXd& x, doe::Seed, std::stop_token) { return x[0]; }, problem, X);
  pareto::nsga2(Table{}, problem);
  pareto::nsga2(std::function<doe::Outcome(const Eigen::VectorXd&, doe::Seed)>(), problem);
}
