// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/identity.h>
#include <drawpoint/studies/run/store/joined.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

namespace drawpoint::studies {
namespace {

using nlohmann::json;

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// The shortest decimal text that reads back as the same number.
std::string text_of(double value) { return std::isnan(value) ? "none" : json(value).dump(); }

std::string bound_text(double value) { return std::isfinite(value) ? json(value).dump() : "none"; }

std::string name_of(doe::Goal goal) { return std::string(doe::to_string(goal)); }

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

std::string changed(const std::string& subject, const std::string& there, const std::string& here) {
  return subject + " " + there + " there, " + here + " here";
}

std::string between(const doe::Variable& there, const doe::Variable& here) {
  const std::string subject = "variable " + quoted(here.name) + ": ";
  if (there.unit != here.unit) return changed(subject + "unit", quoted(there.unit), quoted(here.unit));
  if (there.lower != here.lower)
    return changed(subject + "lower bound", text_of(there.lower), text_of(here.lower));
  if (there.upper != here.upper)
    return changed(subject + "upper bound", text_of(there.upper), text_of(here.upper));
  if (there.kind != here.kind)
    return changed(subject + "kind", std::string(to_string(there.kind)), std::string(to_string(here.kind)));
  if (there.levels != here.levels)
    return changed(subject + "levels", json(there.levels).dump(), json(here.levels).dump());
  return "";
}

std::string between(const doe::Response& there, const doe::Response& here) {
  const std::string subject = "response " + quoted(here.name) + ": ";
  if (there.unit != here.unit) return changed(subject + "unit", quoted(there.unit), quoted(here.unit));
  if (there.goal != here.goal) return changed(subject + "goal", name_of(there.goal), name_of(here.goal));
  if (!same(there.limit, here.limit))
    return changed(subject + "limit", text_of(there.limit), text_of(here.limit));
  if (there.lower != here.lower)
    return changed(subject + "least value", bound_text(there.lower), bound_text(here.lower));
  if (there.upper != here.upper)
    return changed(subject + "largest value", bound_text(there.upper), bound_text(here.upper));
  if (there.standard_error != here.standard_error)
    return changed(subject + "standard error", quoted(there.standard_error), quoted(here.standard_error));
  if (there.standard_error_freedom != here.standard_error_freedom)
    return changed(subject + "degrees of freedom of the standard error",
                   text_of(there.standard_error_freedom), text_of(here.standard_error_freedom));
  return "";
}

template <class Item>
std::string names_of(const std::vector<Item>& items) {
  return joined(items, &Item::name);
}

template <class Item>
std::string between_lists(const std::vector<Item>& there, const std::vector<Item>& here,
                          const std::string& what) {
  if (names_of(there) != names_of(here))
    return changed("the " + what + " are", names_of(there), names_of(here));
  for (std::size_t i = 0; i < here.size(); ++i) {
    const std::string text = between(there[i], here[i]);
    if (!text.empty()) return text;
  }
  return "";
}

}  // namespace

std::string difference(const doe::Problem& there, const doe::Problem& here) {
  const std::string text = between_lists(there.variables, here.variables, "variables");
  return text.empty() ? between_lists(there.responses, here.responses, "responses") : text;
}

std::optional<doe::Problem> before_later_responses(const doe::Problem& there, const doe::Problem& here) {
  if (there.responses.size() >= here.responses.size()) return {};
  const auto later = here.responses.begin() + static_cast<std::ptrdiff_t>(there.responses.size());
  if (!std::all_of(later, here.responses.end(), [](const auto& r) { return r.goal == doe::Goal::record; }))
    return {};
  doe::Problem before = here;
  before.responses.resize(there.responses.size());
  for (doe::Response& response : before.responses)
    if (std::any_of(later, here.responses.end(),
                    [&](const auto& r) { return r.name == response.standard_error; }))
      response.forget_standard_error();
  if (!difference(there, before).empty()) return {};
  return before;
}

}  // namespace drawpoint::studies
