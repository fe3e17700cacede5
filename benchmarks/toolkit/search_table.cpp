// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Which search finds how much of a known front: every search on every problem of
/// tests/pareto/known_fronts.hpp.
///
/// Population 100 and 25 000 evaluations (250 generations), eleven seeds; figures are the hypervolume as a
/// share of the exact front's: worst, quartiles, best. The front of a hundred points cannot reach 1.
/// `search_table NAME` for one problem.

#include <algorithm>
#include <array>
#include <cstdio>
#include <drawpoint/benchmarks/toolkit/cpu_time.hpp>
#include <drawpoint/pareto/moead.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/pareto/nsga3.hpp>
#include <drawpoint/pareto/sms_emoa.hpp>
#include <drawpoint/tests/pareto/known_fronts.hpp>
#include <functional>
#include <string>

namespace {

using namespace drawpoint;
using support::KnownFront;

using Search = std::function<pareto::Front(const KnownFront&, const pareto::SearchOptions&)>;

constexpr int seeds = 11;

void row(const KnownFront& known, const char* name, const Search& search) {
  std::array<double, seeds> shares{};
  const double start = benchmarks::cpu_seconds();
  for (int s = 0; s < seeds; ++s) {
    const pareto::SearchOptions options{.population = 100, .seed = static_cast<doe::Seed>(s + 1)};
    const pareto::Front front = search(known, options);
    shares[static_cast<std::size_t>(s)] = pareto::hypervolume(front.Y, known.reference) / known.volume;
  }
  const double seconds = (benchmarks::cpu_seconds() - start) / seeds;
  std::sort(shares.begin(), shares.end());
  std::printf("%-9s %-16s  %.4f  %.4f  %.4f  %.4f  %.4f  %.3f\n", known.name.c_str(), name, shares[0],
              shares[2], shares[5], shares[8], shares[10], seconds);
  std::fflush(stdout);
}

void rows(const KnownFront& known) {
  row(known, "nsga2", [](auto& k, auto& o) { return pareto::nsga2(k.f, k.problem, {.search = o}); });
  row(known, "nsga2 geometric", [](auto& k, auto& o) {
    return pareto::nsga2(k.f, k.problem, {.search = o, .elitism = pareto::Elitism::geometric});
  });
  row(known, "nsga3", [](auto& k, auto& o) { return pareto::nsga3(k.f, k.problem, {.search = o}); });
  row(known, "moead", [](auto& k, auto& o) { return pareto::moead(k.f, k.problem, {.search = o}); });
  row(known, "sms_emoa", [](auto& k, auto& o) { return pareto::sms_emoa(k.f, k.problem, {.search = o}); });
  row(known, "sms_emoa, 100",
      [](auto& k, auto& o) { return pareto::sms_emoa(k.f, k.problem, {.search = o, .children = 100}); });
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("%-9s %-16s  %-6s  %-6s  %-6s  %-6s  %-6s  CPU s\n", "problem", "search", "worst", "low 1/4",
              "median", "up 1/4", "best");
  bool found = argc < 2;
  for (const KnownFront& known : support::known_fronts()) {
    if (argc > 1 && known.name != argv[1]) continue;
    rows(known);
    found = true;
  }
  if (found) return 0;
  std::fprintf(stderr, "search_table: no problem \"%s\"; usage: search_table [NAME]\n", argv[1]);
  return 2;
}
