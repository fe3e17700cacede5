// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/run/progress.h>
#include <drawpoint/studies/say/frames/frame_files.h>
#include <drawpoint/studies/say/frames/frame_server.h>
#include <drawpoint/studies/say/frames/programs.h>
#include <drawpoint/studies/say/frames/rendering.h>
#include <drawpoint/studies/say/frames/scratch.h>
#include <drawpoint/studies/say/page/page.h>
#include <unistd.h>
#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/doe/processes.hpp>

#include <memory>
#include <stdexcept>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::string page_of(const Rendering& rendering, const std::string& nonce) {
  return detail::pictures_page("frames",
                               {{"scene", rendering.scene},
                                {"times", rendering.times},
                                {"width", rendering.size.width},
                                {"height", rendering.size.height},
                                {"camera", rendering.camera}},
                               nonce);
}

/// Leads to the address, which no list of processes shows then: who knows it can hand in frames.
fs::path start_page(const fs::path& own, const std::string& address) {
  const fs::path file = own / "start.html";
  doe::write_file(file,
                  "<!doctype html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"0; url=" +
                      address + "\">\n");
  return file;
}

/// All that the browser keeps is in its own folder, also what it puts into the home folder and the one for
/// temporary files.
std::vector<std::string> words_for(const Browser& browser, const fs::path& own, const fs::path& start) {
  std::vector<std::string> words;
  for (const char* variable : {"HOME", "TMPDIR", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME"})
    words.push_back(variable + ("=" + own.string()));
  words.push_back(browser.program.string());
  for (const char* option :
       {"--headless=new", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
        "--force-device-scale-factor=1", "--disable-dev-shm-usage", "--no-first-run",
        "--no-default-browser-check", "--disable-extensions", "--disable-sync",
        "--disable-background-networking", "--disable-component-update", "--disable-breakpad",
        "--no-proxy-server", "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
        "--enable-logging=stderr"})
    words.emplace_back(option);
  if (geteuid() == 0) words.emplace_back("--no-sandbox");  // without which it does not start as root
  words.push_back("--user-data-dir=" + (own / "profile").string());
  words.push_back("file://" + start.string());
  return words;
}

class Watch {
 public:
  Watch(const Browser& browser, const fs::path& printed, std::size_t total)
      : patience_(browser.patience), printed_(printed), total_(total) {}

  /// A frame came.
  void heard(std::size_t count) {
    count_ = count;
    last_ = Clock::now();
  }
  void look(doe::ProcessPool& pool) const {
    if (InterruptGuard::requested()) throw Interrupted{};
    if (Clock::now() - last_ > patience_)
      stop("drew nothing for " + duration_text(std::chrono::duration<double>(patience_).count()));
    const auto ends = pool.wait(std::chrono::milliseconds(0));
    if (!ends.empty()) stop(doe::describe(ends.front()));
  }

 private:
  [[noreturn]] void stop(const std::string& how) const {
    throw std::runtime_error("replay: the browser " + how + ", with " + std::to_string(count_) + " of " +
                             std::to_string(total_) + " frames drawn; " + last_words(printed_));
  }

  std::chrono::milliseconds patience_;
  fs::path printed_;
  std::size_t total_, count_ = 0;
  Clock::time_point last_ = Clock::now();
};

}  // namespace

void render(const Rendering& rendering, const Browser& browser, const fs::path& folder) {
  const std::size_t total = rendering.times.size();
  const auto inbox =
      std::make_shared<FrameInbox>(total, rendering.size, [folder](std::size_t number, std::string_view png) {
        doe::write_file(folder / frame_name(number), png);
      });
  const Scratch scratch;
  const FrameServer server([&](const std::string& nonce) { return page_of(rendering, nonce); }, inbox);
  doe::ProcessPool pool(1);
  const fs::path printed = scratch.path() / "printed.txt";
  pool.start({.executable = "env",
              .arguments = words_for(browser, scratch.path(), start_page(scratch.path(), server.address())),
              .output = printed});
  Progress progress(STDERR_FILENO, {.total = static_cast<int>(total), .things = "frames"});
  Watch watch(browser, printed, total);
  for (std::size_t count = 0; count < total;) {
    const std::size_t now = inbox->wait(count, std::chrono::milliseconds(100));
    if (now > count) watch.heard(now);
    for (; count < now; ++count) progress.finished_one(false);
    if (count < total) watch.look(pool);
    progress.tick("");
  }
  pool.terminate(time_to_end);
}

}  // namespace drawpoint::studies
