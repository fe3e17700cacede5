// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The files of say/page/web and the two libraries, as they were when the library was built.

#include <string_view>

namespace drawpoint::studies::detail {

std::string_view page_asset();    ///< page.html with places for the texts below
std::string_view style_asset();   ///< style.css
std::string_view plotly_asset();  ///< plotly.js, minified
std::string_view app_asset();     ///< web/main.js with what it imports and three.js, bundled

std::string_view live_page_asset();  ///< live.html, likewise
std::string_view live_asset();       ///< web/live.js with what it imports, bundled

std::string_view pictures_page_asset();  ///< pictures.html, likewise
std::string_view pictures_asset();       ///< web/pictures.js with what it imports and three.js, bundled

}  // namespace drawpoint::studies::detail
