// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Frames as they come from the page, in order, each checked and kept before the next is taken. Several
/// threads may hand in; one waits.

#include <drawpoint/studies/say/frames/png.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace drawpoint::studies {

class FrameInbox {
 public:
  /// Writes the bytes of frame `number` where they belong; what it throws ends the work.
  using Keep = std::function<void(std::size_t number, std::string_view png)>;

  FrameInbox(std::size_t total, const FrameSize& size, Keep keep);

  /// What is wrong with it, or "". The first thing wrong ends the work.
  std::string take(std::size_t number, std::string_view png);
  /// The page could not draw.
  void give_up(const std::string& why);
  /// No more is taken.
  void close();

  /// Frames kept, after more than `before` are or this time has passed. Throws std::runtime_error with what
  /// has ended the work.
  std::size_t wait(std::size_t before, std::chrono::milliseconds patience);

 private:
  std::string objection(std::size_t number, std::string_view png) const;
  std::string kept(std::size_t number, std::string_view png);

  const std::size_t total_;
  const FrameSize size_;
  const Keep keep_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::size_t count_ = 0;
  bool closed_ = false;
  std::string problem_;
};

}  // namespace drawpoint::studies
