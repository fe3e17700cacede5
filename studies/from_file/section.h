// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::studies {

/// An object of the file and its place, such as "variables[2]"; errors name both.
class Section {
 public:
  Section(const nlohmann::json& object, std::filesystem::path file, std::string place)
      : object_(object), file_(std::move(file)), place_(std::move(place)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(file_.string() + ": " + (place_.empty() ? "" : place_ + ": ") + what);
  }

  void allow_only(std::initializer_list<const char*> keys) const {
    if (!object_.is_object()) fail("it is " + object_.dump() + "; give an object, {...}");
    std::string names;
    for (const char* key : keys) names += (names.empty() ? "" : ", ") + std::string(key);
    for (const auto& [key, value] : object_.items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        fail("there is no \"" + key + "\"; the keys are " + names);
  }

  bool has(const char* key) const { return object_.contains(key); }

  std::string text(const char* key) const {
    const nlohmann::json& value = needed(key, "text");
    if (!value.is_string()) wrong(key, value, "text in quotes");
    return value.get<std::string>();
  }

  std::string text(const char* key, const std::string& otherwise) const {
    return has(key) ? text(key) : otherwise;
  }

  double number(const char* key) const {
    const nlohmann::json& value = needed(key, "a number");
    if (!value.is_number()) wrong(key, value, "a number");
    return value.get<double>();
  }

  double number(const char* key, double otherwise) const { return has(key) ? number(key) : otherwise; }

  int integer(const char* key, int otherwise, int least) const {
    if (!has(key)) return otherwise;
    const nlohmann::json& value = object_[key];
    const int most = 1'000'000;
    if (!value.is_number_integer() || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most)
      wrong(key, value, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return value.get<int>();
  }

  bool truth(const char* key, bool otherwise) const {
    if (!has(key)) return otherwise;
    const nlohmann::json& value = object_[key];
    if (!value.is_boolean()) wrong(key, value, "true or false");
    return value.get<bool>();
  }

  std::vector<std::string> texts(const char* key) const {
    std::vector<std::string> all = texts_or_none(key);
    if (all.empty()) wrong(key, object_[key], "a list of texts, [\"...\", ...]");
    return all;
  }

  std::vector<std::string> texts_or_none(const char* key) const {
    const nlohmann::json& list = needed(key, "a list of texts");
    std::vector<std::string> all;
    if (!list.is_array()) wrong(key, list, "a list of texts, [\"...\", ...]");
    for (const nlohmann::json& entry : list) {
      if (!entry.is_string()) wrong(key, entry, "texts alone in this list");
      all.push_back(entry.get<std::string>());
    }
    return all;
  }

  std::vector<double> numbers(const char* key) const {
    const nlohmann::json& list = needed(key, "a list of numbers");
    std::vector<double> all;
    if (!list.is_array()) wrong(key, list, "a list of numbers, [1, ...]");
    for (const nlohmann::json& entry : list) {
      if (!entry.is_number()) wrong(key, entry, "numbers alone in this list");
      all.push_back(entry.get<double>());
    }
    return all;
  }

  std::vector<Section> sections(const char* key) const {
    const nlohmann::json& list = needed(key, "a list of objects");
    if (!list.is_array() || list.empty()) wrong(key, list, "a list of objects, [{...}, ...]");
    std::vector<Section> all;
    for (std::size_t i = 0; i < list.size(); ++i)
      all.emplace_back(list[i], file_, std::string(key) + "[" + std::to_string(i) + "]");
    return all;
  }

  Section section(const char* key) const { return {object_.at(key), file_, key}; }

  /// The enumerator of this name among `all`.
  template <class Enum>
  Enum one_of(const char* key, std::initializer_list<Enum> all) const {
    const std::string name = text(key);
    std::string names;
    for (const Enum value : all) {
      if (to_string(value) == name) return value;
      names += (names.empty() ? "" : ", ") + std::string(to_string(value));
    }
    wrong(key, object_[key], "one of " + names);
  }

 private:
  const nlohmann::json& needed(const char* key, const std::string& what) const {
    if (!object_.contains(key)) fail('"' + std::string(key) + "\" is missing; give " + what);
    return object_[key];
  }

  [[noreturn]] void wrong(const char* key, const nlohmann::json& value, const std::string& wanted) const {
    fail("\"" + std::string(key) + "\" is " + value.dump() + "; give " + wanted);
  }

  const nlohmann::json& object_;
  std::filesystem::path file_;
  std::string place_;
};

}  // namespace drawpoint::studies
