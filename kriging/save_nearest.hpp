// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Kriging models of many runs as JSON text: `save(model, "wear.json")`, `load_nearest("wear.json")`.
///
/// The format is that of save.hpp, whose checks hold here too, with "format": "drawpoint nearest Kriging model"
/// and "version": 1, with categories 2, isotropic 3. The file holds the runs and the parameters; cells and weights are
/// computed anew by the same operations, so that a loaded model predicts the same bits. Size 25 bytes per
/// number of the runs, cost of reading that of NearestModel's constructor.

#include <Eigen/Core>
#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/kriging/detail/saved_parts.hpp>
#include <drawpoint/kriging/nearest_model.hpp>
#include <filesystem>
#include <string>
#include <utility>

namespace drawpoint::kriging {

namespace detail {

inline constexpr FileKind nearest_file{"drawpoint nearest Kriging model", 1, true};

inline Json json_of(const NearestState& state) {
  const ModelState& s = state.all;
  return {{"input", {{"centre", json_vector(s.input.centre)}, {"factor", json_vector(s.input.factor)}}},
          {"response", {{"centre", s.y_centre}, {"scale", s.y_scale}, {"observed", json_vector(s.observed)}}},
          {"correlation", json_of(s.correlation)},
          {"noise", json_of_noise(s)},
          {"trend", json_of(s.trend.terms)},
          {"runs", {{"X", json_matrix(s.X)}, {"y", json_vector(s.y)}}},
          {"solution",
           {{"beta", json_vector(s.gls.beta)},
            {"T", json_matrix(s.gls.T)},
            {"sum_of_squares", s.gls.sum_of_squares}}},
          {"process_variance", s.process_variance},
          {"log_likelihood", json_number(s.log_likelihood)},
          {"constant_variance", json_number(s.constant_variance)},
          {"neighbourhood", state.neighbourhood},
          {"threads", state.threads},
          {"error",
           {{"log_density", state.error.log_density},
            {"mean", state.error.mean},
            {"deviation", state.error.deviation}}},
          {"report", json_of(s.report)}};
}

inline void read_runs(const JsonReader& in, Eigen::Index d, ModelState& s) {
  s.y = in.at("runs").at("y").vector(-1);
  const Eigen::Index n = s.y.size();
  if (s.observed.size() < 1 || (n > 0 && n != s.observed.size())) in.at("response").fail("it lacks runs");
  s.X = in.at("runs").at("X").matrix(n, d);
  refuse_other_levels(in.at("runs").at("X"), s.X, s.correlation);
  read_noise(in.at("noise"), n, s);
  s.trend.terms = trend_terms(in.at("trend"), d);
  s.F = trend_matrix(s.trend, s.X, s.X, s.input);  // polynomials in the scaled inputs
  const auto q = n > 0 ? static_cast<Eigen::Index>(s.trend.terms.size()) : 0;
  s.gls.beta = in.at("solution").at("beta").vector(q);
  s.gls.T = in.at("solution").at("T").matrix(q, q);
  s.gls.sum_of_squares = in.at("solution").at("sum_of_squares").number();
  if (!(s.gls.T.diagonal().array() != 0).all()) in.at("solution").at("T").fail("its diagonal holds a 0");
}

inline NearestState nearest_state_of(const JsonReader& in) {
  NearestState state;
  ModelState& s = state.all;
  s.input.centre = in.at("input").at("centre").vector(-1);
  const Eigen::Index d = s.input.centre.size();
  if (d < 1) in.at("input").fail("it has 0 variables");
  s.input.factor = in.at("input").at("factor").vector(d);
  s.observed = in.at("response").at("observed").vector(-1);
  s.y_centre = in.at("response").at("centre").number();
  s.y_scale = in.at("response").at("scale").number();
  read_correlation(in.at("correlation"), d, s.correlation);
  if (s.correlation.structure == Structure::additive)
    in.at("correlation").at("structure").fail("it is \"additive\"");
  read_runs(in, d, s);
  s.process_variance = in.at("process_variance").number();
  s.log_likelihood = in.at("log_likelihood").number(false);
  s.constant_variance = in.at("constant_variance").number(false);
  s.report = report_of(in.at("report"));
  state.neighbourhood = in.at("neighbourhood").integer();
  if (state.neighbourhood < 8) in.at("neighbourhood").fail("it is below 8");
  state.threads = in.at("threads").integer();
  if (state.threads < 0) in.at("threads").fail("it is negative");
  const JsonReader error = in.at("error");
  state.error = {error.at("log_density").number(), error.at("mean").number(), error.at("deviation").number()};
  return state;
}

inline NearestModel nearest_of_text(const std::string& text, const std::string& file) {
  return opened(nearest_file, text, file,
                [](const JsonReader& in) { return NearestModel(nearest_state_of(in)); });
}

}  // namespace detail

/// The model as text. Throws std::invalid_argument for a trend of user functions.
inline std::string to_text(const NearestModel& model) {
  detail::refuse_functions_of_user(model.state().all.trend);
  return detail::enveloped(detail::nearest_file, detail::json_of(model.state()));
}

/// What to_text made. Throws std::runtime_error, with the place and the fault, for anything else.
inline NearestModel nearest_from_text(const std::string& text) {
  return detail::nearest_of_text(text, "the text");
}

/// Writes the model atomically. Throws as to_text, and std::runtime_error when the disk refuses.
inline void save(const NearestModel& model, const std::filesystem::path& path) {
  doe::write_file(path, to_text(model));
}

/// Throws std::runtime_error, with file, place and fault, when the file cannot be read or is not what save
/// wrote.
inline NearestModel load_nearest(const std::filesystem::path& path) {
  return detail::nearest_of_text(detail::text_of_file(path), "\"" + path.string() + "\"");
}

}  // namespace drawpoint::kriging
