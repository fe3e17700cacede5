// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/live/server.h>
#include <drawpoint/studies/runs/interrupt.h>
#include <httplib.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace drawpoint::studies {
namespace {

using httplib::Request;
using httplib::Response;

constexpr const char* loopback = "127.0.0.1";
constexpr std::chrono::milliseconds glance(50);
constexpr std::size_t threads = 32;     // slow clients hold one each
constexpr int seconds_of_patience = 2;  // with a client that does not say what it wants

/// Of the live page: its own scripts alone, and questions to this server alone.
std::string policy(const std::string& nonce) {
  return "default-src 'none'; script-src 'nonce-" + nonce +
         "'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:; connect-src 'self'; base-uri "
         "'none'; "
         "form-action 'none'; frame-ancestors 'none'";
}

/// The page of one run has a policy of its own, in the page: its scene and plots need more, its network
/// nothing.
constexpr const char* policy_elsewhere = "frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

std::string new_nonce() {
  std::random_device random;
  std::string text;
  for (int i = 0; i < 4; ++i) text += std::to_string(random());
  return text;
}

/// By its length, so that nothing is compressed: a page of megabytes would take seconds.
void give(Response& response, Answer answer) {
  response.status = answer.status;
  const std::size_t length = answer.body.size();
  response.set_content_provider(
      length, answer.type.c_str(),
      [body = std::move(answer.body)](std::size_t at, std::size_t count, auto& sink) {
        return sink.write(body.data() + at, count);
      });
}

void refuse(Response& response, int status, const std::string& why) {
  give(response, {status, "text/plain; charset=utf-8", why + "\n"});
}

/// A number in decimal digits; 0 for anything else.
template <class T>
T number_in(const std::string& text) {
  T value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  return end.ec == std::errc() && end.ptr == text.data() + text.size() ? value : 0;
}

/// Refuses what is not for this server.
httplib::Server::HandlerWithResponse gate(int port) {
  const std::vector<std::string> hosts = {std::string(loopback) + ":" + std::to_string(port),
                                          std::string("localhost:") + std::to_string(port)};
  return [hosts](const Request& request, Response& response) {
    const std::string host = request.get_header_value("Host");
    if (request.get_header_value_count("Host") != 1 ||
        std::find(hosts.begin(), hosts.end(), host) == hosts.end()) {
      refuse(response, 403,
             "This page answers to http://" + hosts[0] + "/ and http://" + hosts[1] +
                 "/ alone. Through a tunnel, use the same port at both ends.");
      return httplib::Server::HandlerResponse::Handled;
    }
    if (request.method != "GET" && request.method != "HEAD") {
      response.set_header("Allow", "GET, HEAD");
      refuse(response, 405, "This page can be looked at, and nothing else: GET and HEAD.");
      return httplib::Server::HandlerResponse::Handled;
    }
    return httplib::Server::HandlerResponse::Unhandled;
  };
}

void set_routes(httplib::Server& server, Site& site) {
  server.Get("/", [&](const Request&, Response& response) {
    const std::string nonce = new_nonce();
    give(response, site.page(nonce));
    response.set_header("Content-Security-Policy", policy(nonce));
  });
  server.Get("/state.json", [&](const Request& request, Response& response) {
    give(response, site.state({request.get_param_value("epoch"),
                               number_in<std::size_t>(request.get_param_value("since"))}));
  });
  server.Get("/figures.json", [&](const Request& request, Response& response) {
    give(response, site.figures(number_in<std::int64_t>(request.get_param_value("run"))));
  });
  server.Get("/run/([0-9]{1,9})", [&](const Request& request, Response& response) {
    give(response, site.replay(number_in<std::int64_t>(request.matches[1].str())));
    response.set_header("Content-Security-Policy", policy_elsewhere);
  });
  server.set_error_handler(httplib::Server::Handler([](const Request&, Response& response) {
    if (response.status == 404 && !response.content_provider_)
      refuse(response, 404, "There is no such page. The live page is /");
  }));
  server.set_exception_handler([](const Request&, Response& response, std::exception_ptr problem) {
    try {
      std::rethrow_exception(problem);
    } catch (const std::exception& e) {
      refuse(response, 500, e.what());
    } catch (...) {
      refuse(response, 500, "unknown error");
    }
  });
}

void set_manners(httplib::Server& server) {
  server.set_default_headers({{"Cache-Control", "no-store"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"X-Frame-Options", "DENY"}});
  server.new_task_queue = [] { return new httplib::ThreadPool(threads); };
  server.set_keep_alive_max_count(1);
  server.set_keep_alive_timeout(seconds_of_patience);
  server.set_read_timeout(seconds_of_patience);
  server.set_payload_max_length(0);
  // Without SO_REUSEPORT, which the library sets: two servers could have one port.
  server.set_socket_options([](int socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
}

int bound(httplib::Server& server, int port) {
  errno = 0;
  const int got = port == 0                             ? server.bind_to_any_port(loopback)
                  : server.bind_to_port(loopback, port) ? port
                                                        : -1;
  if (got > 0) return got;
  const int error = errno;
  if (port == 0)
    throw std::runtime_error("live: no port of 127.0.0.1 is free; end some programs that listen there");
  if (error == EACCES)
    throw std::runtime_error(
        "live: port " + std::to_string(port) +
        " of 127.0.0.1 may not be used by this user; choose one from 1024 on with --port");
  throw std::runtime_error("live: port " + std::to_string(port) +
                           " of 127.0.0.1 cannot be had: another program listens there; choose another with "
                           "--port, or leave --port out for one that is free");
}

}  // namespace

void serve(Site& site, int port, const std::function<void(int port)>& started) {
  httplib::Server server;
  set_manners(server);
  set_routes(server, site);
  const int got = bound(server, port);
  server.set_pre_routing_handler(gate(got));
  const InterruptGuard guard("");
  std::atomic<bool> over = false;
  std::thread listening([&] {
    server.listen_after_bind();
    over = true;
  });
  started(got);
  while (!over && !(InterruptGuard::requested() && server.is_running())) std::this_thread::sleep_for(glance);
  if (!over) server.stop();
  // A client that drips its question could hold its thread for ever.
  for (auto waited = glance; !over && waited < std::chrono::seconds(seconds_of_patience + 1);
       waited += glance)
    std::this_thread::sleep_for(glance);
  if (!over) std::_Exit(0);  // nothing is left to write: the store is only read
  listening.join();
  if (!InterruptGuard::requested())
    throw std::runtime_error("live: the server on port " + std::to_string(got) +
                             " ended by itself; give the same command again");
}

std::string http_version() { return CPPHTTPLIB_VERSION; }

}  // namespace drawpoint::studies
