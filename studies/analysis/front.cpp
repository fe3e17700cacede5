// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/front.h>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/pareto/nsga2.hpp>

namespace drawpoint::studies {

pareto::PolishedFront front_of(const std::vector<kriging::Model>& models, const doe::Problem& problem,
                               doe::Seed seed) {
  const kriging::Surrogates means(models);
  return pareto::polished_front(means, problem, pareto::nsga2(means, problem, {.search = {.seed = seed}}));
}

}  // namespace drawpoint::studies
