// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/loopback/connections.h>
#include <sys/socket.h>

namespace drawpoint::studies::loopback {

void Connections::accepted() {
  const std::lock_guard lock(mutex_);
  ++waiting_;
  make_room();
}

void Connections::begin(int socket) {
  const std::lock_guard lock(mutex_);
  --waiting_;
  served_.push_back(socket);
  make_room();
}

void Connections::end(int socket) {
  const std::lock_guard lock(mutex_);
  served_.remove(socket);
}

void Connections::make_room() {
  while (!served_.empty() && served_.size() + waiting_ > most_) {
    shutdown(served_.front(), SHUT_RDWR);  // its thread then finds the end of it
    served_.pop_front();
  }
}

}  // namespace drawpoint::studies::loopback
