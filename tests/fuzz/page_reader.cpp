// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/run_logs.h>
#include <drawpoint/studies/say/live/server.h>
#include <signal.h>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/tests/fuzz/own_folder.hpp>
#include <drawpoint/tests/support/loopback_client.hpp>

#include <future>
#include <nlohmann/json.hpp>
#include <optional>

namespace drawpoint::fuzz {
namespace {

using namespace studies;
using nlohmann::json;

/// A study with one run and its log, served until the process ends.
class Served {
 public:
  Served() {
    std::filesystem::create_directories(study_folder_.logs());
    write(study_folder_.log(1), Bytes{});
    study_.name = "sample";
    study_.problem = {.variables = {{"alpha", "1", 0.2, 2.0}},
                      .responses = {{"cost", "EUR", doe::Goal::minimize}}};
    study_.presentation.illustrate = [](const std::filesystem::path&) {
      return json::array(
          {{{"type", "table"}, {"title", "t"}, {"caption", "c"}, {"columns", {"a"}}, {"rows", {{1}}}}});
    };
    Store store = Store::create(study_folder_.store(), {.study = "sample", .problem = study_.problem});
    studies::Run run;
    run.id = run.point = 1;
    run.x = Eigen::VectorXd::Constant(1, 1.0);
    store.add({run});
    store.save_done(1, Eigen::VectorXd::Constant(1, 3.0), 2.0, file_checksum(study_folder_.log(1)));
    site_.emplace(Followed{study_, study_folder_, "sample"});
    std::promise<int> port;
    serving_ =
        std::async(std::launch::async, [&] { serve(*site_, 0, [&](int got) { port.set_value(got); }); });
    port_ = port.get_future().get();
  }
  ~Served() {
    kill(getpid(), SIGINT);
    serving_.wait();
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  int port() const { return port_; }

 private:
  OwnFolder own_;
  Folder study_folder_{own_.path()};
  Study study_;
  std::optional<Site> site_;
  std::future<void> serving_;
  int port_ = 0;
};

/// All that comes back once nothing more is asked.
std::string answer(int port, const std::string& question) {
  const int socket = support::connected("127.0.0.1", port);
  if (socket < 0) return "";
  ::send(socket, question.data(), question.size(), MSG_NOSIGNAL);
  ::shutdown(socket, SHUT_WR);
  std::string text;
  char part[65536];
  for (ssize_t count; (count = ::recv(socket, part, sizeof part, 0)) > 0;)
    text.append(part, static_cast<std::size_t>(count));
  ::close(socket);
  return text;
}

/// An answer is as long as it says: no byte behind its end is given.
void require_whole(const std::string& text) {
  const std::size_t head = text.find("\r\n\r\n"), length = text.find("Content-Length: ");
  if (head == text.npos || length == text.npos || length > head) return;
  if (text.size() - head - 4 > std::stoull(text.substr(length + 16))) __builtin_trap();
}

}  // namespace

/// "@" stands for the host that the page answers to: its port differs from one process to the next.
void read_question(Bytes bytes) {
  static const Served served;
  std::string question;
  for (const char c : text_of(bytes))
    question += c == '@' ? "127.0.0.1:" + std::to_string(served.port()) : std::string(1, c);
  require_whole(answer(served.port(), question));
}

}  // namespace drawpoint::fuzz
