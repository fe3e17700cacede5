// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/python/interrupt.h>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/seed.hpp>

#include <functional>
#include <span>
#include <stop_token>
#include <vector>

/// Python functions, and fitted models, as black boxes.

namespace drawpoint::python {

/// f(x) or f(x, seed) in Python, x a new array of d numbers. Called with the GIL held, from any thread. An
/// Exception, and what is no number, is a failed run; any other exception ends the search.
class PythonFunction {
 public:
  PythonFunction(py::handle f, bool seeded, Interrupt& interrupt)
      : f_(f), seeded_(seeded), interrupt_(&interrupt) {}

  doe::Outcome operator()(const Eigen::VectorXd& x, doe::Seed seed, const std::stop_token& stop) const;

 private:
  py::handle f_;  // the caller's: copied without the GIL, which a reference count would need
  bool seeded_;
  Interrupt* interrupt_;
};

/// Any of the three below, a batch black box, so that searches are compiled once.
struct Batch {
  using Function =
      std::function<std::vector<doe::Outcome>(const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds)>;
  Function f;
  std::vector<doe::Outcome> operator()(const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds) const {
    return f(X, seeds);
  }
};

/// f: a list of fitted models, one per response, or a function of one point, or, `vectorized`, of n x d points that
/// gives n or n x r numbers; an exception of the last ends the search. Throws std::invalid_argument, in the name of
/// `place`, for models of other variables or of another number than the responses.
Batch batch_of(const std::string& place, const py::object& f, bool vectorized, bool seeded,
               const doe::Problem& problem, Interrupt& interrupt);

}  // namespace drawpoint::python
