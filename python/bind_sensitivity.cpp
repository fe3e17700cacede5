// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/python/black_box.h>
#include <drawpoint/doe/sensitivity.hpp>

/// Sobol' indices of a Python function or of fitted models.

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
  const doe::Sensitivity result =
      interrupt.run(false, [&] { return doe::sobol_indices(batch, problem, options); });
  py::list all;
  for (const doe::SobolIndices& of_response : result.responses) all.append(dict_of(of_response));
  return all;
}

}  // namespace

void bind_sensitivity(py::module_& m) { m.def("sobol_indices", &indices); }

}  // namespace drawpoint::python
