// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/frames/frame_server.h>
#include <drawpoint/studies/say/loopback/loopback.h>
#include <httplib.h>

#include <stdexcept>
#include <utility>

namespace drawpoint::studies {
namespace {

constexpr loopback::Manners manners_of_frames = {.patience = std::chrono::seconds(30),
                                                 .largest_body = std::size_t{256} << 20};

/// Refuses whoever does not know the name, before anything that is sent is read.
httplib::Server::HandlerWithResponse gate_of_frames(int port, const std::string& place) {
  return [port, place](const httplib::Request& request, httplib::Response& response) {
    if (loopback::refused_by_host(request, response, port)) return httplib::Server::HandlerResponse::Handled;
    if (!request.path.starts_with(place)) {
      loopback::refuse(response, 404, "There is nothing to see here.");
      return httplib::Server::HandlerResponse::Handled;
    }
    const bool asks = request.method == "GET" || request.method == "HEAD";
    if (!asks && loopback::refused_by_body(request, response, manners_of_frames.largest_body))
      return httplib::Server::HandlerResponse::Handled;
    return httplib::Server::HandlerResponse::Unhandled;
  };
}

void set_routes_of_frames(httplib::Server& server, const std::string& place,
                          std::function<std::string(const std::string&)> page,
                          const std::shared_ptr<FrameInbox>& inbox) {
  server.Get(place, [page = std::move(page)](const httplib::Request&, httplib::Response& response) {
    const std::string nonce = loopback::random_word();
    loopback::give(response, 200, "text/html; charset=utf-8", page(nonce));
    response.set_header("Content-Security-Policy", loopback::policy_of_own_scripts(nonce));
  });
  server.Post(place + "frame/([0-9]{1,6})",
              [inbox](const httplib::Request& request, httplib::Response& response) {
                const std::string complaint = inbox->take(std::stoul(request.matches[1].str()), request.body);
                if (!complaint.empty()) loopback::refuse(response, 400, complaint);
              });
  server.Post(place + "problem",
              [inbox](const httplib::Request& request, httplib::Response&) { inbox->give_up(request.body); });
}

}  // namespace

struct FrameServer::Listening : loopback::Listener {
  using Listener::Listener;
};

FrameServer::FrameServer(std::function<std::string(const std::string& nonce)> page,
                         std::shared_ptr<FrameInbox> inbox)
    : inbox_(std::move(inbox)) {
  const auto server = std::make_shared<loopback::BoundedServer>(manners_of_frames);
  const std::string place = std::string("/").append(loopback::random_word()).append("/");
  loopback::set_manners(*server);
  set_routes_of_frames(*server, place, std::move(page), inbox_);
  const int port = loopback::bind(*server, 0);
  if (port <= 0)
    throw std::runtime_error("replay: no port of 127.0.0.1 is free; end some programs that listen there");
  server->set_pre_routing_handler(gate_of_frames(port, place));
  address_ = "http://127.0.0.1:" + std::to_string(port) + place;
  listening_ = std::make_unique<Listening>(server);
}

FrameServer::~FrameServer() { inbox_->close(); }

}  // namespace drawpoint::studies
