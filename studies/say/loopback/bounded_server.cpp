// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/loopback/bounded_server.h>
#include <drawpoint/studies/say/loopback/bounded_stream.h>
#include <sys/socket.h>
#include <unistd.h>

#include <functional>
#include <utility>

namespace drawpoint::studies::loopback {
namespace {

constexpr std::size_t most_connections = 64;  // each has a thread
constexpr std::size_t largest_head = std::size_t{64} << 10;
constexpr std::chrono::seconds time_to_take(300);  // for an answer of megabytes, through a slow tunnel

class CountedTasks : public httplib::ThreadPool {
 public:
  explicit CountedTasks(Connections& connections) : ThreadPool(most_connections), connections_(connections) {}
  void enqueue(std::function<void()> serve) override {
    connections_.accepted();
    ThreadPool::enqueue(std::move(serve));
  }

 private:
  Connections& connections_;
};

}  // namespace

BoundedServer::BoundedServer(const Manners& manners) : manners_(manners), connections_(most_connections) {
  new_task_queue = [this] { return new CountedTasks(connections_); };
  set_payload_max_length(manners.largest_body);
}

void BoundedServer::queue_connections() { ::listen(svr_sock_, SOMAXCONN); }

bool BoundedServer::process_and_close_socket(int socket) {
  connections_.begin(socket);
  BoundedStream stream(socket, {.question = largest_head + manners_.largest_body,
                                .time_to_ask = manners_.patience,
                                .time_to_answer = manners_.patience + time_to_take});
  bool closed = false;
  const bool answered =
      process_request(stream, true, closed, [](httplib::Request& request) { request.ranges.clear(); });
  connections_.end(socket);
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return answered;
}

}  // namespace drawpoint::studies::loopback
