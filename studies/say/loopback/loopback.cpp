// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/loopback/loopback.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <exception>
#include <random>
#include <system_error>
#include <thread>
#include <utility>

namespace drawpoint::studies::loopback {
namespace {

constexpr const char* address = "127.0.0.1";
constexpr std::chrono::milliseconds glance(10);
constexpr std::chrono::seconds time_to_answer(3);  // what is being answered when the server is to end

void answer_exceptions(httplib::Server& server) {
  server.set_exception_handler(
      [](const httplib::Request&, httplib::Response& response, std::exception_ptr problem) {
        try {
          std::rethrow_exception(problem);
        } catch (const std::exception& e) {
          refuse(response, 500, e.what());
        } catch (...) {
          refuse(response, 500, "unknown error");
        }
      });
}

}  // namespace

void set_manners(httplib::Server& server) {
  server.set_default_headers({{"Cache-Control", "no-store"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"X-Frame-Options", "DENY"}});
  // Without SO_REUSEPORT, which the library sets: two servers could have one port.
  server.set_socket_options([](int socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  answer_exceptions(server);
}

int bind(BoundedServer& server, int port) {
  errno = 0;
  if (port == 0)
    port = server.bind_to_any_port(address);
  else if (!server.bind_to_port(address, port))
    return -1;
  if (port > 0) server.queue_connections();
  return port;
}

bool refused_by_host(const httplib::Request& request, httplib::Response& response, int port) {
  const std::string number = std::to_string(port);
  const std::array<std::string, 2> hosts = {std::string(address) + ":" + number,
                                            std::string("localhost:") + number};
  const std::string host = request.get_header_value("Host");
  if (request.get_header_value_count("Host") == 1 &&
      std::find(hosts.begin(), hosts.end(), host) != hosts.end())
    return false;
  refuse(response, 403,
         "This page answers to http://" + hosts[0] + "/ and http://" + hosts[1] +
             "/ alone. Through a tunnel, use the same port at both ends.");
  return true;
}

bool refused_by_body(const httplib::Request& request, httplib::Response& response, std::size_t largest) {
  const std::string text = request.get_header_value("Content-Length");
  std::size_t length = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), length);
  const bool told = request.get_header_value_count("Content-Length") == 1 && end.ec == std::errc() &&
                    end.ptr == text.data() + text.size();
  const bool packed = request.has_header("Transfer-Encoding") || request.has_header("Content-Encoding") ||
                      request.is_multipart_form_data();
  if (told && !packed && length <= largest) return false;
  refuse(response, 413,
         "A body of a length in digits, at most " + std::to_string(largest) +
             " bytes, sent as it is: nothing else is taken.");
  return true;
}

void give(httplib::Response& response, int status, const std::string& type, std::string body) {
  response.status = status;
  const std::size_t length = body.size();
  response.set_content_provider(length, type.c_str(),
                                [body = std::move(body)](std::size_t at, std::size_t count, auto& sink) {
                                  if (at > body.size() || count > body.size() - at) return false;
                                  return sink.write(body.data() + at, count);
                                });
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(why + "\n", "text/plain; charset=utf-8");
}

std::string random_word() {
  std::random_device random;
  std::string text;
  for (int i = 0; i < 4; ++i) {
    char part[9];
    std::snprintf(part, sizeof part, "%08x", random());
    text += part;
  }
  return text;
}

std::string policy_of_own_scripts(const std::string& nonce) {
  return "default-src 'none'; script-src 'nonce-" + nonce +
         "'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:; connect-src 'self'; base-uri "
         "'none'; "
         "form-action 'none'; frame-ancestors 'none'";
}

Listener::Listener(std::shared_ptr<httplib::Server> server)
    : server_(std::move(server)), over_(std::make_shared<std::atomic<bool>>(false)) {
  std::thread([server = server_, over = over_] {
    server->listen_after_bind();
    *over = true;
  }).detach();
}

bool Listener::stop() {
  while (!over() && !server_->is_running()) std::this_thread::sleep_for(glance);
  if (!over()) server_->stop();
  for (auto waited = glance; !over() && waited < time_to_answer; waited += glance)
    std::this_thread::sleep_for(glance);
  return over();
}

}  // namespace drawpoint::studies::loopback
