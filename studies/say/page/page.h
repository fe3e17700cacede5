// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Puts texts into the page. Only two kinds go in: the title, escaped as HTML, and the data, JSON in a script
/// element in which every "<" is written as an escape, so that no text can end the element.

#include <string>

#include <nlohmann/json.hpp>

namespace drawpoint::studies::detail {

std::string escaped_html(const std::string& text);

/// JSON text without "<"; bytes that are not UTF-8 become U+FFFD, numbers that are not finite become null.
std::string embedded_json(const nlohmann::json& data);

/// The whole file.
std::string page(const std::string& title, const nlohmann::json& data);

/// The live page of a study, which asks for its data. Its scripts carry the nonce (letters and digits) that
/// the policy of its answer names.
std::string live_page(const std::string& title, const std::string& nonce);

/// The page that draws a scene as pictures and sends them to where it comes from: data has `scene` (a panel),
/// `times`, `width`, `height` and `camera`. A script as above.
std::string pictures_page(const std::string& title, const nlohmann::json& data, const std::string& nonce);

}  // namespace drawpoint::studies::detail
