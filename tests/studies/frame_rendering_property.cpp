// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The work beside a browser that is a shell script here, so that it can do what no browser should: what is
/// taken from whom, and that nothing is left of it.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/say/frames/frame_files.h>
#include <drawpoint/studies/say/frames/rendering.h>
#include <signal.h>
#include <drawpoint/tests/support/loopback_client.hpp>
#include <drawpoint/tests/support/png_bytes.hpp>

#include <cerrno>
#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <thread>

using namespace drawpoint;
using namespace drawpoint::studies;
using support::png_bytes;
using support::Reply;

namespace {

constexpr std::chrono::milliseconds moment(5);

class Rendered : public testing::Test {
 protected:
  Rendered() {
    std::filesystem::create_directories(place_ / "temporary");
    std::filesystem::create_directories(folder());
    before_ = std::getenv("TMPDIR") ? std::optional<std::string>(std::getenv("TMPDIR")) : std::nullopt;
    setenv("TMPDIR", (place_ / "temporary").c_str(), 1);
  }
  ~Rendered() override {
    before_ ? setenv("TMPDIR", before_->c_str(), 1) : unsetenv("TMPDIR");
    EXPECT_TRUE(std::filesystem::is_empty(place_ / "temporary")) << "the browser's own folder is left";
  }

  std::filesystem::path folder() const { return place_ / "frames"; }
  /// Runs the script as the browser; start.html is what it is given to open.
  void with_browser(const std::string& script,
                    std::chrono::milliseconds patience = std::chrono::minutes(1)) const {
    const auto program = place_ / "browser";
    test::write_file(program, "#!/bin/sh\nfor last; do :; done\nstart=${last#file://}\ncd " +
                                  place_.path().string() + "\n" + script + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    const InterruptGuard guard("");
    render({.scene = {{"bodies", "<3"}}, .times = {0.5, 1.5}, .size = {4, 2}}, {program, patience}, folder());
  }
  /// With a browser that leaves the work to `client`, which gets port and place of the page.
  void with_client(const std::function<void(int port, const std::string& page)>& client) const {
    std::future<void> work;
    work = std::async(std::launch::async, [&] {
      const std::string address = awaited("address");
      const std::size_t end_of_port = address.find('/', 17);
      client(std::stoi(address.substr(17, end_of_port - 17)),
             address.substr(end_of_port, address.find('"', end_of_port) - end_of_port));
    });
    with_browser("sed -n 's/.*url=//p' \"$start\" >new; mv new address; exec sleep 300");
    work.get();
  }
  /// What the script writes to this file.
  std::string awaited(const std::string& file) const {
    for (int i = 0; i < 12000 && !std::filesystem::exists(place_ / file); ++i)
      std::this_thread::sleep_for(moment);
    return test::contents(place_ / file);
  }
  static Reply sent(int port, const std::string& what, const std::string& body) {
    return support::answer_to(port, "POST " + what + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                                        "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
                                        body);
  }
  /// Whether this process is gone, within a minute.
  static bool ends(pid_t process) {
    for (int i = 0; i < 12000; ++i) {
      if (kill(process, 0) != 0 && errno == ESRCH) return true;
      std::this_thread::sleep_for(moment);
    }
    return false;
  }

  test::TestFolder place_;
  std::optional<std::string> before_;
};

TEST_F(Rendered, FramesAreTakenFromWhoKnowsTheNameAlone) {
  with_client([&](int port, const std::string& page) {
    EXPECT_EQ(page.size(), 34u) << "32 letters and digits";
    for (const std::string place : {"/", "/frame/1", "/00000000000000000000000000000000/", "/problem"}) {
      EXPECT_EQ(support::get(port, place).status, 404) << place;
      EXPECT_EQ(sent(port, place, png_bytes(4, 2)).status, 404) << place;
    }
    EXPECT_EQ(support::answer_to(port, "GET " + page + " HTTP/1.1\r\nHost: evil.example\r\n\r\n").status,
              403);
    EXPECT_EQ(support::get(port, page + "frame/1").status, 404);
    EXPECT_EQ(support::connected("127.0.0.2", port), -1) << "another address of the same machine";
    EXPECT_EQ(sent(port, page + "frame/1", png_bytes(4, 2, "one")).status, 200);
    EXPECT_EQ(sent(port, page + "frame/2", png_bytes(4, 2, "two")).status, 200);
  });
  EXPECT_EQ(test::contents(folder() / frame_name(1)), png_bytes(4, 2, "one"));
  EXPECT_EQ(test::contents(folder() / frame_name(2)), png_bytes(4, 2, "two"));
}

TEST_F(Rendered, BodiesOfAnUnknownLengthAreNotRead) {
  with_client([&](int port, const std::string& page) {
    const std::string head = "POST " + page + "frame/1 HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port);
    for (const char* said :
         {"Content-Length: -1", "Content-Length: 99999999999999999999", "Content-Length: 268435457",
          "Content-Length: 1\r\nContent-Length: 2", "Transfer-Encoding: chunked", "X: no length",
          "Content-Length: 9\r\nContent-Encoding: gzip"})
      EXPECT_EQ(support::answer_to(port, head + "\r\n" + said + "\r\n\r\n").status, 413) << said;
    for (const char* k : {"1", "2"}) sent(port, page + "frame/" + k, png_bytes(4, 2));
  });
}

TEST_F(Rendered, ThePageHasItsPolicyAndItsTask) {
  with_client([&](int port, const std::string& place) {
    const Reply page = support::get(port, place);
    EXPECT_EQ(page.status, 200);
    const std::string policy = "Content-Security-Policy: default-src 'none'; script-src 'nonce-";
    const std::size_t nonce = page.head.find(policy) + policy.size();
    EXPECT_NE(page.body.find("<script nonce=\"" + page.head.substr(nonce, 32) + "\">"), std::string::npos);
    EXPECT_NE(page.body.find("\"times\":[0.5,1.5]"), std::string::npos);
    EXPECT_NE(page.body.find("\\u003c3"), std::string::npos) << "no text can end the element";
    EXPECT_EQ(page.body.find("@DRAWPOINT_"), std::string::npos);
    for (const char* k : {"1", "2"}) sent(port, place + "frame/" + k, png_bytes(4, 2));
  });
}

TEST_F(Rendered, APictureThatIsNotWholeEndsIt) {
  EXPECT_EQ(test::complaint([&] {
              with_client([](int port, const std::string& page) {
                const Reply reply = sent(port, page + "frame/1", png_bytes(5, 2));
                EXPECT_EQ(reply.status, 400);
                EXPECT_EQ(reply.body, "frame 1 is not whole: it has 5x2 pixels, not 4x2\n");
              });
            }),
            "replay: frame 1 is not whole: it has 5x2 pixels, not 4x2");
  EXPECT_TRUE(std::filesystem::is_empty(folder()));
}

TEST_F(Rendered, APageThatCannotDrawSaysWhy) {
  EXPECT_EQ(
      test::complaint([&] {
        with_client([](int port, const std::string& page) { sent(port, page + "problem", "no WebGL"); });
      }),
      "replay: the browser could not draw the scene: no WebGL");
}

TEST_F(Rendered, ABrowserThatEndsIsToldWithItsLastWords) {
  EXPECT_EQ(test::complaint([&] { with_browser("echo starting; echo no luck >&2; exit 3"); }),
            "replay: the browser ended with exit code 3, with 0 of 2 frames drawn; it printed last:\n"
            "  starting\n  no luck");
}

TEST_F(Rendered, ABrowserThatHangsIsEndedWithItsChildren) {
  EXPECT_EQ(test::complaint([&] {
              with_browser("trap '' TERM; echo hm; sleep 300 & echo $! >new; mv new child; wait; sleep 300",
                           std::chrono::milliseconds(1500));
            }),
            "replay: the browser drew nothing for 1.5 s, with 0 of 2 frames drawn; it printed last:\n  hm");
  EXPECT_TRUE(ends(std::stoi(awaited("child"))));
}

TEST_F(Rendered, ASignalEndsTheBrowserWithItsChildren) {
  std::future<void> user = std::async(std::launch::async, [&] {
    awaited("child");
    kill(getpid(), SIGINT);
  });
  EXPECT_THROW(with_browser("sleep 300 & echo $! >new; mv new child; wait"), Interrupted);
  user.get();
  EXPECT_TRUE(ends(std::stoi(awaited("child"))));
}

TEST_F(Rendered, WhatTheBrowserKeepsIsInItsOwnFolder) {
  EXPECT_THROW(
      with_browser("echo \"$HOME $TMPDIR $XDG_CONFIG_HOME\" >homes; touch \"$HOME/.profile\"; exit 1"),
      std::runtime_error);
  const std::string homes = test::contents(place_ / "homes"), own = homes.substr(0, homes.find(' '));
  EXPECT_EQ(homes, own + " " + own + " " + own + "\n");
  EXPECT_TRUE(own.starts_with((place_ / "temporary").string()));
}

}  // namespace
