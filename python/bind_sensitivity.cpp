// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/python/black_box.h>
#include <drawpoint/doe/main_effects.hpp>
#include <drawpoint/doe/morris.hpp>
#include <drawpoint/doe/sensitivity.hpp>

/// Sobol' indices, elementary effects and main effects of a Python function or of fitted models.

namespace drawpoint::python {

namespace {

py::dict dict_of(const doe::SobolIndices& indices) {
  const auto estimates = [](const auto& e) { return py::make_tuple(e.value, e.lower, e.upper); };
  py::dict result;
  result["response"] = indices.response;
  result["status"] = std::string(to_string(indices.status));
  result["message"] = indices.message;
  result["mean"] = indices.mean;
  result["variance"] = indices.variance;
  result["first"] = estimates(indices.first);
  result["total"] = estimates(indices.total);
  result["second"] = estimates(indices.second);
  return result;
}

py::dict dict_of(const doe::ElementaryEffects& effects) {
  py::dict result;
  result["response"] = effects.response;
  result["status"] = std::string(to_string(effects.status));
  result["message"] = effects.message;
  result["mean"] = effects.mean;
  result["mean_absolute"] = effects.mean_absolute;
  result["deviation"] = effects.deviation;
  result["standard_error"] = effects.standard_error;
  result["count"] = effects.count;
  return result;
}

py::dict dict_of(const doe::MainEffect& effect) {
  py::dict result;
  result["variable"] = effect.variable;
  result["response"] = effect.response;
  result["status"] = std::string(to_string(effect.status));
  result["message"] = effect.message;
  result["x"] = effect.x;
  result["mean"] = effect.mean;
  result["standard_error"] = effect.standard_error;
  result["low"] = effect.low;
  result["high"] = effect.high;
  return result;
}

template <class Results>
py::list list_of(const Results& results) {
  py::list all;
  for (const auto& result : results) all.append(dict_of(result));
  return all;
}

doe::SobolEstimator estimator_of(const std::string& text) {
  if (text == "saltelli") return doe::SobolEstimator::saltelli;
  if (text == "jansen") return doe::SobolEstimator::jansen;
  if (text == "martinez") return doe::SobolEstimator::martinez;
  throw std::invalid_argument("doe::sobol_indices: estimator is \"" + text +
                              "\"; allowed are saltelli, jansen, martinez");
}

py::list indices(const py::object& f, const doe::Problem& problem, int samples, bool second_order,
                 const std::string& estimator, double confidence, doe::Seed seed, bool vectorized,
                 bool seeded) {
  Interrupt interrupt;
  doe::SobolIndicesOptions options;
  options.samples = samples;
  options.second_order = second_order;
  options.estimator = estimator_of(estimator);
  options.confidence = confidence;
  options.seed = options.evaluate.seed = seed;
  options.evaluate.stop = interrupt.token();
  const Batch batch = batch_of("doe::sobol_indices: ", f, vectorized, seeded, problem, interrupt);
  return list_of(interrupt.run(false, [&] { return doe::sobol_indices(batch, problem, options); }).responses);
}

py::list screening(const py::object& f, const doe::Problem& problem, int trajectories, int levels,
                   doe::Seed seed, bool vectorized, bool seeded) {
  Interrupt interrupt;
  doe::MorrisOptions options{.seed = seed, .trajectories = trajectories, .levels = levels};
  options.evaluate.seed = seed;
  options.evaluate.stop = interrupt.token();
  const Batch batch = batch_of("doe::morris_screening: ", f, vectorized, seeded, problem, interrupt);
  return list_of(
      interrupt.run(false, [&] { return doe::morris_screening(batch, problem, options); }).responses);
}

py::list effects(const py::object& f, const doe::Problem& problem, int levels, int samples, doe::Seed seed,
                 bool vectorized, bool seeded) {
  Interrupt interrupt;
  doe::MainEffectsOptions options{.seed = seed, .levels = levels, .samples = samples};
  options.evaluate.seed = seed;
  options.evaluate.stop = interrupt.token();
  const Batch batch = batch_of("doe::main_effects: ", f, vectorized, seeded, problem, interrupt);
  return list_of(interrupt.run(false, [&] { return doe::main_effects(batch, problem, options); }));
}

}  // namespace

void bind_sensitivity(py::module_& m) {
  m.def("sobol_indices", &indices);
  m.def("morris_screening", &screening);
  m.def("main_effects", &effects);
}

}  // namespace drawpoint::python
