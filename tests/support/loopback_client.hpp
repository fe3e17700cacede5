// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Asks a server of this machine by bytes on a socket, so that a test can say what no client would.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <string>

namespace drawpoint::support {

struct Reply {
  int status = 0;  ///< 0: nothing that looks like a reply came
  std::string head, body;
};

/// A socket, or -1.
inline int connected(const std::string& address, int port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to = {};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, address.c_str(), &to.sin_addr);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) return socket;
  ::close(socket);
  return -1;
}

/// What comes back for these lines, up to the end of the connection.
inline Reply answer_to(int port, const std::string& lines) {
  const int socket = connected("127.0.0.1", port);
  if (socket < 0) return {};
  std::string text;
  if (::send(socket, lines.data(), lines.size(), MSG_NOSIGNAL) > 0) {
    char part[65536];
    for (ssize_t count; (count = ::recv(socket, part, sizeof part, 0)) > 0;)
      text.append(part, static_cast<std::size_t>(count));
  }
  ::close(socket);
  const std::size_t end = text.find("\r\n\r\n");
  if (end == std::string::npos) return {0, text, ""};
  return {std::stoi(text.substr(text.find(' '))), text.substr(0, end), text.substr(end + 4)};
}

/// GET of `what`, for the host that it is.
inline Reply get(int port, const std::string& what) {
  return answer_to(port, "GET " + what + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n");
}

}  // namespace drawpoint::support
