// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/python/black_box.h>
#include <drawpoint/kriging/nearest_model.hpp>
#include <drawpoint/kriging/surrogates.hpp>

namespace drawpoint::python {

namespace {

/// "ValueError: too steep": without the traceback, which a table of runs has no place for.
std::string reason_of(const py::error_already_set& error) {
  const std::string type = py::str(error.type().attr("__name__")), text = py::str(error.value());
  return text.empty() ? type : type + ": " + text;
}

/// An array of real numbers, or nothing.
py::array numbers_of(const py::object& result) {
  py::array numbers = py::array::ensure(result);
  if (!numbers) PyErr_Clear();
  const bool real = numbers && std::string("biuf").find(numbers.dtype().kind()) != std::string::npos;
  return real ? numbers : py::array();
}

std::string kind_of(const py::object& result) {
  return "returned " + std::string(py::str(py::type::of(result).attr("__name__"))) +
         ", which is not a number or a sequence of numbers";
}

doe::Outcome outcome_of(const py::object& result) {
  const py::array numbers = numbers_of(result);
  if (numbers.size() == 0) return doe::Failure{kind_of(result)};
  return doe::Outcome(numbers.attr("ravel")().cast<Eigen::VectorXd>());
}

std::vector<doe::Outcome> outcomes_of(const py::object& result, Eigen::Index rows) {
  const py::array numbers = numbers_of(result);
  if (numbers.ndim() < 1 || numbers.ndim() > 2 || numbers.shape(0) != rows)
    throw py::value_error("drawpoint: the vectorized function was given " + std::to_string(rows) +
                          " points and returned " +
                          std::string(py::str(py::getattr(result, "shape", py::type::of(result)))) +
                          "; allowed are arrays of one row per point: (n,) or (n, responses)");
  const auto Y = numbers.attr("reshape")(rows, -1).cast<Eigen::MatrixXd>();
  std::vector<doe::Outcome> outcomes;
  for (Eigen::Index i = 0; i < rows; ++i) outcomes.emplace_back(Eigen::VectorXd(Y.row(i)));
  return outcomes;
}

Batch::Function of_points(PythonFunction function, Interrupt& interrupt) {
  return [function = std::move(function), &interrupt](const Eigen::MatrixXd& X,
                                                      std::span<const doe::Seed> seeds) {
    std::vector<doe::Outcome> outcomes;
    for (Eigen::Index i = 0; i < X.rows(); ++i)
      outcomes.push_back(
          function(X.row(i).transpose(), seeds[static_cast<std::size_t>(i)], interrupt.token()));
    return outcomes;
  };
}

Batch::Function of_arrays(py::handle f, Interrupt& interrupt) {
  return [f, &interrupt](const Eigen::MatrixXd& X, std::span<const doe::Seed>) {
    const py::gil_scoped_acquire gil;
    try {
      interrupt.check_signals();
      if (!interrupt.requested()) return outcomes_of(f(X), X.rows());
    } catch (...) {
      interrupt.keep_current();
    }
    return std::vector<doe::Outcome>(static_cast<std::size_t>(X.rows()), doe::Failure{"ended"});
  };
}

Batch::Function of_models(const std::string& place, const py::list& list, const doe::Problem& problem,
                          Interrupt& interrupt) {
  std::vector<kriging::AnySurrogate> models;
  for (const py::handle model : list)
    models.push_back(py::isinstance<kriging::NearestModel>(model)
                         ? kriging::AnySurrogate(model.cast<const kriging::NearestModel&>())
                         : kriging::AnySurrogate(model.cast<const kriging::Model&>()));
  const kriging::Surrogates surrogates(std::move(models));
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  if (surrogates.variables() != d)
    throw std::invalid_argument(place + "a model of " + std::to_string(*surrogates.variables()) +
                                " variables is given a box of " + std::to_string(d) +
                                "; allowed is the box of its inputs, in their order");
  if (surrogates.members().size() != problem.responses.size())
    throw std::invalid_argument(place + std::to_string(surrogates.members().size()) + " models for " +
                                std::to_string(problem.responses.size()) + " responses; give one model each");
  return [surrogates, &interrupt](const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds) {
    std::vector<doe::Outcome> outcomes = surrogates(X, seeds);
    const py::gil_scoped_acquire gil;
    interrupt.check_signals();
    return outcomes;
  };
}

}  // namespace

doe::Outcome PythonFunction::operator()(const Eigen::VectorXd& x, doe::Seed seed,
                                        const std::stop_token&) const {
  const py::gil_scoped_acquire gil;
  interrupt_->check_signals();
  if (interrupt_->requested()) return doe::Failure{"ended"};
  try {
    return outcome_of(seeded_ ? f_(x, seed) : f_(x));
  } catch (py::error_already_set& error) {
    if (error.matches(PyExc_Exception)) return doe::Failure{reason_of(error)};
    interrupt_->keep_current();
    return doe::Failure{"ended"};
  }
}

Batch batch_of(const std::string& place, const py::object& f, bool vectorized, bool seeded,
               const doe::Problem& problem, Interrupt& interrupt) {
  if (py::isinstance<py::list>(f)) return {of_models(place, f, problem, interrupt)};
  if (vectorized) return {of_arrays(f, interrupt)};
  return {of_points(PythonFunction(f, seeded, interrupt), interrupt)};
}

}  // namespace drawpoint::python
