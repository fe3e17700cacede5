// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Our answers to the cases of cases.hpp, the Kriging cases as files for the peers, and one evaluator of
// likelihoods for all.
//
//   toolkit_cases pareto                            searches and hypervolumes
//   toolkit_cases data CASE RUNS FOLDER             writes CASE.train.csv and CASE.test.csv: x1..x4, y
//   toolkit_cases kriging CASE RUNS                 our default fit
//   toolkit_cases likelihood CASE RUNS L1 L2 L3 L4 LAMBDA
//
// CASE is branin4, ishigami4 or noisy4 (tests/kriging/reference_cases.hpp). The model is y = mean + Gaussian
// process with R_ij = exp(-1/2 sum_k ((x_ik - x_jk)/L_k)^2) + LAMBDA delta_ij; y is standardised.

#include <Eigen/Cholesky>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <drawpoint/benchmarks/peers/toolkit/cases.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <drawpoint/tests/pareto/test_functions.hpp>
#include <fstream>
#include <stdexcept>

using namespace drawpoint;
namespace reference = kriging::reference;

namespace {

using TestFunction = doe::Outcome (*)(const Eigen::VectorXd&);

TestFunction function_of(const std::string& name) {
  if (name == "ZDT1") return support::zdt1;
  if (name == "ZDT3") return support::zdt3;
  if (name == "ZDT6") return support::zdt6;
  return support::dtlz2;
}

pareto::Nsga2Options deb(const peers::SearchCase& c, doe::Seed seed) {
  pareto::Nsga2Options options;
  options.search.population = peers::population;
  options.search.stopping.generations = peers::generations;
  options.search.variation = {.crossover_probability = peers::crossover_rate,
                              .crossover_index = peers::crossover_index,
                              .mutation_probability = 1.0 / c.d,
                              .mutation_index = peers::mutation_index};
  options.search.seed = seed;
  return options;
}

void search(const peers::SearchCase& c) {
  const doe::Problem problem = support::unit_problem(static_cast<int>(c.d), static_cast<int>(c.m));
  const Eigen::VectorXd corner = Eigen::VectorXd::Constant(c.m, peers::reference);
  std::vector<double> volumes;
  double least = std::numeric_limits<double>::infinity();
  for (doe::Seed seed = 1; seed <= peers::seeds; ++seed) {
    const double start = peers::cpu_seconds();
    const pareto::Front front = pareto::nsga2(function_of(c.name), problem, deb(c, seed));
    least = std::min(least, peers::cpu_seconds() - start);
    volumes.push_back(pareto::hypervolume(front.Y, corner));
  }
  peers::tell_search(c.name, volumes, least);
}

void measure_volume(const peers::FrontCase& c) {
  const Eigen::MatrixXd Y = support::sphere_points(c.n, c.m, static_cast<doe::Seed>(c.seed));
  const Eigen::VectorXd corner = Eigen::VectorXd::Constant(c.m, peers::reference);
  double volume = 0.0;
  const double seconds = peers::least_seconds([&] { volume = pareto::hypervolume(Y, corner); });
  peers::tell_volume(c, volume, seconds);
}

void write_table(const std::string& path, const reference::Data& data) {
  std::ofstream file(path);
  file.precision(17);
  for (Eigen::Index i = 0; i < data.X.rows(); ++i) {
    for (const double x : data.X.row(i)) file << x << ',';
    file << data.y[i] << '\n';
  }
  if (!file.flush())
    throw std::runtime_error("toolkit_cases: " + path + " cannot be written; choose another folder");
}

/// Profile log-likelihood of the standardised response; -infinity where R is not positive definite.
double log_likelihood(const reference::Data& data, const Eigen::VectorXd& l, double lambda) {
  const Eigen::Index n = data.X.rows();
  const Eigen::VectorXd y = reference::standardized(data.y), one = Eigen::VectorXd::Ones(n);
  Eigen::MatrixXd R(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      R(i, j) =
          std::exp(-0.5 * ((data.X.row(i) - data.X.row(j)).transpose().cwiseQuotient(l)).squaredNorm()) +
          (i == j ? lambda : 0.0);
  const Eigen::LLT<Eigen::MatrixXd> factor(R);
  if (factor.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  const Eigen::VectorXd Ry = factor.solve(y), R1 = factor.solve(one);
  const double mean = one.dot(Ry) / one.dot(R1), size = static_cast<double>(n);
  const double variance = (y.array() - mean).matrix().dot(Ry - mean * R1) / size;
  const double half_log_det = factor.matrixL().toDenseMatrix().diagonal().array().log().sum();
  return -0.5 * size * std::log(2.0 * reference::pi * variance) - half_log_det - 0.5 * size;
}

void fit_case(const std::string& name, int runs) {
  const reference::Data data = reference::training(name, runs), test = reference::testing(name);
  kriging::FitOptions options;
  options.lower = Eigen::VectorXd::Zero(4);
  options.upper = Eigen::VectorXd::Ones(4);
  options.threads = 1;
  options.estimation = kriging::Estimation::maximum_likelihood;  // what the peers maximise
  const double seconds = peers::least_seconds([&] { kriging::fit(data.X, data.y, options); });
  const kriging::Model model = kriging::fit(data.X, data.y, options);
  const double mean = peers::least_seconds([&] { model.mean(test.X); });
  const double both = peers::least_seconds([&] { model.predict(test.X); });
  const Eigen::VectorXd l = (8.0 * model.theta().array()).rsqrt();
  const double rmse =
      std::sqrt((model.mean(test.X) - test.y).squaredNorm() / static_cast<double>(test.y.size()));
  std::printf(
      "{\"cpu_s\": %.6g, \"log_likelihood\": %.10g, \"nrmse\": %.6g, \"mean_per_s\": %.6g, "
      "\"variance_per_s\": %.6g}\n",
      seconds, log_likelihood(data, l, model.nugget()), rmse / (test.y.maxCoeff() - test.y.minCoeff()),
      2000.0 / mean, 2000.0 / both);
}

void run(const std::vector<std::string>& words) {
  const std::size_t count = words.size();
  const std::string what = count > 0 ? words[0] : "";
  const int runs = count > 2 ? std::atoi(words[2].c_str()) : 0;
  if (what == "pareto" && count == 1) {
    std::printf("{\"system\": \"drawpoint\"}\n");
    for (const auto& c : peers::front_cases()) measure_volume(c);
    for (const auto& c : peers::search_cases()) search(c);
  } else if (what == "data" && count == 4 && runs > 1) {
    write_table(words[3] + "/" + words[1] + ".train.csv", reference::training(words[1], runs));
    write_table(words[3] + "/" + words[1] + ".test.csv", reference::testing(words[1]));
  } else if (what == "kriging" && count == 3 && runs > 1) {
    fit_case(words[1], runs);
  } else if (what == "likelihood" && count == 8 && runs > 1) {
    Eigen::VectorXd l(4);
    for (int k = 0; k < 4; ++k) l[k] = std::atof(words[static_cast<std::size_t>(3 + k)].c_str());
    std::printf("{\"log_likelihood\": %.10g}\n",
                log_likelihood(reference::training(words[1], runs), l, std::atof(words[7].c_str())));
  } else {
    throw std::runtime_error(
        "toolkit_cases: not understood; allowed are \"pareto\", \"data CASE RUNS FOLDER\", "
        "\"kriging CASE RUNS\" and \"likelihood CASE RUNS L1 L2 L3 L4 LAMBDA\"");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
}
