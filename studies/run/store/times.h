// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Times as the store has them: UTC in ISO 8601, whole seconds. Their order is that of their texts.

#include <cstdio>
#include <ctime>
#include <string>

namespace drawpoint::studies {

inline std::string utc_text(std::time_t time) {
  std::tm utc = {};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

/// 0 for what is no such text.
inline std::time_t time_of(const std::string& text) {
  std::tm utc = {};
  if (std::sscanf(text.c_str(), "%d-%d-%dT%d:%d:%dZ", &utc.tm_year, &utc.tm_mon, &utc.tm_mday, &utc.tm_hour,
                  &utc.tm_min, &utc.tm_sec) != 6)
    return 0;
  utc.tm_year -= 1900;
  utc.tm_mon -= 1;
  return timegm(&utc);
}

}  // namespace drawpoint::studies
