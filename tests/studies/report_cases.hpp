// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/studies/say/page/report.h>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/validate.hpp>

#include <fstream>
#include <iterator>
#include <string>

/// Studies of a formula, small enough to fit in an instant, in the shapes that a report must cope with.
namespace drawpoint::studies::report_cases {

inline const std::string nasty = "</script><script>alert(1)</script><!-- & \"quoted\" \xff";

/// Smooth, d variables in [0, 2], r responses: yⱼ = Σₖ (k + 1) xₖ / (j + 1) + sin(x₀).
inline doe::Problem problem(int d, int r) {
  doe::Problem p;
  for (int k = 0; k < d; ++k) p.variables.push_back({std::string(1, 'x') + std::to_string(k), "m", 0.0, 2.0});
  for (int j = 0; j < r; ++j)
    p.responses.push_back(
        {std::string(1, 'y') + std::to_string(j), "s", j % 2 ? doe::Goal::minimize : doe::Goal::maximize});
  return p;
}

inline Eigen::VectorXd formula(const Eigen::VectorXd& x, int r) {
  Eigen::VectorXd y(r);
  for (int j = 0; j < r; ++j) {
    y[j] = std::sin(x[0]);
    for (Eigen::Index k = 0; k < x.size(); ++k) y[j] += static_cast<double>(k + 1) * x[k] / (j + 1.0);
  }
  return y;
}

/// All that a study passes to the report after runs and validation runs; the front is the rows of the
/// training table.
inline ReportInput input(int d, int r, int runs, int validation) {
  ReportInput in;
  in.study = "formula";
  in.problem = problem(d, r);
  const auto f = [r](const Eigen::VectorXd& x) { return doe::Outcome(formula(x, r)); };
  in.training = doe::evaluate(f, in.problem, doe::latin_hypercube(in.problem, runs));
  if (validation > 0)
    in.validation = doe::evaluate(f, in.problem, doe::uniform_random(in.problem, validation, {.seed = 7}));
  in.validation.problem = in.problem;
  in.front.X = in.training.X();
  in.front.Y.resize(runs, r);
  for (int j = 0; j < r; ++j) {
    const std::string& name = in.problem.responses[static_cast<std::size_t>(j)].name;
    in.front.Y.col(j) = in.training.y(name);
    in.models.push_back(kriging::fit(in.training.X(), in.training.y(name)));
    in.validations.push_back(
        validation > 0 ? kriging::validate(in.models.back(), in.validation.X(), in.validation.y(name))
                       : kriging::Validation{});
  }
  return in;
}

/// Every run failed: no models, no front.
inline ReportInput failed_input() {
  ReportInput in;
  in.study = "broken";
  in.problem = problem(2, 2);
  const auto f = [](const Eigen::VectorXd&) { return doe::Outcome(doe::Failure{nasty}); };
  in.training = doe::evaluate(f, in.problem, doe::latin_hypercube(in.problem, 5));
  in.validation = doe::evaluate(f, in.problem, doe::uniform_random(in.problem, 3));
  return in;
}

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The data as a browser would read it: up to the first "</script" after the element's begin.
inline nlohmann::json data_in(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"report-data\">";
  const std::size_t begin = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script", begin) - begin));
}

}  // namespace drawpoint::studies::report_cases
