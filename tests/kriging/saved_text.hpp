// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Saved models as text: what is refused, and what an honest but wrong writer makes.

#include <drawpoint/kriging/save.hpp>

#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::support {

/// Why `read(text)` refuses; "accepted" where it does not.
template <class Read>
std::string refusal_of(const Read& read, const std::string& text) {
  try {
    read(text);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "accepted";
}

/// The text of a model, changed and then given the checksum that fits.
inline std::string with_checksum(const std::string& text,
                                 const std::function<void(nlohmann::json&)>& change) {
  nlohmann::json file = nlohmann::json::parse(text);
  change(file);
  file["checksum"] = kriging::detail::checksum(file["model"].dump());
  return file.dump() + "\n";
}

}  // namespace drawpoint::support
