// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A connection with bounds on what is asked through it, in bytes and in time, and on the time that its answer
/// takes: the library bounds neither the length of a line nor the time of a question that drips.

#include <httplib.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

namespace drawpoint::studies::loopback {

struct StreamBounds {
  std::size_t question;                 ///< head and body together [byte]
  std::chrono::seconds time_to_ask;     ///< from the beginning, for all of the question
  std::chrono::seconds time_to_answer;  ///< from the beginning, for question and answer
};

class BoundedStream : public httplib::Stream {
 public:
  BoundedStream(int socket, const StreamBounds& bounds);

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;  ///< -1 beyond the bounds
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  int socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool ready(short event, Clock::time_point deadline) const;
  bool fill();

  int socket_;
  std::size_t left_;  // of the bytes that may be asked
  Clock::time_point asked_by_, answered_by_;
  std::array<char, 4096> buffer_;
  std::size_t next_ = 0, end_ = 0;  // of the buffer
};

}  // namespace drawpoint::studies::loopback
