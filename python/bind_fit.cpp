// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/python/bind.h>
#include <algorithm>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/fit_nearest.hpp>
#include <optional>

/// Fits, the choice among ways to fit, and cross-validation.

namespace drawpoint::python {

namespace {

kriging::Correlation correlation_of(const std::string& text) {
  using kriging::Correlation;
  return named(
      "kriging::fit: correlation", text,
      {Correlation::gaussian, Correlation::power_exponential, Correlation::matern32, Correlation::matern52});
}

kriging::Trend trend_of(const std::string& text) {
  using kriging::Trend;
  return named("kriging::fit: trend", text, {Trend::constant, Trend::linear, Trend::quadratic, Trend::blind});
}

kriging::Noise noise_of(const std::string& text) {
  using kriging::Noise;
  return named("kriging::fit: noise", text,
               {Noise::nugget, Noise::known, Noise::pooled, Noise::proportional, Noise::none});
}

kriging::Structure structure_of(const std::string& text) {
  using kriging::Structure;
  return named("kriging::fit: structure", text,
               {Structure::product, Structure::isotropic, Structure::additive});
}

kriging::Estimation estimation_of(const std::string& text) {
  if (text == "penalized_likelihood") return kriging::Estimation::penalized_likelihood;
  if (text == "maximum_likelihood") return kriging::Estimation::maximum_likelihood;
  throw std::invalid_argument("kriging::fit: estimation is \"" + text +
                              "\"; allowed are penalized_likelihood, maximum_likelihood");
}

void bind_options(py::module_& m) {
  using Options = kriging::FitOptions;
  py::class_<Options>(m, "FitOptions")
      .def(py::init())
      .def("set_kind",
           [](Options& o, const std::string& correlation, const std::string& trend) {
             o.correlation = correlation_of(correlation);
             o.trend = trend_of(trend);
           })
      .def("set_structure", [](Options& o, const std::string& text) { o.structure = structure_of(text); })
      .def("set_estimation", [](Options& o, const std::string& text) { o.estimation = estimation_of(text); })
      .def("set_noise",
           [](Options& o, const std::string& kind, const Eigen::VectorXd& variance) {
             o.noise = noise_of(kind);
             o.noise_variance = variance;
           })
      .def("set_box",
           [](Options& o, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
             o.lower = lower;
             o.upper = upper;
           })
      .def("set_theta_bounds",
           [](Options& o, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
             const auto of = [](const Eigen::VectorXd& v) {
               return v.size() == 1 ? kriging::PerVariable(v[0]) : kriging::PerVariable(v);
             };
             o.theta_lower = of(lower);
             o.theta_upper = of(upper);
           })
      .def("set_nugget_bounds",
           [](Options& o, double lower, double upper) {
             o.nugget_lower = lower;
             o.nugget_upper = upper;
           })
      .def_readwrite("may_be_exact", &Options::may_be_exact)
      .def_readwrite("levels", &Options::levels)
      .def_readwrite("starts", &Options::starts)
      .def_readwrite("seed", &Options::seed)
      .def_readwrite("threads", &Options::threads);
}

/// The ways as Python shows them: one tuple each of name, log score, gain, its standard error, gain over the box.
py::list table_of(const kriging::FitChoice& choice) {
  py::list table;
  for (const kriging::FitStanding& s : choice.table)
    table.append(py::make_tuple(s.name, s.log_score, s.gain, s.standard_error, s.box_gain));
  return table;
}

/// Half as many neighbours in the likelihood as a prediction rests on, as by default.
kriging::NearestOptions nearest_of(int neighbourhood) {
  return {.neighbours = std::max(neighbourhood / 2, 8), .neighbourhood = neighbourhood};
}

py::tuple chosen(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                 const std::vector<kriging::FitOptions>& kinds, const Eigen::VectorXd& noise_variance) {
  kriging::RunNoise noise;
  if (noise_variance.size() > 0) noise = {kriging::Noise::known, noise_variance};
  const kriging::FitChoice choice = [&] {
    const py::gil_scoped_release release;
    return kriging::choose_fit(X, y, kinds, {}, noise);
  }();
  return py::make_tuple(choice.model.model(), choice.best, table_of(choice));
}

}  // namespace

void bind_fit(py::module_& m) {
  bind_options(m);
  m.def(
      "fit",
      [](const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const kriging::FitOptions& options) {
        return kriging::fit(X, y, options);
      },
      ReleaseGil());
  m.def("choose_fit", &chosen);
  m.def(
      "leave_one_out", [](const kriging::Model& model) { return kriging::leave_one_out(model); },
      ReleaseGil());
  m.def(
      "fit_nearest",
      [](const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const kriging::FitOptions& options,
         int neighbourhood) { return kriging::fit_nearest(X, y, options, nearest_of(neighbourhood)); },
      ReleaseGil());
  m.def(
      "k_fold",
      [](const Eigen::MatrixXd& X, const Eigen::VectorXd& y, int folds, const kriging::FitOptions& options,
         doe::Seed seed, std::optional<int> neighbourhood) {
        const auto fitter = [&](const Eigen::MatrixXd& P, const Eigen::VectorXd& v,
                                const std::vector<Eigen::Index>& rows) {
          kriging::FitOptions mine = options;
          if (options.noise_variance.size() > 0) mine.noise_variance = options.noise_variance(rows);
          if (!neighbourhood) return kriging::AnySurrogate(kriging::fit(P, v, mine));
          return kriging::AnySurrogate(kriging::fit_nearest(P, v, mine, nearest_of(*neighbourhood)));
        };
        return kriging::k_fold(X, y, folds, fitter, {.seed = seed});
      },
      ReleaseGil());
}

}  // namespace drawpoint::python
