// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// The figures of pareto/ beside those of other libraries, in one run: searches by hypervolume and time,
/// exact hypervolume, non-dominated sorting.
///
/// Times are CPU seconds of the process, the least of several repeats; the peers' were measured once on the
/// machine that docs/measurements/pareto.md names, as medians. Point sets and test functions are those of
/// tests/pareto/test_functions.hpp. `pareto_table quick` leaves out the slow searches.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <drawpoint/benchmarks/toolkit/cpu_time.hpp>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/moead.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/pareto/nsga3.hpp>
#include <drawpoint/pareto/sms_emoa.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/pareto/test_functions.hpp>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace drawpoint;

using benchmarks::cpu_seconds;
using benchmarks::least_seconds;

struct TestProblem {
  const char* name;
  doe::Outcome (*f)(const Eigen::VectorXd&);
  int d, m;
  double last_reference, pagmo;  // reference 1.1 in the other objectives; pagmo 2.18, the same operators

  Eigen::VectorXd reference() const {
    Eigen::VectorXd r = Eigen::VectorXd::Constant(m, 1.1);
    r[m - 1] = last_reference;
    return r;
  }
};

const std::vector<TestProblem> problems{
    {"ZDT1", support::zdt1, 30, 2, 1.1, 0.869448},   {"ZDT3", support::zdt3, 30, 2, 1.1, 1.327465},
    {"ZDT4", support::zdt4, 10, 2, 1.1, NAN},        {"ZDT6", support::zdt6, 10, 2, 1.1, 0.496472},
    {"DTLZ2", support::dtlz2, 12, 3, 1.1, 0.702418}, {"DTLZ7", support::dtlz7, 22, 3, 6.6, 2.493227}};

using Search = std::function<pareto::Front(const TestProblem&, const doe::Problem&, doe::Seed)>;

void search_row(const TestProblem& p, const char* name, const Search& search) {
  const doe::Problem problem = support::unit_problem(p.d, p.m);
  std::vector<double> volumes;
  double least = 1e9;
  for (doe::Seed seed = 1; seed <= 11; ++seed) {
    const double start = cpu_seconds();
    const pareto::Front front = search(p, problem, seed);
    least = std::min(least, cpu_seconds() - start);
    volumes.push_back(pareto::hypervolume(front.Y, p.reference()));
  }
  std::sort(volumes.begin(), volumes.end());
  std::printf("%-6s %-18s %.6f [%.6f, %.6f]  %.6f  %.3f\n", p.name, name, volumes[5], volumes[0], volumes[10],
              p.pagmo, least);
}

template <class Options>
Options seeded(doe::Seed seed, Options options = {}) {
  options.search.population = 100;
  options.search.stopping.generations = 250;
  options.search.seed = seed;
  return options;
}

void searches(bool quick) {
  std::printf(
      "\nSearches, 250 generations of 100, eleven seeds: hypervolume median [least, largest], pagmo's "
      "NSGA-II, CPU s\n");
  for (const TestProblem& problem : problems) {
    const auto nsga2_row = [&](const char* name, pareto::Elitism elitism) {
      search_row(problem, name, [elitism](auto& p, auto& box, doe::Seed s) {
        pareto::Nsga2Options options = seeded<pareto::Nsga2Options>(s);
        options.elitism = elitism;
        return pareto::nsga2(p.f, box, options);
      });
    };
    nsga2_row("nsga2", pareto::Elitism::plain);
    nsga2_row("nsga2 geometric", pareto::Elitism::geometric);
    nsga2_row("nsga2 fraction", pareto::Elitism::pareto_fraction);
    search_row(problem, "nsga3", [](auto& p, auto& box, doe::Seed s) {
      return pareto::nsga3(p.f, box, seeded<pareto::Nsga3Options>(s));
    });
    search_row(problem, "moead", [](auto& p, auto& box, doe::Seed s) {
      return pareto::moead(p.f, box, seeded<pareto::MoeadOptions>(s));
    });
    if (quick) continue;
    search_row(problem, "sms_emoa", [](auto& p, auto& box, doe::Seed s) {
      return pareto::sms_emoa(p.f, box, seeded<pareto::SmsEmoaOptions>(s));
    });
  }
}

struct VolumeRow {
  int n, m;
  double volume, peer;  // the faster of pagmo 2.18 and moocore 0.20, CPU s
};

void hypervolumes() {
  std::printf(
      "Exact hypervolume: value, difference from the peers', CPU s, best peer's, ratio; contributions "
      "of all points, CPU s\n");
  for (const VolumeRow& row : {VolumeRow{100, 3, 0.713600989415, 3.2e-5},
                               {1000, 3, 0.778534229659, 4.3e-4},
                               {10000, 3, 0.799560273792, 3.9e-3},
                               {100, 4, 0.891403594963, 6.3e-5},
                               {1000, 4, 1.060947025005, 1.77e-3},
                               {300, 5, 1.157585519726, 2.4e-3},
                               {100, 6, 1.097229296181, 8.6e-3},
                               {300, 6, 1.298798404944, 0.111}}) {
    const Eigen::MatrixXd Y = support::sphere_points(row.n, row.m, static_cast<doe::Seed>(10 * row.m + 1));
    const Eigen::VectorXd reference = Eigen::VectorXd::Constant(row.m, 1.1);
    double volume = 0.0, sum = 0.0;
    const double time = least_seconds([&] { volume = pareto::hypervolume(Y, reference); });
    const double all = least_seconds([&] { sum += pareto::hypervolume_contributions(Y, reference).sum(); });
    std::printf("%d-d %5d  %.12f  %8.1e  %.2e  %.2e  %.2f  %.2e\n", row.m, row.n, volume, volume - row.volume,
                time, row.peer, time / row.peer, sum > 0.0 ? all : NAN);
  }
}

struct SortRow {
  int n, m;
  std::size_t fronts, first;
  double peer;  // moocore 0.20
};

void sorting() {
  std::printf("\nNon-dominated sorting: fronts/first front, the peers' counts, CPU s, best peer's, ratio\n");
  for (const SortRow& row : {SortRow{200, 2, 28, 9, 1.0e-5},
                             {200, 3, 11, 27, 3.2e-5},
                             {200, 6, 3, 90, 1.0e-4},
                             {1000, 2, 63, 12, 5.7e-5},
                             {1000, 3, 19, 18, 3.4e-4},
                             {1000, 6, 5, 278, 1.4e-3},
                             {10000, 2, 190, 8, 8.7e-4},
                             {10000, 3, 47, 28, 6.7e-3},
                             {10000, 6, 10, 843, 4.2e-2}}) {
    const Eigen::MatrixXd Y = support::cube_points(row.n, row.m, static_cast<doe::Seed>(1000 + row.m));
    std::vector<std::vector<int>> fronts;
    const double time = least_seconds([&] { fronts = pareto::non_dominated_sort(Y); });
    std::printf("%5d, %d  %zu/%zu  %zu/%zu  %.2e  %.2e  %.2f\n", row.n, row.m, fronts.size(),
                fronts.front().size(), row.fronts, row.first, time, row.peer, time / row.peer);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "quick") == 0;
  if (argc > 1 && !quick) {
    std::fprintf(stderr, "usage: pareto_table [quick]\n");
    return 2;
  }
  hypervolumes();
  sorting();
  searches(quick);
}
