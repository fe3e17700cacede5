// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/frames/frame_inbox.h>

#include <exception>
#include <stdexcept>
#include <utility>

namespace drawpoint::studies {

FrameInbox::FrameInbox(std::size_t total, const FrameSize& size, Keep keep)
    : total_(total), size_(size), keep_(std::move(keep)) {}

std::string FrameInbox::objection(std::size_t number, std::string_view png) const {
  if (closed_ || !problem_.empty()) return "no more frames are taken";
  if (number != count_ + 1 || number > total_)
    return "frame " + std::to_string(number) + " of " + std::to_string(total_) + " came after frame " +
           std::to_string(count_);
  const std::string complaint = png_complaint(png, size_);
  return complaint.empty() ? "" : "frame " + std::to_string(number) + " is not whole: " + complaint;
}

std::string FrameInbox::kept(std::size_t number, std::string_view png) {
  try {
    keep_(number, png);
    return "";
  } catch (const std::exception& e) {
    return e.what();
  }
}

std::string FrameInbox::take(std::size_t number, std::string_view png) {
  const std::lock_guard lock(mutex_);
  std::string complaint = objection(number, png);
  if (complaint.empty()) complaint = kept(number, png);
  if (complaint.empty())
    ++count_;
  else if (!closed_ && problem_.empty())
    problem_ = complaint;
  news_.notify_all();
  return complaint;
}

void FrameInbox::give_up(const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (problem_.empty()) problem_ = "the browser could not draw the scene: " + why;
  news_.notify_all();
}

void FrameInbox::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
}

std::size_t FrameInbox::wait(std::size_t before, std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, patience, [&] { return count_ > before || !problem_.empty(); });
  if (!problem_.empty()) throw std::runtime_error("replay: " + problem_);
  return count_;
}

}  // namespace drawpoint::studies
