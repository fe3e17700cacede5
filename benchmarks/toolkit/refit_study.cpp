// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// refit_study STUDY_DB: how well each kind of surrogate predicts the runs of a finished study.
///
/// For each response and each way to fit, three errors over the range of the observations that they are taken
/// on: leave-one-out in closed form (parameters kept), 10-fold with everything estimated anew, and the
/// validation runs, with the per cent of these that lie within their 95 % interval. Beside them the noise of
/// a run as the fit estimates it, over the range of the validation runs: no model gets below it there.
/// A second table has the scales on which the response may be fitted (kriging/choose_fit.hpp): the mean
/// logarithmic score of leave-one-out, its gain over the linear scale by runs and by shares of the box, each
/// with its standard error, and of the validation runs the ranked probability score in the response's unit,
/// NRMSE and the per cent within their 95 % interval. "likeliest" is plain maximum likelihood with its
/// parameters taken as known. With replicates in the store, the same noise from their scatter,
/// √(Σ(y - mean)²/(n - points)), which no model has a part in. Times are CPU seconds of one fit.

#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/benchmarks/toolkit/cpu_time.hpp>
#include <drawpoint/doe/bounds.hpp>
#include <drawpoint/doe/detail/enumerators.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/compare.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/fit_radial.hpp>
#include <drawpoint/kriging/polynomial.hpp>
#include <drawpoint/kriging/validate.hpp>

namespace {

using namespace drawpoint;
using Way = kriging::NamedFitter<>;

struct Table {
  Eigen::MatrixXd X, Y;
  std::vector<std::int64_t> points;
};

Table table_of(const studies::Store& store, studies::Kind kind) {
  std::vector<studies::Run> runs;
  for (const auto& run : store.runs())
    if (run.kind == kind && run.status == studies::Status::done) runs.push_back(run);
  const auto& problem = store.identity().problem;
  const auto n = static_cast<Eigen::Index>(runs.size());
  Table table{Eigen::MatrixXd(n, static_cast<Eigen::Index>(problem.variables.size())),
              Eigen::MatrixXd(n, static_cast<Eigen::Index>(problem.responses.size())),
              {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& run = runs[static_cast<std::size_t>(i)];
    table.X.row(i) = run.x.transpose();
    table.Y.row(i) = run.y.transpose();
    table.points.push_back(run.point);
  }
  return table;
}

struct Box {
  Eigen::VectorXd lower, upper;
};

void add_kriging(const Box& box, std::vector<Way>& ways) {
  const std::map<kriging::Trend, std::string> trends = {{kriging::Trend::constant, "constant"},
                                                        {kriging::Trend::linear, "linear"},
                                                        {kriging::Trend::quadratic, "quadratic"},
                                                        {kriging::Trend::blind, "blind"}};
  for (const auto correlation : {kriging::Correlation::gaussian, kriging::Correlation::matern52,
                                 kriging::Correlation::matern32, kriging::Correlation::power_exponential})
    for (const auto& [trend, name] : trends) {
      kriging::FitOptions options;
      options.lower = box.lower;
      options.upper = box.upper;
      options.correlation = correlation;
      options.trend = trend;
      options.threads = 0;
      ways.push_back({std::string(to_string(correlation)) + ", " + name,
                      [options](const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
                        return kriging::fit(X, y, options);
                      }});
    }
}

void add_likeliest(const Box& box, std::vector<Way>& ways) {
  kriging::FitOptions options;
  options.lower = box.lower;
  options.upper = box.upper;
  options.estimation = kriging::Estimation::maximum_likelihood;
  options.parameter_uncertainty = false;
  ways.push_back({"gaussian, likeliest", [options](const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
                    return kriging::fit(X, y, options);
                  }});
}

void add_others(const Box& box, std::vector<Way>& ways) {
  for (const int degree : {2, 3}) {
    const auto selection = degree == 2 ? kriging::Selection::all : kriging::Selection::leave_one_out;
    ways.push_back({degree == 2 ? "quadratic polynomial" : "cubic polynomial, selected",
                    [degree, selection](const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
                      return kriging::fit_polynomial(X, y, {.degree = degree, .selection = selection});
                    }});
  }
  for (const auto function : {kriging::RadialFunction::cubic, kriging::RadialFunction::multiquadric})
    ways.push_back({std::string("radial, ") + std::string(to_string(function)),
                    [function, box](const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
                      return kriging::fit_radial(
                          X, y, {.function = function, .lower = box.lower, .upper = box.upper});
                    }});
}

double noise_of(const kriging::AnySurrogate& model) {
  const auto* fitted = model.as<kriging::Model>();
  return fitted ? std::sqrt(fitted->noise_variance()) : std::numeric_limits<double>::quiet_NaN();
}

void row(const Way& way, const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const Table& validation,
         Eigen::Index response) {
  const double start = benchmarks::cpu_seconds();
  const kriging::AnySurrogate model = way.fitter(X, y);
  const double seconds = benchmarks::cpu_seconds() - start;
  const auto error = [&](kriging::Estimator estimator) {
    return kriging::assess({.estimator = estimator, .error = kriging::ErrorFunction::nrmse, .folds = 10}, X,
                           y, way.fitter)
        .value;
  };
  std::printf("| %-28s | %.4f | %.4f |", way.name.c_str(), error(kriging::Estimator::leave_one_out),
              error(kriging::Estimator::k_fold));
  if (validation.X.rows() > 0) {
    const kriging::Validation v = kriging::validate(model, validation.X, validation.Y.col(response));
    const double range = v.observed.maxCoeff() - v.observed.minCoeff();
    std::printf(" %.4f | %3.0f | %.4f |", v.nrmse, 100.0 * score(v, kriging::ErrorFunction::coverage),
                noise_of(model) / range);
  }
  std::printf(" %.2f |\n", seconds);
}

/// Nothing is printed without replicates.
void scatter(const Table& runs, Eigen::Index response) {
  std::map<std::int64_t, std::vector<double>> by_point;
  for (std::size_t i = 0; i < runs.points.size(); ++i)
    by_point[runs.points[i]].push_back(runs.Y(static_cast<Eigen::Index>(i), response));
  double squares = 0.0;
  for (const auto& [point, values] : by_point) {
    const Eigen::Map<const Eigen::VectorXd> y(values.data(), static_cast<Eigen::Index>(values.size()));
    squares += (y.array() - y.mean()).square().sum();
  }
  const auto freedom = runs.points.size() - by_point.size();
  if (freedom > 0)
    std::printf("scatter of replicates: %.4g, %zu degrees of freedom\n",
                std::sqrt(squares / static_cast<double>(freedom)), freedom);
}

void scales(const Box& box, const doe::Response& response, const Table& training, const Table& validation,
            Eigen::Index j) {
  kriging::FitOptions options;
  options.lower = box.lower;
  options.upper = box.upper;
  options.threads = 0;
  const kriging::ResponseRange range{response.lower, response.upper};
  const Eigen::VectorXd y = training.Y.col(j);
  const kriging::FitChoice choice = kriging::choose_scale(training.X, y, range, options);
  std::printf("| scale | leave-one-out | gain | over the box | validation, crps | NRMSE | within |\n");
  for (const kriging::FitStanding& s : choice.table) {
    std::printf("| %s%s | %.4g | %.3g ± %.3g | %.3g ± %.3g |", s.name.c_str(),
                s.name == choice.name() ? " (chosen)" : "", s.log_score, s.gain, s.standard_error, s.box_gain,
                s.box_standard_error);
    if (validation.X.rows() > 0) {
      const auto scale = *doe::detail::enumerator_of<kriging::Scale>(s.name);
      const auto model = kriging::fit_transformed(training.X, y, scale, range, options);
      const kriging::Validation v = kriging::validate(model, validation.X, validation.Y.col(j));
      std::printf(" %.4g | %.4f | %3.0f |", score(v, kriging::ErrorFunction::crps), v.nrmse,
                  100.0 * score(v, kriging::ErrorFunction::coverage));
    }
    std::printf("\n");
  }
}

void refit(const studies::Store& store) {
  const Table training = table_of(store, studies::Kind::training),
              validation = table_of(store, studies::Kind::validation);
  const auto& problem = store.identity().problem;
  std::vector<Way> ways;
  const Box box{doe::lower_bounds(problem), doe::upper_bounds(problem)};
  add_kriging(box, ways);
  add_likeliest(box, ways);
  add_others(box, ways);
  for (Eigen::Index j = 0; j < training.Y.cols(); ++j) {
    std::printf("\n%s, %ld training and %ld validation runs\n",
                problem.responses[static_cast<std::size_t>(j)].name.c_str(),
                static_cast<long>(training.X.rows()), static_cast<long>(validation.X.rows()));
    scatter(training, j);
    std::printf("| way to fit | leave-one-out | 10-fold | validation | within | noise | CPU s |\n");
    for (const Way& way : ways) row(way, training.X, training.Y.col(j), validation, j);
    scales(box, problem.responses[static_cast<std::size_t>(j)], training, validation, j);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: refit_study STUDY_DB, the study.db of a finished study\n");
    return 2;
  }
  try {
    refit(studies::Store::open(argv[1]));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
