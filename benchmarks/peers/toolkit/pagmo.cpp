// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// pagmo's NSGA-II and exact hypervolume on the cases of cases.hpp: pagmo's own test problems, and the
// algorithm that pagmo picks for each number of objectives.

#include <drawpoint/benchmarks/peers/toolkit/cases.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/tests/pareto/test_functions.hpp>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/config.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/problems/dtlz.hpp>
#include <pagmo/problems/zdt.hpp>
#include <pagmo/utils/hypervolume.hpp>

using namespace drawpoint;

namespace {

pagmo::problem problem_of(const peers::SearchCase& c) {
  const std::string name = c.name;
  const unsigned number = static_cast<unsigned>(name.back() - '0');
  if (name.starts_with("ZDT")) return pagmo::problem(pagmo::zdt(number, c.d));
  return pagmo::problem(pagmo::dtlz(number, c.d, c.m));
}

/// Points that are not below the reference are left out, for pagmo refuses them.
double volume_of(std::vector<pagmo::vector_double> points, unsigned m) {
  std::erase_if(points, [](const auto& y) {
    return !std::all_of(y.begin(), y.end(), [](double v) { return v < peers::reference; });
  });
  return points.empty() ? 0.0 : pagmo::hypervolume(points).compute(pagmo::vector_double(m, peers::reference));
}

void search(const peers::SearchCase& c) {
  std::vector<double> volumes;
  double least = std::numeric_limits<double>::infinity();
  for (unsigned seed = 1; seed <= peers::seeds; ++seed) {
    const double start = peers::cpu_seconds();
    const pagmo::algorithm nsga2{pagmo::nsga2(peers::generations, peers::crossover_rate,
                                              peers::crossover_index, 1.0 / c.d, peers::mutation_index,
                                              seed)};
    const pagmo::population end = nsga2.evolve(pagmo::population(problem_of(c), peers::population, seed));
    least = std::min(least, peers::cpu_seconds() - start);
    volumes.push_back(volume_of(end.get_f(), c.m));
  }
  peers::tell_search(c.name, volumes, least);
}

void measure_volume(const peers::FrontCase& c) {
  const Eigen::MatrixXd Y = support::sphere_points(c.n, c.m, static_cast<doe::Seed>(c.seed));
  std::vector<pagmo::vector_double> points(static_cast<std::size_t>(c.n));
  for (int i = 0; i < c.n; ++i)
    for (int j = 0; j < c.m; ++j) points[static_cast<std::size_t>(i)].push_back(Y(i, j));
  const pagmo::hypervolume front(points);
  const pagmo::vector_double corner(static_cast<std::size_t>(c.m), peers::reference);
  double volume = 0.0;
  const double seconds = peers::least_seconds([&] { volume = front.compute(corner); });
  peers::tell_volume(c, volume, seconds);
}

}  // namespace

int main() {
  std::printf("{\"system\": \"pagmo %s\"}\n", PAGMO_VERSION);
  for (const auto& c : peers::front_cases()) measure_volume(c);
  for (const auto& c : peers::search_cases()) search(c);
}
