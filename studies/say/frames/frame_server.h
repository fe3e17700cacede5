// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Gives a page to one browser on this machine, and takes the frames that it draws.
///
/// It answers on 127.0.0.1 alone, and only below a name of 128 random bits: GET of the page, POST of frame/N
/// in order, and of problem. Everything else is refused.

#include <drawpoint/studies/say/frames/frame_inbox.h>

#include <functional>
#include <memory>
#include <string>

namespace drawpoint::studies {

class FrameServer {
 public:
  /// page(nonce): HTML whose scripts carry the nonce. Throws std::runtime_error where no port is free.
  FrameServer(std::function<std::string(const std::string& nonce)> page, std::shared_ptr<FrameInbox> inbox);
  ~FrameServer();  ///< takes no more frames
  FrameServer(const FrameServer&) = delete;
  FrameServer& operator=(const FrameServer&) = delete;

  /// "http://127.0.0.1:PORT/NAME/"; who knows it can hand in frames.
  const std::string& address() const { return address_; }

 private:
  struct Listening;
  std::shared_ptr<FrameInbox> inbox_;
  std::string address_;
  std::unique_ptr<Listening> listening_;
};

}  // namespace drawpoint::studies
