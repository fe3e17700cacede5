// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/python/black_box.h>
#include <cmath>
#include <drawpoint/kriging/optimize.hpp>
#include <optional>

/// `optimize`, the optimum of an expensive function in one call.

namespace drawpoint::python {

namespace {

/// d numbers each, of points below each other.
Eigen::MatrixXd rows_of(const std::vector<kriging::OptimalPoint>& points, Eigen::Index columns,
                        Eigen::VectorXd kriging::OptimalPoint::*part) {
  Eigen::MatrixXd rows(points.size(), columns);
  for (std::size_t i = 0; i < points.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = points[i].*part;
  return rows;
}

py::dict points_of(const std::vector<kriging::OptimalPoint>& points, const doe::Problem& problem) {
  using Point = kriging::OptimalPoint;
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  const auto r = static_cast<Eigen::Index>(problem.responses.size());
  std::vector<std::int64_t> runs;
  for (const Point& point : points) runs.push_back(point.run);
  py::dict result;
  result["run"] = runs;
  result["x"] = rows_of(points, d, &Point::x);
  result["y"] = rows_of(points, r, &Point::y);
  result["lower"] = rows_of(points, r, &Point::lower);
  result["upper"] = rows_of(points, r, &Point::upper);
  return result;
}

/// A failed run has NaN in the place of its values.
Eigen::VectorXd values_of(const doe::Outcome& outcome, std::size_t responses) {
  if (!outcome.failed()) return outcome.values();
  return Eigen::VectorXd::Constant(static_cast<Eigen::Index>(responses), std::nan(""));
}

py::dict table_of(const doe::Evaluations& runs) {
  const std::size_t n = runs.rows.size(), r = runs.problem.responses.size();
  Eigen::MatrixXd X(n, runs.problem.variables.size()), Y(n, r);
  Eigen::VectorXd seconds(n);
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    X.row(row) = runs.rows[i].x;
    Y.row(row) = values_of(runs.rows[i].outcome, r);
    seconds[row] = runs.rows[i].seconds;
    reasons.push_back(runs.rows[i].outcome.reason());
  }
  py::dict table;
  table["X"] = std::move(X);
  table["Y"] = std::move(Y);
  table["seconds"] = std::move(seconds);
  table["reasons"] = reasons;
  return table;
}

py::dict dict_of(const kriging::Optimum& found) {
  py::dict result;
  result["best"] = points_of(found.best, found.runs.problem);
  if (found.expected)
    result["expected"] = points_of({*found.expected}, found.runs.problem);
  else
    result["expected"] = py::none();
  result["runs"] = table_of(found.runs);
  result["feasible"] = found.feasible;
  result["exact"] = found.exact;
  result["status"] = std::string(to_string(found.status));
  result["message"] = found.message;
  return result;
}

/// callback(x, y) of Python after each run; what it raises ends the search.
std::function<void(const doe::Evaluation&)> reporter(py::handle callback, std::size_t responses,
                                                     Interrupt& interrupt) {
  if (callback.is_none()) return {};
  return [callback, responses, &interrupt](const doe::Evaluation& run) {
    const py::gil_scoped_acquire gil;
    if (interrupt.requested()) return;
    try {
      callback(run.x, values_of(run.outcome, responses));
    } catch (py::error_already_set&) {
      interrupt.keep_current();
    }
  };
}

py::dict optimized(const py::object& f, const doe::Problem& problem, int budget, doe::Seed seed, int threads,
                   std::optional<int> first, const std::string& journal, double time_limit, bool seeded,
                   const py::object& callback) {
  Interrupt interrupt;
  kriging::OptimizeOptions options;
  options.seed = seed;
  options.threads = threads;
  options.first = first;
  options.journal = journal;
  options.time_limit = time_limit;
  options.stop = interrupt.token();
  options.on_result = reporter(callback, problem.responses.size(), interrupt);
  const PythonFunction function(f, seeded, interrupt);
  const kriging::Optimum found =
      interrupt.run(threads != 1, [&] { return kriging::optimize(function, problem, budget, options); });
  return dict_of(found);
}

}  // namespace

void bind_optimize(py::module_& m) { m.def("optimize", &optimized); }

}  // namespace drawpoint::python
