// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The parts that saved models of one level (save.hpp) and of several (save_fidelities.hpp), and of many runs
/// (save_nearest.hpp) share.

#include <Eigen/Core>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <drawpoint/kriging/detail/model_state.hpp>
#include <drawpoint/kriging/detail/parameter_places.hpp>
#include <drawpoint/kriging/detail/saved_json.hpp>

namespace drawpoint::kriging::detail {

inline Json json_of(const FitReport& r) {
  return {{"status", to_string(r.status)},  {"message", r.message},
          {"starts_tried", r.starts_tried}, {"starts_agreed", r.starts_agreed},
          {"evaluations", r.evaluations},   {"condition", json_number(r.condition)}};
}

inline Json json_of(const std::vector<TrendTerm>& terms) {
  Json json = Json::array();
  for (const TrendTerm& term : terms) json.push_back({term.a, term.b});
  return json;
}

inline Json json_of(const CorrelationFunction& f) {
  Json json{{"family", to_string(f.family)},
            {"theta", json_vector(f.theta)},
            {"exponent", json_vector(f.exponent)}};
  if (!f.levels.empty()) json["categories"] = f.levels;
  if (f.structure != Structure::product) json["structure"] = to_string(f.structure);
  if (f.structure == Structure::additive) json["weights"] = json_vector(f.weight);
  return json;
}

inline Json json_of_noise(const ModelState& s) {
  return {{"nugget", s.nugget},
          {"weights", json_vector(s.noise)},
          {"known", s.known_noise},
          {"unit", s.noise_unit}};
}

inline std::vector<TrendTerm> trend_terms(const JsonReader& in, Eigen::Index d) {
  if (!in.json().is_array() || in.json().empty()) in.fail("it is no list of terms");
  std::vector<TrendTerm> terms;
  for (const Json& pair : in.json()) {
    if (!pair.is_array() || pair.size() != 2) in.fail("a term is no pair");
    const auto index = [&](std::size_t k) {
      const int a = JsonReader(pair[k], "a term of the trend", "").integer();
      if (a >= d) in.fail("a term names input " + std::to_string(a) + " of " + std::to_string(d));
      return a;
    };
    terms.push_back({index(0), index(1)});
    if (terms.back().a < 0 && terms.back().b >= 0) in.fail("a term has its first input missing");
  }
  return terms;
}

inline FitReport report_of(const JsonReader& in) {
  return {in.at("status").enumerator<Status>(), in.at("message").text(),
          in.at("starts_tried").integer(),      in.at("starts_agreed").integer(),
          in.at("evaluations").integer(),       in.at("condition").number(false)};
}

/// The level counts of d inputs (0: a number), at least one of them a category.
inline std::vector<int> read_levels(const JsonReader& in, Eigen::Index d) {
  std::vector<int> levels;
  if (!in.json().is_array()) in.fail("it is no list");
  for (std::size_t k = 0; k < in.json().size(); ++k) levels.push_back(in.entry(k).integer());
  try {
    check_level_counts("X", levels, d);
  } catch (const std::invalid_argument&) {
    in.fail("it does not fit " + std::to_string(d) + " inputs");
  }
  if (categories_of(levels).empty()) in.fail("it names no category");
  return levels;
}

inline void read_correlation(const JsonReader& in, Eigen::Index d, CorrelationFunction& f) {
  f.family = in.at("family").enumerator<Correlation>();
  f.theta = in.at("theta").vector(d);
  f.exponent = in.at("exponent").vector(-1);
  if (f.exponent.size() > 0 || f.family == Correlation::power_exponential)
    f.exponent = in.at("exponent").vector(d);
  if (in.json().contains("categories")) f.levels = read_levels(in.at("categories"), d);
  if (!in.json().contains("structure")) return;
  f.structure = in.at("structure").enumerator<Structure>();
  if (f.structure != Structure::additive) return;
  f.weight = in.at("weights").vector(d);
  if (!(f.weight.array() >= 0).all() || !(std::abs(f.weight.sum() - 1.0) <= 1e-12 * static_cast<double>(d)))
    in.at("weights").fail("they are not shares of 1");
}

/// X: n x d, in which categories stand by the indices of their levels.
inline void refuse_other_levels(const JsonReader& in, const Eigen::MatrixXd& X,
                                const CorrelationFunction& f) {
  try {
    require_levels("X", X, f.levels);
  } catch (const std::invalid_argument&) {
    in.fail("it holds what is no level of a category");
  }
}

inline void read_noise(const JsonReader& in, Eigen::Index n, ModelState& s) {
  s.nugget = in.at("nugget").number();
  s.known_noise = in.at("known").number();
  s.noise_unit = in.at("unit").number();
  s.noise = in.at("weights").vector(-1);
  if (s.noise.size() > 0) s.noise = in.at("weights").vector(n);
}

/// S of d inputs.
inline Eigen::MatrixXd read_spread(const JsonReader& in, Eigen::Index d, const CorrelationFunction& f) {
  const int parameters = in.at("rows").integer(), directions = in.at("columns").integer();
  if (parameters != 0 && parameters != parameter_places(f, d, false).count() &&
      parameters != parameter_places(f, d, true).count())
    in.fail("it has " + std::to_string(parameters) + " rows");
  if (directions < 0 || directions > parameters) in.fail("it has more columns than rows");
  return in.matrix(parameters, directions);
}

inline void refuse_functions_of_user(const TrendFunction& trend) {
  if (trend.by_user())
    throw std::invalid_argument(
        "kriging::save: the trend is a function of the user, which no file can hold; allowed are polynomial "
        "trends; save the runs and fit again");
}

}  // namespace drawpoint::kriging::detail
