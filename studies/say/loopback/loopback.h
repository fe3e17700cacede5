// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the servers on 127.0.0.1 share: whom they answer, how, and how they end.

#include <drawpoint/studies/say/loopback/bounded_server.h>
#include <httplib.h>

#include <atomic>
#include <memory>
#include <string>

namespace drawpoint::studies::loopback {

/// What every answer says, and how a port is taken.
void set_manners(httplib::Server& server);

/// A port of 127.0.0.1 that is free where `port` is 0; -1 with errno where it cannot be had.
int bind(BoundedServer& server, int port);

/// Whether the question was not for 127.0.0.1 or localhost with this port; then it has been refused. A page
/// of the web whose name is turned to this machine (DNS rebinding) asks for another host.
bool refused_by_host(const httplib::Request& request, httplib::Response& response, int port);

/// Whether a body follows whose length is not said in digits, or is above what the server takes, or that is
/// packed; then it has been refused.
bool refused_by_body(const httplib::Request& request, httplib::Response& response, std::size_t largest);

/// By its length, so that nothing is compressed: a page of megabytes would take seconds.
void give(httplib::Response& response, int status, const std::string& type, std::string body);
/// In one piece with its head, so that a server that ends because of it still says why.
void refuse(httplib::Response& response, int status, const std::string& why);

/// 128 random bits as letters and digits: a nonce, or a name that nobody can guess.
std::string random_word();

/// The policy of a page with these scripts alone, which asks this server alone.
std::string policy_of_own_scripts(const std::string& nonce);

/// A bound server that listens on a thread of its own.
class Listener {
 public:
  explicit Listener(std::shared_ptr<httplib::Server> server);
  ~Listener() { stop(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// Whether it has ended.
  bool over() const { return *over_; }

  /// Ends it. False where a client that drips its question still holds a thread after three seconds: that
  /// thread then goes on with what it holds, until the process ends.
  bool stop();

 private:
  std::shared_ptr<httplib::Server> server_;
  std::shared_ptr<std::atomic<bool>> over_;
};

}  // namespace drawpoint::studies::loopback
