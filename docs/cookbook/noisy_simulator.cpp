// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <cmath>
#include <cstdio>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/replicates.hpp>
#include <fstream>
#include <stdexcept>

using namespace drawpoint;

const doe::Problem digging{.variables = {{"depth", "m", 0.15, 0.6}}, .responses = {{"energy", "kJ/t"}}};

// In the mean: edges cost more per tonne in a thin cut, lifting more in a deep one. Least at 0.274 m.
double mean_energy(double depth) { return 0.6 / depth + 8.0 * depth; }

// No two cuts meet the same rocks: each run differs, by its seed.
doe::Outcome dig(const Eigen::VectorXd& x, doe::Seed seed) {
  return mean_energy(x[0]) + 0.4 * doe::RandomStream(seed).normal();
}

int main(int argc, char** argv) {
  const Eigen::MatrixXd depths = doe::optimized_latin_hypercube(digging, 15, {.corners = true});
  const doe::Evaluations runs = doe::evaluate(dig, digging, depths, {.replicates = 4});

  // Fifteen means whose noise the repeats tell.
  const kriging::Replicates means = kriging::replicates(runs.X(), runs.y("energy"));
  const kriging::Model model = kriging::fit(
      means.X, means.y, {.noise = kriging::Noise::known, .noise_variance = means.noise_variance});
  if (model.status() != kriging::Status::converged) throw std::runtime_error(model.message());

  // Without repeats the noise is an unknown of the fit, the nugget.
  const kriging::Model nugget = kriging::fit(runs.X(), runs.y("energy"));

  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(451, 0.15, 0.6);
  const kriging::Prediction p = model.predict(x);
  std::ofstream csv(argc > 1 ? argv[1] : "noisy_simulator.csv");
  csv << "what,depth,energy,deviation,exact\n";
  for (const doe::Evaluation& run : runs.rows)
    csv << "run," << run.x[0] << ',' << run.outcome.values()[0] << ",,\n";
  int inside = 0;
  for (int i = 0; i < x.size(); ++i) {
    const double exact = mean_energy(x[i]), deviation = std::sqrt(p.variance[i]);
    inside += std::abs(p.mean[i] - exact) < 1.96 * deviation;
    csv << "model," << x[i] << ',' << p.mean[i] << ',' << deviation << ',' << exact << '\n';
  }
  Eigen::Index best;
  p.mean.minCoeff(&best);
  std::printf("noise of a run: %.2f kJ/t by the repeats, %.2f by the nugget\n",
              std::sqrt(means.noise_variance[0] * means.count[0]), std::sqrt(nugget.noise_variance()));
  std::printf("least energy at %.2f m; the error bars hold the mean at %.0f %% of the depths\n", x[best],
              100.0 * inside / 451);
  return 0;
}
