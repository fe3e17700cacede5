// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Co-Kriging models as JSON text: `save(model, "wear.json")`, `load_fidelities("wear.json")`.
///
/// As save.hpp, whose checks hold here too, with "format": "drawpoint co-kriging model" and "version": 1,
/// with categories 2. The
/// file holds each level's runs and parameters; what follows from them, factors included, is computed anew by
/// the same operations, so that a loaded model predicts the same bits. Size 25 bytes per number of the runs,
/// cost of reading n³/3 per level.

#include <Eigen/Core>
#include <cstddef>
#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/kriging/detail/saved_parts.hpp>
#include <drawpoint/kriging/fidelity_model.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

namespace detail {

inline constexpr FileKind cokriging_file{"drawpoint co-kriging model", 1};

inline Json json_of(const CokrigingLevel& level) {
  const ModelState& s = level.s;
  return {{"name", level.name},
          {"runs", {{"X", json_matrix(level.X)}, {"y", json_vector(s.observed)}}},
          {"input", {{"centre", json_vector(s.input.centre)}, {"factor", json_vector(s.input.factor)}}},
          {"response", {{"centre", s.y_centre}, {"scale", s.y_scale}, {"below", level.below_centre}}},
          {"correlation", json_of(s.correlation)},
          {"noise", json_of_noise(s)},
          {"trend", json_of(s.trend.terms)},
          {"rho", {{"terms", json_of(level.rho)}, {"given", json_vector(level.rho_given)}}},
          {"parameter_spread", json_matrix(s.parameter_spread)},
          {"process_variance", s.process_variance},
          {"report", json_of(s.report)}};
}

inline Json json_of(const FidelityModel& model) {
  Json levels = Json::array();
  for (const CokrigingLevel& level : model.levels()) {
    refuse_functions_of_user(level.s.trend);
    levels.push_back(json_of(level));
  }
  const FidelityComparison& c = model.report().comparison;
  return {{"levels", levels},
          {"comparison",
           {{"rmse", json_number(c.rmse)},
            {"rmse_alone", json_number(c.rmse_alone)},
            {"gain", json_number(c.gain)},
            {"standard_error", json_number(c.standard_error)}}},
          {"message", model.message()}};
}

inline void read_rho(const JsonReader& in, Eigen::Index d, CokrigingLevel& level) {
  if (!in.at("terms").json().empty()) level.rho = trend_terms(in.at("terms"), d);
  level.rho_given = in.at("given").vector(static_cast<Eigen::Index>(level.rho.size()));
}

inline CokrigingLevel level_of(const JsonReader& in) {
  CokrigingLevel level;
  ModelState& s = level.s;
  level.name = in.at("name").text();
  s.observed = in.at("runs").at("y").vector(-1);
  s.input.centre = in.at("input").at("centre").vector(-1);
  const Eigen::Index n = s.observed.size(), d = s.input.centre.size();
  if (n < 1 || d < 1) in.at("runs").fail("it holds no runs");
  s.input.factor = in.at("input").at("factor").vector(d);
  level.X = in.at("runs").at("X").matrix(n, d);
  s.y_centre = in.at("response").at("centre").number();
  s.y_scale = in.at("response").at("scale").number();
  level.below_centre = in.at("response").at("below").number();
  read_correlation(in.at("correlation"), d, s.correlation);
  if (s.correlation.structure != Structure::product)
    in.at("correlation").at("structure").fail("it is not \"product\"");
  refuse_other_levels(in.at("runs").at("X"), level.X, s.correlation);
  read_noise(in.at("noise"), n, s);
  s.trend.terms = trend_terms(in.at("trend"), d);
  read_rho(in.at("rho"), d, level);
  s.parameter_spread = read_spread(in.at("parameter_spread"), d, s.correlation);
  s.process_variance = in.at("process_variance").number();
  if (!(s.process_variance > 0)) in.at("process_variance").fail("it is not positive");
  if (!(s.y_scale > 0)) in.at("response").at("scale").fail("it is not positive");
  s.report = report_of(in.at("report"));
  return level;
}

inline CokrigingLevels levels_of(const JsonReader& in) {
  if (!in.json().is_array() || in.json().empty()) in.fail("it is no list of levels");
  CokrigingLevels levels;
  for (std::size_t t = 0; t < in.json().size(); ++t) {
    const JsonReader place = in.entry(t);
    CokrigingLevel level = level_of(place);
    if (t > 0 && level.X.cols() != levels[0].X.cols()) place.fail("it has other variables");
    if (t == 0 && !level.rho.empty()) place.fail("it has rho, but no level below");
    if (!build(levels, level)) place.fail("its correlation matrix is singular");
    levels.push_back(std::move(level));
  }
  return levels;
}

inline FidelityModel cokriging_of_text(const std::string& text, const std::string& file) {
  return opened(cokriging_file, text, file, [](const JsonReader& in) {
    CokrigingLevels levels = levels_of(in.at("levels"));
    const JsonReader c = in.at("comparison");
    FidelityReport report{{},
                          {c.at("rmse").number(false), c.at("rmse_alone").number(false),
                           c.at("gain").number(false), c.at("standard_error").number(false)},
                          in.at("message").text()};
    for (const CokrigingLevel& level : levels) report.levels.push_back(report_of(level));
    return FidelityModel(std::move(levels), std::move(report));
  });
}

}  // namespace detail

/// The model as text. Throws std::invalid_argument for a trend of user functions.
inline std::string to_text(const FidelityModel& model) {
  return detail::enveloped(detail::cokriging_file, detail::json_of(model));
}

/// What to_text made. Throws std::runtime_error, with the place and the fault, for anything else.
inline FidelityModel fidelities_from_text(const std::string& text) {
  return detail::cokriging_of_text(text, "the text");
}

/// Writes the model atomically. Throws as to_text, and std::runtime_error when the disk refuses.
inline void save(const FidelityModel& model, const std::filesystem::path& path) {
  doe::write_file(path, to_text(model));
}

/// Throws std::runtime_error, with file, place and fault, when the file cannot be read or is not what save
/// wrote.
inline FidelityModel load_fidelities(const std::filesystem::path& path) {
  return detail::cokriging_of_text(detail::text_of_file(path), "\"" + path.string() + "\"");
}

}  // namespace drawpoint::kriging
