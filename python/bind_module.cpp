// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/python/bind.h>

/// `drawpoint._core`, the compiled part of the Python package. People use the package (python/drawpoint), which
/// names shapes, units and errors.

PYBIND11_MODULE(_core, m) {
  m.doc() = "The compiled part of drawpoint; use the package.";
  drawpoint::python::bind_problem(m);
  drawpoint::python::bind_designs(m);
  drawpoint::python::bind_model(m);
  drawpoint::python::bind_fit(m);
  drawpoint::python::bind_optimize(m);
  drawpoint::python::bind_searches(m);
  drawpoint::python::bind_sensitivity(m);
}
