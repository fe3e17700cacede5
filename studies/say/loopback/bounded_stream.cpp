// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/loopback/bounded_stream.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace drawpoint::studies::loopback {

BoundedStream::BoundedStream(int socket, const StreamBounds& bounds)
    : socket_(socket),
      left_(bounds.question),
      asked_by_(Clock::now() + bounds.time_to_ask),
      answered_by_(Clock::now() + bounds.time_to_answer) {}

bool BoundedStream::ready(short event, Clock::time_point deadline) const {
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    if (left.count() <= 0) return false;
    pollfd one = {socket_, event, 0};
    const int found = ::poll(&one, 1, static_cast<int>(left.count()));
    if (found < 0 && errno == EINTR) continue;
    return found > 0;
  }
}

bool BoundedStream::is_readable() const { return next_ < end_ || ready(POLLIN, asked_by_); }
bool BoundedStream::is_writable() const { return ready(POLLOUT, answered_by_); }

bool BoundedStream::fill() {
  if (left_ == 0 || !ready(POLLIN, asked_by_)) return false;
  const ssize_t count = ::recv(socket_, buffer_.data(), std::min(buffer_.size(), left_), 0);
  if (count <= 0) return false;
  left_ -= static_cast<std::size_t>(count);
  next_ = 0;
  end_ = static_cast<std::size_t>(count);
  return true;
}

ssize_t BoundedStream::read(char* to, std::size_t size) {
  if (next_ == end_ && !fill()) return -1;
  const std::size_t count = std::min(size, end_ - next_);
  std::memcpy(to, buffer_.data() + next_, count);
  next_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t BoundedStream::write(const char* from, std::size_t size) {
  if (!ready(POLLOUT, answered_by_)) return -1;
  return ::send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
}

}  // namespace drawpoint::studies::loopback
