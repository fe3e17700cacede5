// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Kriging models as JSON text: `save(model, "wear.json")`, `load("wear.json")`.
///
/// The file holds all that makes the model, the factor of R included, so that a loaded model predicts the
/// same bits: {"checksum", "format": "drawpoint kriging model", "model": {...}, "version": 2}, on one line.
/// Numbers are the shortest text that reads back as the same double; ±∞ and NaN, which JSON lacks, are the
/// texts "inf", "-inf" and "nan", where a field may be that. Matrices are {"columns", "rows", "values"} by
/// columns; of L only the lower triangle. Size 10 n² bytes, cost O(n²). Reading checks format and version,
/// that the text is exactly what this writer makes (so no byte may differ), the checksum (64-bit FNV-1a of
/// the text of "model": against accidents, not against intent), every size, that numbers are finite and that
/// L's diagonal is positive. A model with a trend of user functions cannot be saved. This is the only header
/// of the module that needs nlohmann-json (Debian: nlohmann-json3-dev).

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/doe/detail/enumerators.hpp>
#include <drawpoint/kriging/detail/saved_checks.hpp>
#include <drawpoint/kriging/model.hpp>

namespace drawpoint::kriging {

namespace detail {

using Json = nlohmann::json;

inline constexpr const char* model_format = "drawpoint kriging model";
inline constexpr int model_version = 2;

inline Json json_number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

inline Json json_vector(const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); }

inline Json json_matrix(const Eigen::MatrixXd& A) {
  return {{"rows", A.rows()}, {"columns", A.cols()}, {"values", json_vector(A.reshaped())}};
}

inline Json json_of(const FitReport& r) {
  return {{"status", to_string(r.status)},  {"message", r.message},
          {"starts_tried", r.starts_tried}, {"starts_agreed", r.starts_agreed},
          {"evaluations", r.evaluations},   {"condition", json_number(r.condition)}};
}

inline Json json_of(const ModelState& s) {
  Json terms = Json::array();
  for (const TrendTerm& term : s.trend.terms) terms.push_back({term.a, term.b});
  return {{"input", {{"centre", json_vector(s.input.centre)}, {"factor", json_vector(s.input.factor)}}},
          {"response", {{"centre", s.y_centre}, {"scale", s.y_scale}, {"observed", json_vector(s.observed)}}},
          {"correlation",
           {{"family", to_string(s.correlation.family)},
            {"theta", json_vector(s.correlation.theta)},
            {"exponent", json_vector(s.correlation.exponent)}}},
          {"noise",
           {{"nugget", s.nugget},
            {"weights", json_vector(s.noise)},
            {"known", s.known_noise},
            {"unit", s.noise_unit}}},
          {"trend", terms},
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
}

/// A value of the file and its place, such as "model/runs/X"; errors name both.
class JsonReader {
 public:
  JsonReader(const Json& json, std::string file, std::string place)
      : json_(json), file_(std::move(file)), place_(std::move(place)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("kriging::load: " + file_ + (place_.empty() ? "" : ": " + place_) + ": " + what +
                             "; the file is damaged or of another kind: save the model again");
  }

  JsonReader at(const char* key) const {
    if (!json_.is_object() || !json_.contains(key)) fail("\"" + std::string(key) + "\" is missing");
    return {json_[key], file_, place_.empty() ? key : place_ + "/" + key};
  }

  double number(bool finite = true) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double value = 0;
    if (json_.is_number())
      value = json_.get<double>();
    else if (json_ == "inf" || json_ == "-inf")
      value = json_ == "inf" ? infinity : -infinity;
    else if (json_ == "nan")
      value = std::numeric_limits<double>::quiet_NaN();
    else
      fail("it is no number");
    if (finite && !std::isfinite(value)) fail("it is not finite");
    return value;
  }

  int integer() const {
    if (!json_.is_number_integer()) fail("it is no whole number");
    const auto value = json_.get<std::int64_t>();
    if (value < -1 || value > std::numeric_limits<int>::max()) fail("it is out of range");
    return static_cast<int>(value);
  }

  std::string text() const {
    if (!json_.is_string()) fail("it is no text");
    return json_.get<std::string>();
  }

  /// `size` numbers; any number of them when it is negative.
  Eigen::VectorXd vector(Eigen::Index size) const {
    if (!json_.is_array()) fail("it is no list");
    const auto count = static_cast<Eigen::Index>(json_.size());
    if (size >= 0 && count != size)
      fail("it has " + std::to_string(count) + " entries; allowed is " + std::to_string(size));
    Eigen::VectorXd v(count);
    for (Eigen::Index i = 0; i < count; ++i)
      v[i] = JsonReader(json_[static_cast<std::size_t>(i)], file_, place_ + "[" + std::to_string(i) + "]")
                 .number();
    return v;
  }

  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) const {
    if (at("rows").integer() != rows || at("columns").integer() != columns)
      fail("it is not " + std::to_string(rows) + " x " + std::to_string(columns));
    return at("values").vector(rows * columns).reshaped(rows, columns);
  }

  /// The enumerator whose to_string is this text.
  template <class Enum>
  Enum enumerator() const {
    const std::string name = text();
    if (const std::optional<Enum> found = doe::detail::enumerator_of<Enum>(name)) return *found;
    fail("\"" + name + "\" is unknown");
  }

  const Json& json() const { return json_; }

 private:
  const Json& json_;
  std::string file_, place_;
};

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

inline void read_solution(const JsonReader& in, Eigen::Index n, Eigen::Index q, LeastSquares& gls) {
  gls.beta = in.at("beta").vector(q);
  gls.alpha = in.at("alpha").vector(n);
  gls.B = in.at("B").matrix(n, q);
  gls.T = in.at("T").matrix(q, q);
  gls.sum_of_squares = in.at("sum_of_squares").number();
  if (!(gls.T.diagonal().array() != 0).all()) in.at("T").fail("its diagonal holds a 0");
}

inline void read_correlation(const JsonReader& in, Eigen::Index d, CorrelationFunction& f) {
  f.family = in.at("family").enumerator<Correlation>();
  f.theta = in.at("theta").vector(d);
  f.exponent = in.at("exponent").vector(-1);
  if (f.exponent.size() > 0 || f.family == Correlation::power_exponential)
    f.exponent = in.at("exponent").vector(d);
}

inline void read_noise(const JsonReader& in, Eigen::Index n, ModelState& s) {
  s.nugget = in.at("nugget").number();
  s.known_noise = in.at("known").number();
  s.noise_unit = in.at("unit").number();
  s.noise = in.at("weights").vector(-1);
  if (s.noise.size() > 0) s.noise = in.at("weights").vector(n);
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
  s.L = unpacked_lower(in.at("factor").vector(n * (n + 1) / 2), n);
  if (!(s.L.diagonal().array() > 0).all()) in.at("factor").fail("its diagonal is not positive");
  read_solution(in.at("solution"), n, q, s.gls);
  const JsonReader spread = in.at("parameter_spread");
  const int parameters = spread.at("rows").integer(), directions = spread.at("columns").integer();
  if (parameters != 0 && parameters != d + 1 && parameters != 2 * d + 1)
    spread.fail("it has " + std::to_string(parameters) + " rows");
  if (directions < 0 || directions > parameters) spread.fail("it has more columns than rows");
  s.parameter_spread = spread.matrix(parameters, directions);
  s.process_variance = in.at("process_variance").number();
  s.log_likelihood = in.at("log_likelihood").number(false);
  s.constant_variance = in.at("constant_variance").number(false);
  s.report = report_of(in.at("report"));
  return s;
}

/// `file` is how messages name the text.
inline Model model_of_text(const std::string& text, const std::string& file) {
  const Json json = Json::parse(text, nullptr, false);
  const JsonReader in(json, file, "");
  if (json.is_discarded()) in.fail("it is no JSON, or not all of it");
  if (in.at("format").text() != model_format)
    in.at("format").fail("it is not \"" + std::string(model_format) + "\"");
  if (const int version = in.at("version").integer(); version != model_version)
    in.at("version").fail("it is " + std::to_string(version) + "; allowed is " +
                          std::to_string(model_version));
  if (in.at("checksum").text() != checksum(in.at("model").json().dump()))
    in.at("checksum").fail("it is not that of the model");
  if (json.dump() + "\n" != text) in.fail("it is not as it was written");
  return Model(state_of(in.at("model")));
}

}  // namespace detail

/// The model as text. Throws std::invalid_argument for a trend of user functions.
inline std::string to_text(const Model& model) {
  if (model.trend_function().by_user())
    throw std::invalid_argument(
        "kriging::save: the trend is a function of the user, which no file can hold; allowed are polynomial "
        "trends; "
        "save the runs and fit again");
  const detail::Json json = detail::json_of(model.state());
  return detail::Json{{"format", detail::model_format},
                      {"version", detail::model_version},
                      {"checksum", detail::checksum(json.dump())},
                      {"model", json}}
             .dump() +
         "\n";
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
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad())
    throw std::runtime_error("kriging::load: cannot read \"" + path.string() +
                             "\"; check that it exists and is readable");
  return detail::model_of_text(text, "\"" + path.string() + "\"");
}

}  // namespace drawpoint::kriging
