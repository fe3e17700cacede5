// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// How evenly each design of 500 runs of 4 variables fills the box, and what it costs in CPU seconds.
//
//   design_table [runs] [FILE...]
//
// One line a design: the median over eleven seeds (1..11) of CPU time, smallest distance, phi_10, phi_50,
// squared centred discrepancy and largest correlation, and whether the design is Latin. Each FILE is scored
// by the same measures: a table of numbers in the unit box, one run per line, separated by commas or blanks,
// as other tools write it.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <drawpoint/benchmarks/toolkit/cpu_time.hpp>
#include <drawpoint/benchmarks/toolkit/median.hpp>
#include <drawpoint/benchmarks/toolkit/unit_box.hpp>
#include <drawpoint/doe/halton.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/orthogonal_array.hpp>
#include <drawpoint/doe/quality.hpp>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

using namespace drawpoint::doe;
using drawpoint::benchmarks::cpu_seconds;
using drawpoint::benchmarks::median;
using drawpoint::benchmarks::unit_box;

namespace {

using Design = std::function<Eigen::MatrixXd(const Problem&, int, Seed)>;

/// CPU seconds, smallest distance, phi_10, phi_50, CD2, correlation.
std::vector<double> measures(const Problem& problem, const Eigen::MatrixXd& X, double seconds, bool& latin) {
  const DesignQuality quality = design_quality(problem, X);
  latin = latin && quality.latin;
  return {seconds,
          quality.minimum_distance,
          quality.phi_p,
          phi_p(X, 50.0),
          quality.squared_centred_discrepancy,
          quality.largest_correlation};
}

void print_line(const std::string& name, const std::vector<double>& m, bool latin) {
  std::printf("%-36s %8.4f %8.4f %8.3f %8.3f %10.3e %7.3f  %s\n", name.c_str(), m[0], m[1], m[2], m[3], m[4],
              m[5], latin ? "yes" : "no");
}

void measure(const std::string& name, const Design& design, int runs) {
  const Problem problem = unit_box(4);
  std::vector<std::vector<double>> columns(6);
  bool latin = true;
  for (Seed seed = 1; seed <= 11; ++seed) {
    const double start = cpu_seconds();
    const Eigen::MatrixXd X = design(problem, runs, seed);
    const std::vector<double> m = measures(problem, X, cpu_seconds() - start, latin);
    for (std::size_t k = 0; k < m.size(); ++k) columns[k].push_back(m[k]);
  }
  std::vector<double> medians(6);
  std::transform(columns.begin(), columns.end(), medians.begin(), median);
  print_line(name, medians, latin);
}

Design optimized(LatinCriterion criterion, int p = 10, LatinStart start = LatinStart::best) {
  return [=](const Problem& problem, int n, Seed seed) {
    return optimized_latin_hypercube(problem, n,
                                     {.seed = seed, .criterion = criterion, .p = p, .start = start});
  };
}

const std::vector<std::pair<std::string, Design>> designs{
    {"uniform", [](const Problem& p, int n, Seed s) { return uniform_random(p, n, {.seed = s}); }},
    {"scrambled Sobol", [](const Problem& p, int n, Seed s) { return scrambled_sobol(p, n, {.seed = s}); }},
    {"scrambled Halton", [](const Problem& p, int n, Seed s) { return halton(p, n, {.seed = s}); }},
    {"Latin hypercube", [](const Problem& p, int n, Seed s) { return latin_hypercube(p, n, {.seed = s}); }},
    {"Latin hypercube, centred",
     [](const Problem& p, int n, Seed s) { return latin_hypercube(p, n, {.seed = s, .centred = true}); }},
    {"optimised: maximin (default)", optimized(LatinCriterion::maximin, 10, LatinStart::random)},
    {"lattice or annealed: phi_10", optimized(LatinCriterion::phi_p)},
    {"lattice or annealed: phi_50", optimized(LatinCriterion::phi_p, 50)},
    {"lattice or annealed: CD2", optimized(LatinCriterion::centred_discrepancy)},
    {"lattice or annealed: maximin", optimized(LatinCriterion::maximin)},
    {"annealed only: CD2", optimized(LatinCriterion::centred_discrepancy, 10, LatinStart::random)},
    {"orthogonal array of the next size", [](const Problem& p, int n, Seed s) {
       return orthogonal_latin_hypercube(p, orthogonal_array_runs(n, 4), {.seed = s});
     }}};

Eigen::MatrixXd read_table(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    const std::vector<double> row{std::istream_iterator<double>(fields), {}};
    if (!row.empty() && (rows.empty() || row.size() == rows.front().size())) rows.push_back(row);
  }
  Eigen::MatrixXd X(static_cast<Eigen::Index>(rows.size()),
                    rows.empty() ? 0 : static_cast<Eigen::Index>(rows.front().size()));
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    X.row(i) = Eigen::Map<const Eigen::RowVectorXd>(rows[static_cast<std::size_t>(i)].data(), X.cols());
  return X;
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 500;
  if (runs < 2) {
    std::fprintf(stderr, "design_table: runs is \"%s\"; allowed is 2 or more\n", argv[1]);
    return 2;
  }
  std::printf("%d runs of 4 variables, medians of 11 seeds\n%-36s %8s %8s %8s %8s %10s %7s  %s\n", runs,
              "design", "CPU s", "min dist", "phi_10", "phi_50", "CD2", "corr", "Latin");
  for (const auto& [name, design] : designs) measure(name, design, runs);
  for (int k = 2; k < argc; ++k) {
    const Eigen::MatrixXd X = read_table(argv[k]);
    if (X.rows() < 2) {
      std::fprintf(stderr, "design_table: \"%s\" holds no table of two runs or more\n", argv[k]);
      return 1;
    }
    bool latin = true;
    print_line(argv[k], measures(unit_box(static_cast<int>(X.cols())), X, 0.0, latin), latin);
  }
  return 0;
}
