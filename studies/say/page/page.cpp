// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/say/page/assets.h>
#include <drawpoint/studies/say/page/page.h>

#include <map>
#include <string_view>

namespace drawpoint::studies::detail {

namespace {

/// The template with each @DRAWPOINT_NAME@ replaced; what is put in is not searched again.
std::string filled(std::string_view text, const std::map<std::string_view, std::string_view>& values) {
  constexpr std::string_view mark = "@DRAWPOINT_";
  std::string result;
  for (std::size_t at = 0;;) {
    const std::size_t begin = text.find(mark, at);
    result += text.substr(at, begin - at);
    if (begin == std::string_view::npos) return result;
    const std::size_t name = begin + mark.size(), end = text.find('@', name);
    result += values.at(text.substr(name, end - name));
    at = end + 1;
  }
}

}  // namespace

std::string escaped_html(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string embedded_json(const nlohmann::json& data) {
  const std::string text = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  }
  return result;
}

std::string page(const std::string& title, const nlohmann::json& data) {
  const std::string head = escaped_html(title), json = embedded_json(data);
  return filled(page_asset(), {{"TITLE", head},
                               {"STYLE", style_asset()},
                               {"DATA", json},
                               {"PLOTLY", plotly_asset()},
                               {"APP", app_asset()}});
}

std::string live_page(const std::string& title, const std::string& nonce) {
  const std::string head = escaped_html(title);
  return filled(live_page_asset(), {{"TITLE", head},
                                    {"NONCE", nonce},
                                    {"STYLE", style_asset()},
                                    {"PLOTLY", plotly_asset()},
                                    {"APP", live_asset()}});
}

std::string pictures_page(const std::string& title, const nlohmann::json& data, const std::string& nonce) {
  const std::string head = escaped_html(title), json = embedded_json(data);
  return filled(pictures_page_asset(),
                {{"TITLE", head}, {"NONCE", nonce}, {"DATA", json}, {"APP", pictures_asset()}});
}

}  // namespace drawpoint::studies::detail
