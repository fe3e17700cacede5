// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/bucket.hpp>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <optional>

namespace drawpoint::engine::loading {

/// The bucket that a run had; none where its log does not say.
inline std::optional<BucketOptions> logged_bucket(const LoadingLog& log) {
  const auto width = log.numbers.find("bucket_width"), volume = log.numbers.find("bucket_heaped_volume");
  if (width == log.numbers.end() || volume == log.numbers.end()) return std::nullopt;
  return bucket_of(width->second, volume->second);
}

}  // namespace drawpoint::engine::loading
