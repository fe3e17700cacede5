// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The live page's server on a port of its own, asked by bytes on a socket: what it gives, to whom, and how
/// it ends.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/run/store/run_logs.h>
#include <drawpoint/studies/say/live/server.h>
#include <signal.h>
#include <unistd.h>
#include <drawpoint/tests/support/loopback_client.hpp>

#include <atomic>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::studies;
using nlohmann::json;
using support::answer_to;
using support::connected;
using support::Reply;

namespace {

/// A study with one run that wrote a log, served.
class LiveServer : public testing::Test {
 protected:
  LiveServer() {
    std::filesystem::create_directories(folder_.logs());
    test::write_file(folder_.log(1), "raw");
    study_.name = "sample";
    study_.problem = test::two_by_two();
    study_.presentation.illustrate = [](const std::filesystem::path&) {
      const json table = {
          {"type", "table"}, {"title", "t"}, {"caption", "c"}, {"columns", {"a"}}, {"rows", {{1}}}};
      return json::array({table, {{"type", "scene"}, {"title", "s"}, {"caption", "c"}}, 7});
    };
    Store store = Store::create(folder_.store(), test::identity());
    studies::Run run;
    run.id = run.point = 1;
    run.x = Eigen::Vector2d(1.0, 0.0);
    store.add({run});
    store.save_done(1, Eigen::Vector2d(100.0, 0.2), 2.0, file_checksum(folder_.log(1)));
    site_.emplace(Followed{study_, folder_, "sample"});
    std::promise<int> told;
    serving_ =
        std::async(std::launch::async, [&] { serve(*site_, 0, [&](int port) { told.set_value(port); }); });
    port_ = told.get_future().get();
  }
  ~LiveServer() override { end(); }
  void end() {
    if (!serving_.valid()) return;
    kill(getpid(), SIGINT);
    serving_.get();
  }
  std::string here() const { return "127.0.0.1:" + std::to_string(port_); }
  Reply ask(const std::string& what, const std::string& host, const std::string& method = "GET") const {
    return answer_to(port_, method + " " + what + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  }
  Reply get(const std::string& what) const { return support::get(port_, what); }

  test::TestFolder place_;
  Folder folder_{place_.path()};
  Study study_;
  std::optional<Site> site_;
  std::future<void> serving_;
  int port_ = 0;
};

TEST_F(LiveServer, GivesThePageWithItsPolicy) {
  const Reply page = get("/");
  EXPECT_EQ(page.status, 200);
  EXPECT_NE(page.head.find("Content-Type: text/html"), std::string::npos);
  const std::string policy = "Content-Security-Policy: default-src 'none'; script-src 'nonce-";
  const std::size_t at = page.head.find(policy);
  ASSERT_NE(at, std::string::npos) << page.head;
  const std::size_t begin = at + policy.size();
  const std::string nonce = page.head.substr(begin, page.head.find('\'', begin) - begin);
  EXPECT_GE(nonce.size(), 20u);
  EXPECT_NE(page.body.find("<script nonce=\"" + nonce + "\">"), std::string::npos);
  EXPECT_EQ(page.body.find("@DRAWPOINT_"), std::string::npos);
  EXPECT_EQ(page.body.substr(page.body.size() - 8), "</html>\n") << "whole";
  EXPECT_EQ(get("/").head.find(nonce), std::string::npos) << "a nonce is used once";
}

TEST_F(LiveServer, GivesTheState) {
  const Reply reply = get("/state.json?epoch=&since=0");
  EXPECT_EQ(reply.status, 200);
  EXPECT_NE(reply.head.find("Cache-Control: no-store"), std::string::npos);
  const json state = json::parse(reply.body);
  EXPECT_EQ(state.at("rows").size(), 1u);
  EXPECT_EQ(state.at("logged"), 1);
  const std::string again = "/state.json?since=1&epoch=" + state.at("epoch").get<std::string>();
  EXPECT_EQ(json::parse(get(again).body).at("rows").size(), 0u);
  for (const char* nonsense : {"-1", "1e9", "99999999999999999999999", "%00"})
    EXPECT_EQ(get(std::string("/state.json?since=") + nonsense).status, 200) << nonsense;
}

TEST_F(LiveServer, GivesTheFiguresOfARunButNoScene) {
  const json figures = json::parse(get("/figures.json?run=1").body);
  ASSERT_EQ(figures.at("illustrations").size(), 1u);
  EXPECT_EQ(figures.at("illustrations").at(0).at("type"), "table");
  EXPECT_EQ(figures.at("cautions").size(), 1u) << "of the 7";
  const Reply none = get("/figures.json?run=2");
  EXPECT_EQ(none.status, 404);
  EXPECT_EQ(json::parse(none.body).at("error"), "there is no run 2");
}

TEST_F(LiveServer, GivesTheFiguresOfTheLastCycle) {
  study_.presentation.replay = [](const std::filesystem::path&) {
    json panels = json::array();
    for (const char* title : {"all", "first", "last"})
      panels.push_back(
          {{"type", "table"}, {"title", title}, {"caption", "c"}, {"columns", {"a"}}, {"rows", {{1}}}});
    panels[1]["cycle"] = 1;
    panels[2]["cycle"] = 2;
    return panels;
  };
  const json figures = json::parse(get("/figures.json?run=1").body).at("illustrations");
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures.at(0).at("title"), "all");
  EXPECT_EQ(figures.at(1).at("title"), "last");
}

TEST_F(LiveServer, GivesTheReplayOfARun) {
  test::write_file(folder_.log(1), "other");
  EXPECT_EQ(get("/run/1").status, 404);
  test::write_file(folder_.log(1), "raw");
  const Reply replay = get("/run/1");
  EXPECT_EQ(replay.status, 200);
  EXPECT_NE(replay.body.find("<title>sample, run 1</title>"), std::string::npos);
  EXPECT_NE(replay.body.find("sample replay --run 1"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_.replay(1))) << "nothing is written";
}

TEST_F(LiveServer, AnswersToItsOwnNamesAlone) {
  EXPECT_EQ(ask("/", "localhost:" + std::to_string(port_)).status, 200);
  for (const std::string& host : {std::string("evil.example"), "evil.example:" + std::to_string(port_),
                                  std::string("127.0.0.1"), std::string("127.0.0.1:1"), std::string("")}) {
    const Reply reply = ask("/state.json", host);
    EXPECT_TRUE(reply.status == 403 || reply.status == 400) << host << reply.status;
    EXPECT_EQ(reply.body.find("sample"), std::string::npos);
  }
  EXPECT_EQ(answer_to(port_, "GET / HTTP/1.1\r\n\r\n").status, 403);
  EXPECT_EQ(answer_to(port_, "GET / HTTP/1.1\r\nHost: " + here() + "\r\nHost: evil.example\r\n\r\n").status,
            403);
}

TEST_F(LiveServer, ListensOnLoopbackAlone) {
  EXPECT_EQ(connected("127.0.0.2", port_), -1) << "another address of the same machine";
}

TEST_F(LiveServer, NothingIsThereButItsPages) {
  for (const char* path : {"/study.db", "/etc/passwd", "/../study.db", "/..%2fstudy.db", "/run/",
                           "/run/1/../../study.db", "/run/-1", "/run/0001.h5", "//", "/index.html"})
    EXPECT_EQ(get(path).status, 404) << path;
}

TEST_F(LiveServer, CanOnlyBeLookedAt) {
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS"}) {
    const Reply reply = ask("/state.json", here(), method);
    EXPECT_EQ(reply.status, 405) << method;
    EXPECT_NE(reply.head.find("Allow: GET, HEAD"), std::string::npos);
  }
  const Reply head = ask("/", here(), "HEAD");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.body, "");
}

/// 416 is for what the library itself finds wrong, before anything is answered.
TEST_F(LiveServer, AnswersAreWholeWhateverRangeIsAsked) {
  const std::size_t whole = get("/figures.json?run=1").body.size();
  std::string many = "bytes=0-0";
  while (many.size() < 8000) many += ",0-0";
  for (const std::string& range :
       {std::string("bytes=10-60000"), std::string("bytes=9000000-9000001"), std::string("bytes=-60000"),
        std::string("bytes=-0"), std::string("bytes=-"), std::string("bytes=5-2"),
        std::string("bytes=0-0,4-9"), std::string("bytes=0-9223372036854775807"),
        std::string("bytes=9223372036854775807-"), std::string("bytes=0-99999999999999999999"),
        std::string("bytes=-9223372036854775807"), std::string("bytes=--5"), std::string("lines=1-2"),
        "bytes=" + std::string(8000, '1') + "-", many}) {
    for (const char* path : {"/figures.json?run=1", "/", "/run/1", "/none", "/state.json"}) {
      const Reply reply = answer_to(port_, std::string("GET ") + path + " HTTP/1.1\r\nHost: " + here() +
                                               "\r\nRange: " + range + "\r\n\r\n");
      const std::string name = range.substr(0, 40) + " of " + path;
      const std::string length = std::to_string(reply.body.size());
      EXPECT_TRUE(reply.status == 416 || reply.head.find("Content-Length: " + length) != std::string::npos)
          << name;
      EXPECT_EQ(reply.head.find("Content-Range"), std::string::npos) << name;
      EXPECT_NE(reply.status, 206) << name;
      if (path == std::string("/figures.json?run=1") && reply.status != 416) {
        EXPECT_EQ(reply.body.size(), whole) << name;
      }
    }
  }
}

TEST_F(LiveServer, LengthsThatAreSaidAreNotBelieved) {
  for (const char* length : {"-1", "99999999999999999999", "18446744073709551615", "x", "5, 5"})
    for (const char* method : {"GET", "POST"}) {
      const Reply reply = answer_to(port_, std::string(method) + " /state.json HTTP/1.1\r\nHost: " + here() +
                                               "\r\nContent-Length: " + length + "\r\n\r\n");
      EXPECT_EQ(reply.status, std::string(method) == "GET" ? 200 : 405) << length;
    }
  const std::string head = "GET / HTTP/1.1\r\nHost: " + here() + "\r\nX: ";
  EXPECT_NE(answer_to(port_, head + std::string(std::size_t{64} << 20, 'x') + "\r\n\r\n").status, 200)
      << "a line of 64 MiB";
  std::string lines = "GET / HTTP/1.1\r\nHost: " + here() + "\r\n";
  for (int k = 0; k < 100000; ++k) lines += "X" + std::to_string(k) + ": 1\r\n";
  EXPECT_NE(answer_to(port_, lines + "\r\n").status, 200) << "100 000 lines";
  EXPECT_EQ(get("/state.json").status, 200);
}

// Each sends a byte every 50 ms: no pause is long enough to be called silence. Without a bound on all
// together they kept the page away for half a minute.
TEST_F(LiveServer, ConnectionsThatDripDoNotKeepThePageAway) {
  std::vector<int> dripping;
  for (int k = 0; k < 600; ++k) {
    dripping.push_back(connected("127.0.0.1", port_));
    ::send(dripping.back(), "GET /", 5, MSG_NOSIGNAL);
  }
  std::atomic<bool> over = false;
  const auto drips = std::async(std::launch::async, [&] {
    while (!over) {
      for (const int socket : dripping) ::send(socket, "x", 1, MSG_NOSIGNAL);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
  for (int k = 0; k < 5; ++k) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(get("/state.json").status, 200);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  }
  over = true;
  drips.wait();
  for (const int socket : dripping) ::close(socket);
}

TEST_F(LiveServer, ItsPortIsItsOwn) {
  Site other(Followed{study_, folder_, "sample"});
  EXPECT_EQ(
      test::complaint([&] { serve(other, port_, [](int) {}); }),
      "live: port " + std::to_string(port_) +
          " of 127.0.0.1 cannot be had: another program listens there; choose another with --port, or leave "
          "--port out for one that is free");
}

TEST_F(LiveServer, EndsOnASignalThoughAClientSaysNothing) {
  const int silent = connected("127.0.0.1", port_);
  ASSERT_GE(silent, 0);
  kill(getpid(), SIGINT);
  EXPECT_EQ(serving_.wait_for(std::chrono::seconds(30)), std::future_status::ready)
      << "waits 2 s for the client";
  serving_.get();
  EXPECT_EQ(connected("127.0.0.1", port_), -1);
  ::close(silent);
}

}  // namespace
