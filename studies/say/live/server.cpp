// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/say/live/server.h>
#include <drawpoint/studies/say/loopback/loopback.h>
#include <httplib.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace drawpoint::studies {
namespace {

using httplib::Request;
using httplib::Response;

constexpr std::chrono::milliseconds glance(50);
constexpr loopback::Manners manners = {.patience = std::chrono::seconds(2), .largest_body = 0};

/// The page of one run has a policy of its own, in the page: its scene and plots need more, its network
/// nothing.
constexpr const char* policy_elsewhere = "frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

void give(Response& response, Answer answer) {
  loopback::give(response, answer.status, answer.type, std::move(answer.body));
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
  return [port](const Request& request, Response& response) {
    if (loopback::refused_by_host(request, response, port)) return httplib::Server::HandlerResponse::Handled;
    if (request.method != "GET" && request.method != "HEAD") {
      response.set_header("Allow", "GET, HEAD");
      loopback::refuse(response, 405, "This page can be looked at, and nothing else: GET and HEAD.");
      return httplib::Server::HandlerResponse::Handled;
    }
    return httplib::Server::HandlerResponse::Unhandled;
  };
}

void set_routes(httplib::Server& server, Site& site) {
  server.Get("/", [&](const Request&, Response& response) {
    const std::string nonce = loopback::random_word();
    give(response, site.page(nonce));
    response.set_header("Content-Security-Policy", loopback::policy_of_own_scripts(nonce));
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
      loopback::refuse(response, 404, "There is no such page. The live page is /");
  }));
}

int bound(loopback::BoundedServer& server, int port) {
  const int got = loopback::bind(server, port);
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
  const auto server = std::make_shared<loopback::BoundedServer>(manners);
  loopback::set_manners(*server);
  set_routes(*server, site);
  const int got = bound(*server, port);
  server->set_pre_routing_handler(gate(got));
  const InterruptGuard guard("");
  loopback::Listener listener(server);
  started(got);
  while (!listener.over() && !InterruptGuard::requested()) std::this_thread::sleep_for(glance);
  if (!listener.stop()) std::_Exit(0);  // nothing is left to write: the store is only read
  if (!InterruptGuard::requested())
    throw std::runtime_error("live: the server on port " + std::to_string(got) +
                             " ended by itself; give the same command again");
}

std::string http_version() { return CPPHTTPLIB_VERSION; }

}  // namespace drawpoint::studies
