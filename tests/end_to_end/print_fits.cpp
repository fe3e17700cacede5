// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Fits in one to eight variables, exact and noisy, to the last bit: for any_blas.sh.

#include <cmath>
#include <cstdio>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/fit.hpp>

using namespace drawpoint;

namespace {

doe::Problem box(int d) {
  doe::Problem problem{.variables = {}, .responses = {{"y", "1"}}};
  for (int k = 0; k < d; ++k) problem.variables.push_back({"x" + std::to_string(k), "1", 0.0, 1.0});
  return problem;
}

void print_fit(int d, int runs, double noise) {
  const Eigen::MatrixXd X = doe::latin_hypercube(box(d), runs, {.seed = 7});
  doe::RandomStream random(static_cast<doe::Seed>(d));
  Eigen::VectorXd y(runs);
  for (Eigen::Index i = 0; i < runs; ++i) {
    y[i] = noise * random.normal();
    for (int k = 0; k < d; ++k)
      y[i] += std::sin((k + 1.0) * X(i, k)) / (k + 1.0) + (k ? X(i, k) * X(i, k - 1) : 0.0);
  }
  const kriging::Model model = kriging::fit(X, y, {.parameter_uncertainty = runs <= 250});
  std::printf("%d variables, %d runs, noise %g:", d, runs, noise);
  for (const double theta : model.theta()) std::printf(" %a", theta);
  std::printf(" %a %a\n", model.noise_variance(), model.process_variance());
}

}  // namespace

int main() {
  for (const double noise : {0.0, 0.1})
    for (int d = 1; d <= 8; ++d) print_fit(d, 15 * d, noise);
  print_fit(4, 400, 0.1);
  return 0;
}
