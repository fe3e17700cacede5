// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <cmath>
#include <cstdio>
#include <drawpoint/doe/distribution.hpp>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <fstream>
#include <stdexcept>

using namespace drawpoint;

const doe::Problem digging{
    .variables = {{"depth", "m", 0.3, 0.8}, {"density", "t/m3", 1.5, 2.3}, {"friction", "1", 0.3, 0.9}},
    .responses = {{"force", "kN"}}};
const double limit = 150.0;  // kN, what the hinge bears

// Chosen is the depth; the pile brings the rest.
const doe::InputDistributions pile{{"density", doe::triangular(1.5, 1.8, 2.3)},
                                   {"friction", doe::normal(0.6, 0.08)}};

double force(const Eigen::VectorXd& x) { return 250.0 * std::pow(x[0], 1.5) * x[1] / 1.8 * (0.6 + x[2]); }

// Of 4096 piles, the share in which a cut of this depth keeps the limit.
template <class F>
double reliability(const F& f, Eigen::MatrixXd piles, double depth) {
  piles.col(0).setConstant(depth);
  return (f(piles).array() <= limit).template cast<double>().mean();
}

// The deepest cut of reliability 99 %: it falls as the depth grows, so halve.
template <class F>
double deepest(const F& f, const Eigen::MatrixXd& piles) {
  double low = 0.3, high = 0.8;
  while (high - low > 1e-5)
    (reliability(f, piles, 0.5 * (low + high)) >= 0.99 ? low : high) = 0.5 * (low + high);
  return low;
}

int main(int argc, char** argv) {
  // The model is of the whole box, so it serves whatever the distributions turn out to be.
  const doe::Evaluations runs =
      doe::evaluate(force, digging, doe::optimized_latin_hypercube(digging, 40, {.corners = true}));
  const kriging::Model model = kriging::fit(runs.X(), runs.y("force"));
  if (model.status() != kriging::Status::converged) throw std::runtime_error(model.message());

  const Eigen::MatrixXd piles = doe::distributed(digging, pile, doe::scrambled_sobol(digging, 4096));
  const auto surrogate = [&](const Eigen::MatrixXd& X) -> Eigen::VectorXd { return model.mean(X); };
  const auto formula = [](const Eigen::MatrixXd& X) {
    Eigen::VectorXd y(X.rows());
    for (Eigen::Index i = 0; i < y.size(); ++i) y[i] = force(X.row(i));
    return y;
  };
  const double depth = deepest(surrogate, piles);
  std::printf("99 %% of the piles allow a cut of %.3f m\n", depth);
  const double of_mean = deepest(surrogate, piles.colwise().mean());
  std::printf("the mean pile allows %.2f m, which is right for %.0f %% of them\n", of_mean,
              100.0 * reliability(surrogate, piles, of_mean));
  std::printf("by the formula itself: %.3f m\n", deepest(formula, piles));

  std::ofstream csv(argc > 1 ? argv[1] : "reliability.csv");
  csv << "depth,reliability,found\n";
  for (double d = 0.4; d < 0.8; d += 0.005)
    csv << d << ',' << reliability(surrogate, piles, d) << ',' << depth << '\n';
  return 0;
}
