// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/python/bind.h>
#include <algorithm>
#include <drawpoint/kriging/model.hpp>
#include <drawpoint/kriging/nearest_model.hpp>
#include <drawpoint/kriging/save.hpp>
#include <drawpoint/kriging/save_nearest.hpp>
#include <drawpoint/kriging/validate.hpp>

/// The fitted models, of all runs and of the nearest: predictions, numbers, text.

namespace drawpoint::python {

namespace {

using Points = Eigen::Ref<const Eigen::MatrixXd>;  // column-major arrays are read where they lie

kriging::Target target_of(bool observation) {
  return observation ? kriging::Target::observation : kriging::Target::latent;
}

/// Calls f(first row, rows) for some thousand rows at a time: beside the array there is never a copy of all of
/// it, and between two calls Ctrl-C ends the work.
template <class F>
void in_blocks(Eigen::Index rows, const F& f) {
  constexpr Eigen::Index block = 4096;  // a multiple of the model's own block, so that bits stay
  for (Eigen::Index from = 0; from < rows || from == 0; from += block) {
    {
      const py::gil_scoped_release release;
      f(from, std::min(block, rows - from));
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

template <class Model>
Eigen::VectorXd mean_of(const Model& model, const Points& X) {
  Eigen::VectorXd mean(X.rows());
  in_blocks(X.rows(), [&](Eigen::Index from, Eigen::Index rows) {
    mean.segment(from, rows) = model.mean(X.middleRows(from, rows));
  });
  return mean;
}

kriging::Prediction predicted(const kriging::Model& model, const Eigen::MatrixXd& X, kriging::Target target,
                              int threads) {
  return model.predict(X, target, threads);
}

/// A model by the nearest runs keeps the threads of its fit.
kriging::Prediction predicted(const kriging::NearestModel& model, const Eigen::MatrixXd& X,
                              kriging::Target target, int) {
  return model.predict(X, target);
}

template <class Model>
std::pair<Eigen::VectorXd, Eigen::VectorXd> prediction_of(const Model& model, const Points& X,
                                                          bool observation, int threads) {
  Eigen::VectorXd mean(X.rows()), variance(X.rows());
  in_blocks(X.rows(), [&](Eigen::Index from, Eigen::Index rows) {
    const kriging::Prediction p = predicted(model, X.middleRows(from, rows), target_of(observation), threads);
    mean.segment(from, rows) = p.mean;
    variance.segment(from, rows) = p.variance;
  });
  return {std::move(mean), std::move(variance)};
}

/// What both kinds of model have. from_text(text) and load(path): of this kind.
template <class Model>
py::class_<Model> bind_regression(py::module_& m, const char* name, Model (*from_text)(const std::string&),
                                  Model (*load)(const std::filesystem::path&)) {
  py::class_<Model> bound(m, name);
  bound.def("mean", &mean_of<Model>)
      .def("predict", &prediction_of<Model>)
      .def(
          "validate",
          [](const Model& model, const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
            return kriging::validate(model, X, y);
          },
          ReleaseGil())
      .def("to_text", [](const Model& model) { return kriging::to_text(model); })
      .def_static("from_text", from_text)
      .def(
          "save", [](const Model& model, const std::string& path) { kriging::save(model, path); },
          ReleaseGil())
      .def_static(
          "load", [load](const std::string& path) { return load(path); }, ReleaseGil())
      .def_property_readonly("variables", &Model::variables)
      .def_property_readonly("runs", &Model::runs)
      .def_property_readonly("theta", [](const Model& model) { return model.theta(); })
      .def_property_readonly("nugget", &Model::nugget)
      .def_property_readonly("process_variance", &Model::process_variance)
      .def_property_readonly("noise_variance", &Model::noise_variance)
      .def_property_readonly("log_likelihood", &Model::log_likelihood)
      .def_property_readonly("status",
                             [](const Model& model) { return std::string(to_string(model.status())); })
      .def_property_readonly("message", &Model::message)
      .def_property_readonly(
          "correlation",
          [](const Model& model) { return std::string(to_string(model.correlation().family)); })
      .def(py::pickle([](const Model& model) { return kriging::to_text(model); }, from_text));
  return bound;
}

}  // namespace

void bind_model(py::module_& m) {
  using kriging::Model, kriging::NearestModel;
  bind_regression<Model>(m, "Model", &kriging::from_text, &kriging::load)
      .def("covariance", &Model::covariance, ReleaseGil())
      .def("gradient",
           [](const Model& model, const Eigen::VectorXd& x) {
             const kriging::PredictionGradient g = model.gradient(x);
             return std::pair(g.mean, g.variance);
           })
      .def_property_readonly("trend", &Model::trend_coefficients)
      .def_property_readonly("constant", &Model::trend)
      .def_property_readonly("condition", [](const Model& model) { return model.report().condition; });
  bind_regression<NearestModel>(m, "NearestModel", &kriging::nearest_from_text, &kriging::load_nearest)
      .def_property_readonly("neighbourhood",
                             [](const NearestModel& model) { return model.state().neighbourhood; })
      .def_property_readonly("error_of_mean", [](const NearestModel& model) { return model.error().mean; });

  py::class_<kriging::Validation>(m, "Validation")
      .def_readonly("rmse", &kriging::Validation::rmse)
      .def_readonly("nrmse", &kriging::Validation::nrmse)
      .def_readonly("observed", &kriging::Validation::observed)
      .def_readonly("predicted", &kriging::Validation::predicted)
      .def_readonly("variance", &kriging::Validation::variance)
      .def_readonly("observation_variance", &kriging::Validation::observation_variance)
      .def(
          "score",
          [](const kriging::Validation& v, const std::string& error, double level) {
            using kriging::ErrorFunction;
            return kriging::score(
                v,
                named("kriging::score: error", error,
                      {ErrorFunction::rmse, ErrorFunction::nrmse, ErrorFunction::mae, ErrorFunction::q2,
                       ErrorFunction::nlpd, ErrorFunction::coverage, ErrorFunction::crps}),
                level);
          },
          py::arg("error"), py::arg("level") = 0.95);
}

}  // namespace drawpoint::python
