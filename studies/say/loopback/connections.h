// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A bound on all connections of a server together.
///
/// A connection waits until a thread serves it. Where more than `most` wait or are served, the one that has
/// been served longest is ended, so that clients that drip their questions, or do not take their answers,
/// cannot keep a new one away: who asks at once is the youngest, and is answered in milliseconds.

#include <cstddef>
#include <list>
#include <mutex>

namespace drawpoint::studies::loopback {

class Connections {
 public:
  explicit Connections(std::size_t most) : most_(most) {}

  void accepted();         ///< one more waits
  void begin(int socket);  ///< one that waited is served
  void end(int socket);    ///< before its socket is closed

 private:
  void make_room();

  std::mutex mutex_;
  std::size_t most_, waiting_ = 0;
  std::list<int> served_;  // by age, without those that were ended
};

}  // namespace drawpoint::studies::loopback
