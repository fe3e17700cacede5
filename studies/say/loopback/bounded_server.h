// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A server of the library that believes no length and no patience of its clients.
///
/// It gives every answer whole: a request for ranges of it is read as one without, which HTTP allows, for the
/// library would read beyond the end of an answer. A connection is for one question, whose bytes and time are
/// bounded (bounded_stream.h), and so are all connections together (connections.h).

#include <drawpoint/studies/say/loopback/connections.h>
#include <httplib.h>

#include <chrono>
#include <cstddef>

namespace drawpoint::studies::loopback {

struct Manners {
  std::chrono::seconds patience;  ///< with a client that does not say what it wants
  std::size_t largest_body;       ///< of what is sent here [byte]
};

class BoundedServer : public httplib::Server {
 public:
  explicit BoundedServer(const Manners& manners);

  /// After the port is bound: lets more connections wait than the five of the library, the sixth of which the
  /// system would have ask again after a second.
  void queue_connections();

 private:
  bool process_and_close_socket(int socket) override;

  Manners manners_;
  Connections connections_;
};

}  // namespace drawpoint::studies::loopback
