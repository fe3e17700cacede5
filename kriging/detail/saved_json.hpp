// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How models stand in JSON files: numbers, places that errors name, and what surrounds a model (save.hpp
/// says what that is and what is checked).

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
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

#include <drawpoint/doe/detail/enumerators.hpp>
#include <drawpoint/kriging/detail/saved_checks.hpp>

namespace drawpoint::kriging::detail {

using Json = nlohmann::json;

inline Json json_number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

inline Json json_vector(const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); }

inline Json json_matrix(const Eigen::MatrixXd& A) {
  return {{"rows", A.rows()}, {"columns", A.cols()}, {"values", json_vector(A.reshaped())}};
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

  bool has(const char* key) const { return json_.is_object() && json_.contains(key); }

  JsonReader at(const char* key) const {
    if (!json_.is_object() || !json_.contains(key)) fail("\"" + std::string(key) + "\" is missing");
    return {json_[key], file_, place_.empty() ? key : place_ + "/" + key};
  }

  /// Entry k of a list.
  JsonReader entry(std::size_t k) const { return {json_[k], file_, place_ + "[" + std::to_string(k) + "]"}; }

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
    for (Eigen::Index i = 0; i < count; ++i) v[i] = entry(static_cast<std::size_t>(i)).number();
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

/// What a kind of file is called, and its version; of models with categories it is one higher, so that a
/// reader that knows none does not take them for numbers, of isotropic and additive correlations two, and of two
/// explanations three.
struct FileKind {
  const char* format;
  int version;
  bool structures = false;    ///< whether there are such
  bool explanations = false;  ///< whether there may be two of them

  int newest() const { return version + (explanations ? 3 : structures ? 2 : 1); }
};

inline bool has_categories(const Json& model) {
  const auto has = [](const Json& part) {
    return part.contains("correlation") && part["correlation"].contains("categories");
  };
  if (!model.contains("levels")) return has(model);
  return model["levels"].is_array() && !model["levels"].empty() && has(model["levels"][0]);
}

/// What the version of a model is beyond that of its kind.
inline int added_version(const Json& model) {
  if (model.contains("other")) return 3;
  if (model.contains("correlation") && model["correlation"].contains("structure")) return 2;
  return has_categories(model) ? 1 : 0;
}

/// The text of a file of this kind.
inline std::string enveloped(const FileKind& kind, const Json& json) {
  return Json{{"format", kind.format},
              {"version", kind.version + added_version(json)},
              {"checksum", checksum(json.dump())},
              {"model", json}}
             .dump() +
         "\n";
}

/// Calls read(reader of "model") once all that surrounds it is right. `file` is how messages name the text.
template <class Read>
auto opened(const FileKind& kind, const std::string& text, const std::string& file, const Read& read) {
  const Json json = Json::parse(text, nullptr, false);
  const JsonReader in(json, file, "");
  if (json.is_discarded()) in.fail("it is no JSON, or not all of it");
  if (in.at("format").text() != kind.format)
    in.at("format").fail("it is not \"" + std::string(kind.format) + "\"");
  const int version = in.at("version").integer();
  const auto or_with = [&](int more, const char* what) {
    return ", or " + std::to_string(kind.version + more) + " with " + what;
  };
  if (version < kind.version || version > kind.newest())
    in.at("version").fail("it is " + std::to_string(version) + "; allowed is " +
                          std::to_string(kind.version) + or_with(1, "categories") +
                          (kind.structures ? or_with(2, "a structure") : "") +
                          (kind.explanations ? or_with(3, "two explanations") : ""));
  if (in.at("checksum").text() != checksum(in.at("model").json().dump()))
    in.at("checksum").fail("it is not that of the model");
  if (version != kind.version + added_version(in.at("model").json()))
    in.at("version").fail("it is not that of the model");
  if (json.dump() + "\n" != text) in.fail("it is not as it was written");
  return read(in.at("model"));
}

inline std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad())
    throw std::runtime_error("kriging::load: cannot read \"" + path.string() +
                             "\"; check that it exists and is readable");
  return text;
}

}  // namespace drawpoint::kriging::detail
