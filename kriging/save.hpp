// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Kriging models as JSON text: `save(model, "wear.json")`, `load("wear.json")`.
///
/// The file holds all that makes the model, the factor of R included, so that a loaded model predicts the
/// same bits: {"checksum", "format": "drawpoint kriging model", "model": {...}, "version": 2}, on one line;
/// with categories the version is 3, 4 where the correlation is isotropic or additive, and 5 with two explanations of
/// the runs.
/// Numbers are the shortest text that reads back as the same double; ±∞ and NaN, which JSON lacks, are the
/// texts "inf", "-inf" and "nan", where a field may be that. Matrices are {"columns", "rows", "values"} by
/// columns; of L only the lower triangle. Size 10 n² bytes, cost O(n²). Reading checks format and version,
/// that the text is exactly what this writer makes (so no byte may differ), the checksum (64-bit FNV-1a of
/// the text of "model": against accidents, not against intent), every size, that numbers are finite and that
/// L's diagonal is positive. A model with a trend of user functions cannot be saved. This header,
/// save_fidelities.hpp and save_nearest.hpp alone of the module need nlohmann-json (Debian: nlohmann-json3-dev).

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/kriging/detail/saved_checks.hpp>
#include <drawpoint/kriging/detail/saved_parts.hpp>
#include <drawpoint/kriging/model.hpp>

namespace drawpoint::kriging {

namespace detail {

inline Json json_of(const ModelState& s) {
  Json json{
      {"input", {{"centre", json_vector(s.input.centre)}, {"factor", json_vector(s.input.factor)}}},
      {"response", {{"centre", s.y_centre}, {"scale", s.y_scale}, {"observed", json_vector(s.observed)}}},
      {"correlation", json_of(s.correlation)},
      {"noise", json_of_noise(s)},
      {"trend", json_of(s.trend.terms)},
      {"runs", {{"X", json_matrix(s.X)}, {"F", json_matrix(s.F)}, {"y", json_vector(s.y)}}},
      {"factor", json_vector(packed_lower(s.L))},
      {"solution",
       {{"beta", json_vector(s.gls.beta)},
        {"alpha", json_vector(s.gls.alpha)},
        {"B", json_matrix(s.gls.B)},
        {"T", json_matrix(s.gls.T)},
        {"sum_of_squares", s.gls.sum_of_squares}}},
      {"parameter_spread", json_matrix(s.parameter_spread)},
      {"process_variance", s.process_variance},
      {"log_likelihood", json_number(s.log_likelihood)},
      {"constant_variance", json_number(s.constant_variance)},
      {"report", json_of(s.report)}};
  if (s.other) json["other"] = {{"probability", s.doubt}, {"model", json_of(*s.other)}};
  return json;
}

inline void read_solution(const JsonReader& in, Eigen::Index n, Eigen::Index q, LeastSquares& gls) {
  gls.beta = in.at("beta").vector(q);
  gls.alpha = in.at("alpha").vector(n);
  gls.B = in.at("B").matrix(n, q);
  gls.T = in.at("T").matrix(q, q);
  gls.sum_of_squares = in.at("sum_of_squares").number();
  if (!(gls.T.diagonal().array() != 0).all()) in.at("T").fail("its diagonal holds a 0");
}

inline ModelState state_of(const JsonReader& in) {
  ModelState s;
  s.input.centre = in.at("input").at("centre").vector(-1);
  const Eigen::Index d = s.input.centre.size();
  if (d < 1) in.at("input").fail("it has 0 variables");
  s.input.factor = in.at("input").at("factor").vector(d);
  s.observed = in.at("response").at("observed").vector(-1);
  s.y_centre = in.at("response").at("centre").number();
  s.y_scale = in.at("response").at("scale").number();
  s.y = in.at("runs").at("y").vector(-1);
  const Eigen::Index n = s.y.size();
  if (s.observed.size() < 1 || (n > 0 && n != s.observed.size())) in.at("response").fail("it lacks runs");
  read_correlation(in.at("correlation"), d, s.correlation);
  read_noise(in.at("noise"), n, s);
  s.trend.terms = trend_terms(in.at("trend"), d);
  const Eigen::Index q = n > 0 ? static_cast<Eigen::Index>(s.trend.terms.size()) : 0;
  s.X = in.at("runs").at("X").matrix(n, d);
  s.F = in.at("runs").at("F").matrix(n, q);
  refuse_other_levels(in.at("runs").at("X"), s.X, s.correlation);
  s.L = unpacked_lower(in.at("factor").vector(n * (n + 1) / 2), n);
  if (!(s.L.diagonal().array() > 0).all()) in.at("factor").fail("its diagonal is not positive");
  read_solution(in.at("solution"), n, q, s.gls);
  s.parameter_spread = read_spread(in.at("parameter_spread"), d, s.correlation);
  s.process_variance = in.at("process_variance").number();
  s.log_likelihood = in.at("log_likelihood").number(false);
  s.constant_variance = in.at("constant_variance").number(false);
  s.report = report_of(in.at("report"));
  if (!in.has("other")) return s;
  s.doubt = in.at("other").at("probability").number();
  s.other = std::make_shared<const ModelState>(state_of(in.at("other").at("model")));
  if (!(s.doubt > 0 && s.doubt < 1)) in.at("other").at("probability").fail("it is not between 0 and 1");
  if (s.other->X.cols() != s.X.cols()) in.at("other").fail("it has other variables");
  return s;
}

inline constexpr FileKind model_file{"drawpoint kriging model", 2, true, true};

inline Model model_of_text(const std::string& text, const std::string& file) {
  return opened(model_file, text, file, [](const JsonReader& in) { return Model(state_of(in)); });
}

}  // namespace detail

/// The model as text. Throws std::invalid_argument for a trend of user functions.
inline std::string to_text(const Model& model) {
  detail::refuse_functions_of_user(model.trend_function());
  return detail::enveloped(detail::model_file, detail::json_of(model.state()));
}

/// What to_text made. Throws std::runtime_error, with the place and the fault, for anything else.
inline Model from_text(const std::string& text) { return detail::model_of_text(text, "the text"); }

/// Writes the model atomically. Throws as to_text, and std::runtime_error when the disk refuses.
inline void save(const Model& model, const std::filesystem::path& path) {
  doe::write_file(path, to_text(model));
}

/// Throws std::runtime_error, with file, place and fault, when the file cannot be read or is not what save
/// wrote.
inline Model load(const std::filesystem::path& path) {
  return detail::model_of_text(detail::text_of_file(path), "\"" + path.string() + "\"");
}

}  // namespace drawpoint::kriging
