// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What the files bind_*.cpp share: the parts of the module, and choices that Python names by text.
///
/// NumPy arrays of another order or type than column-major float64 are converted once; results are moved into
/// arrays, column-major, without a copy. std::invalid_argument becomes ValueError, std::runtime_error RuntimeError.

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <Eigen/Core>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::python {

namespace py = pybind11;

void bind_problem(py::module_& m);
void bind_designs(py::module_& m);
void bind_model(py::module_& m);
void bind_fit(py::module_& m);
void bind_optimize(py::module_& m);
void bind_searches(py::module_& m);
void bind_sensitivity(py::module_& m);

using ReleaseGil = py::call_guard<py::gil_scoped_release>;

/// The value of E whose to_string is the text. Throws std::invalid_argument that begins with `place` and lists
/// what is allowed.
template <class E>
E named(const std::string& place, const std::string& text, std::initializer_list<E> allowed) {
  std::string list;
  for (const E value : allowed) {
    if (to_string(value) == text) return value;
    list += (list.empty() ? "" : ", ") + std::string(to_string(value));
  }
  throw std::invalid_argument(place + " is \"" + text + "\"; allowed are " + list);
}

}  // namespace drawpoint::python
