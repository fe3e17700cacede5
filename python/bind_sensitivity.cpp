// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/python/black_box.h>
#include <drawpoint/doe/main_effects.hpp>
#include <drawpoint/doe/morris.hpp>
#include <drawpoint/doe/sensitivity.hpp>

/// Sobol' indices, elementary effects and main effects of a Python function or of fitted models.

namespace drawpoint::python {

namespace {

/// What all results have.
template <class Result>
py::dict head_of(const Result& result) {
  py::dict head;
  head["response"] = result.response;
  head["status"] = std::string(to_string(result.status));
  head["message"] = result.message;
  return head;
}

py::dict dict_of(const doe::SobolIndices& indices) {
  const auto estimates = [](const auto& e) { return py::make_tuple(e.value, e.lower, e.upper); };
  py::dict result = head_of(indices);
  result["mean"] = indices.mean;
  result["variance"] = indices.variance;
  result["first"] = estimates(indices.first);
  result["total"] = estimates(indices.total);
  result["second"] = estimates(indices.second);
  return result;
}

py::dict dict_of(const doe::ElementaryEffects& effects) {
  py::dict result = head_of(effects);
  result["mean"] = effects.mean;
  result["mean_absolute"] = effects.mean_absolute;
  result["deviation"] = effects.deviation;
  result["standard_error"] = effects.standard_error;
  result["count"] = effects.count;
  return result;
}

py::dict dict_of(const doe::MainEffect& effect) {
  py::dict result = head_of(effect);
  result["variable"] = effect.variable;
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

/// How a function is asked.
struct Asked {
  const char* who;
  const py::object& f;
  const doe::Problem& problem;
  doe::Seed seed;
  bool vectorized, seeded;
};

/// What ask(black box, problem, options) gives, with one seed for points and runs, and ended by Ctrl-C.
template <class Options, class Ask>
auto answer(const Asked& asked, Options options, const Ask& ask) {
  Interrupt interrupt;
  options.seed = options.evaluate.seed = asked.seed;
  options.evaluate.stop = interrupt.token();
  const Batch batch = batch_of(asked.who, asked.f, asked.vectorized, asked.seeded, asked.problem, interrupt);
  return interrupt.run(false, [&] { return ask(batch, asked.problem, options); });
}

py::list indices(const py::object& f, const doe::Problem& problem, int samples, bool second_order,
                 const std::string& estimator, double confidence, doe::Seed seed, bool vectorized,
                 bool seeded) {
  doe::SobolIndicesOptions options;
  options.samples = samples;
  options.second_order = second_order;
  options.estimator = estimator_of(estimator);
  options.confidence = confidence;
  const auto ask = [](const auto&... with) { return doe::sobol_indices(with...); };
  return list_of(
      answer({"doe::sobol_indices: ", f, problem, seed, vectorized, seeded}, options, ask).responses);
}

py::list screening(const py::object& f, const doe::Problem& problem, int trajectories, int levels,
                   doe::Seed seed, bool vectorized, bool seeded) {
  const doe::MorrisOptions options{.trajectories = trajectories, .levels = levels};
  const auto ask = [](const auto&... with) { return doe::morris_screening(with...); };
  return list_of(
      answer({"doe::morris_screening: ", f, problem, seed, vectorized, seeded}, options, ask).responses);
}

py::list effects(const py::object& f, const doe::Problem& problem, int levels, int samples, doe::Seed seed,
                 bool vectorized, bool seeded) {
  const doe::MainEffectsOptions options{.levels = levels, .samples = samples};
  const auto ask = [](const auto&... with) { return doe::main_effects(with...); };
  return list_of(answer({"doe::main_effects: ", f, problem, seed, vectorized, seeded}, options, ask));
}

}  // namespace

void bind_sensitivity(py::module_& m) {
  m.def("sobol_indices", &indices);
  m.def("morris_screening", &screening);
  m.def("main_effects", &effects);
}

}  // namespace drawpoint::python
