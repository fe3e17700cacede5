// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/python/bind.h>
#include <drawpoint/doe/halton.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <optional>

/// Designs: runs x d, natural units.

namespace drawpoint::python {

namespace {

doe::LatinCriterion criterion_of(const std::string& text) {
  if (text == "maximin") return doe::LatinCriterion::maximin;
  if (text == "phi_p") return doe::LatinCriterion::phi_p;
  if (text == "centred_discrepancy") return doe::LatinCriterion::centred_discrepancy;
  throw std::invalid_argument("doe::optimized_latin_hypercube: criterion is \"" + text +
                              "\"; allowed are maximin, phi_p, centred_discrepancy");
}

}  // namespace

void bind_designs(py::module_& m) {
  m.def(
      "latin_hypercube",
      [](const doe::Problem& problem, int runs, doe::Seed seed, bool corners, bool centred) {
        return doe::latin_hypercube(problem, runs, {seed, corners, centred});
      },
      ReleaseGil());
  m.def(
      "optimized_latin_hypercube",
      [](const doe::Problem& problem, int runs, doe::Seed seed, bool corners, bool centred,
         const std::string& criterion, std::optional<int> sweeps) {
        doe::OptimizedLatinOptions options;
        options.seed = seed;
        options.corners = corners;
        options.centred = centred;
        options.criterion = criterion_of(criterion);
        options.sweeps = sweeps;
        return doe::optimized_latin_hypercube(problem, runs, options);
      },
      ReleaseGil());
  m.def(
      "scrambled_sobol",
      [](const doe::Problem& problem, int runs, doe::Seed seed) {
        return doe::scrambled_sobol(problem, runs, {seed});
      },
      ReleaseGil());
  m.def(
      "halton",
      [](const doe::Problem& problem, int runs, doe::Seed seed, bool scrambled) {
        return doe::halton(problem, runs,
                           {seed, scrambled ? doe::HaltonKind::scrambled : doe::HaltonKind::plain});
      },
      ReleaseGil());
  m.def(
      "uniform_random",
      [](const doe::Problem& problem, int runs, doe::Seed seed) {
        return doe::uniform_random(problem, runs, {seed});
      },
      ReleaseGil());
}

}  // namespace drawpoint::python
