// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Running a program as a user does: through the shell, with exit code, standard output and standard error
/// apart.

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>

namespace drawpoint::test {

inline std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Ended {
  int code = -1;  ///< exit code; 128 + signal if a signal ended it
  std::string out, err;

  /// The JSON object on the last line of standard output.
  nlohmann::json json() const {
    const std::string text = out.substr(0, out.find_last_not_of('\n') + 1);
    return nlohmann::json::parse(text.substr(text.rfind('\n') + 1), nullptr, false);
  }
};

/// A command that runs in the background until it ends, is awaited, or nobody holds it any more.
class Command {
 public:
  Command(const std::string& line, const std::filesystem::path& folder) {
    static int serial = 0;
    base_ = folder / ("command_" + std::to_string(++serial));
    pid_ = fork();
    if (pid_ == 0) {
      std::signal(SIGINT, SIG_DFL);  // ignored if the tests run in the background of a shell
      redirect(STDOUT_FILENO, out());
      redirect(STDERR_FILENO, err());
      execl("/bin/sh", "sh", "-c", ("exec " + line).c_str(), static_cast<char*>(nullptr));
      _exit(126);
    }
    if (pid_ < 0) throw std::runtime_error("cannot fork");
  }
  ~Command() {
    if (pid_ <= 0) return;
    send(SIGKILL);
    wait();
  }
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  void send(int signal) const { kill(pid_, signal); }

  Ended wait() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contents(out()),
            contents(err())};
  }

 private:
  static void redirect(int descriptor, const std::string& file) {
    dup2(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), descriptor);
  }
  std::string out() const { return base_.string() + ".out"; }
  std::string err() const { return base_.string() + ".err"; }

  std::filesystem::path base_;
  pid_t pid_ = -1;
};

inline testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << part << "\" is not in:\n" << text;
}

/// A test with a folder of its own, in which a study "study" may lie.
class StudyTest : public testing::Test {
 protected:
  StudyTest() {
    std::string name = (std::filesystem::temp_directory_path() / "drawpoint-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    place_ = name;
  }
  ~StudyTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(place_, ignored);
  }

  Ended run(const std::string& line) const { return Command(line, place_).wait(); }
  /// Ends with this code, these words on standard error and nothing on standard output.
  void expect_refused(const std::string& line, int code, const std::string& words) const {
    const Ended end = run(line);
    EXPECT_EQ(end.code, code) << line << "\n" << end.err;
    EXPECT_TRUE(contains(end.err, words));
    EXPECT_EQ(end.out, "");
  }
  std::filesystem::path dir() const { return place_ / "study"; }
  std::string out() const { return " --out " + dir().string(); }
  std::filesystem::path database() const { return dir() / "study.db"; }

  /// The first column of the first row of a query on the study's store, as text.
  std::string query(const std::string& sql) const {
    SQLite::Database store(database().string(), SQLite::OPEN_READONLY, 10000);
    return store.execAndGet(sql).getString();
  }
  int count(const std::string& condition) const {
    return std::stoi(query("SELECT count(*) FROM runs WHERE " + condition));
  }

  /// Waits until so many runs are done, at most a minute.
  void await_done(int runs) const {
    for (int i = 0; i < 6000; ++i) {
      if (std::filesystem::exists(database()) && count("status = 'done'") >= runs) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL() << "no " << runs << " runs within a minute";
  }

  std::filesystem::path place_;
};

}  // namespace drawpoint::test
