// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// However a child ends, the pool says how, keeps its reply and its output, and leaves nothing running.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <drawpoint/tests/support/shell_processes.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

using std::chrono::milliseconds;

using support::contents;
using support::run_all;

class PoolTest : public testing::Test {
 protected:
  Process shell(std::int64_t id, const std::string& script, double time_limit = 0.0) {
    return support::shell(folder_, id, script, time_limit);
  }

  PoolTest() { std::filesystem::create_directories(folder_); }
  ~PoolTest() override { std::filesystem::remove_all(folder_); }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("processes_" + std::to_string(::getpid()));
};

TEST_F(PoolTest, RepliesReachTheRightRun) {
  std::vector<Process> jobs;
  for (int id = 1; id <= 20; ++id) jobs.push_back(shell(id, "printf reply-" + std::to_string(id) + " >&3"));
  const auto ends = run_all(jobs, 3);
  ASSERT_EQ(ends.size(), 20u);
  for (const auto& [id, end] : ends) {
    EXPECT_EQ(end.reply, "reply-" + std::to_string(id));
    EXPECT_EQ(describe(end), "ended with exit code 0");
  }
}

TEST_F(PoolTest, AReplyLargerThanAPipeArrivesWhole) {
  const auto ends = run_all({shell(1, "head -c 300000 /dev/zero | tr '\\0' x >&3")}, 1);
  EXPECT_EQ(ends.at(1).reply, std::string(300000, 'x'));
}

TEST_F(PoolTest, SaysHowAChildEnded) {
  const auto ends = run_all({shell(1, "exit 3"),
                             shell(2, "kill -SEGV $$"),
                             shell(3, "kill -ABRT $$"),
                             shell(4, "sleep 30", 0.1),
                             {.id = 5, .executable = "/no/such/program", .output = folder_ / "out_5"}},
                            5);
  EXPECT_EQ(describe(ends.at(1)), "ended with exit code 3");
  EXPECT_EQ(describe(ends.at(2)), "ended by signal SIGSEGV (Segmentation fault)");
  EXPECT_EQ(describe(ends.at(3)), "ended by signal SIGABRT (Aborted)");
  EXPECT_EQ(describe(ends.at(4)), "stopped after 0.1 s, its time limit");
  EXPECT_EQ(describe(ends.at(5)), "could not be started: No such file or directory");
}

// A shell's code for what it does not find is an end like any other, whatever was done before it.
TEST_F(PoolTest, StartingAndFailingAreToldApart) {
  const auto ends =
      run_all({shell(1, "echo worked; exit 127"), {.id = 2, .executable = "no-such-program"}}, 2);
  EXPECT_EQ(ends.at(1).not_started, "");
  EXPECT_EQ(describe(ends.at(1)), "ended with exit code 127, a shell's for a program that it does not find");
  EXPECT_EQ(ends.at(2).not_started, "No such file or directory (it is not in the PATH)");
}

TEST_F(PoolTest, SaysWhyAProgramCannotBeStarted) {
  const auto reason = [&](const std::string& text, std::filesystem::perms perms) {
    const std::filesystem::path program = folder_ / "program";
    std::ofstream(program) << text;
    std::filesystem::permissions(program, perms);
    return run_all({{.id = 1, .executable = program.string()}}, 1).at(1).not_started;
  };
  using std::filesystem::perms;
  EXPECT_EQ(reason("#!/bin/sh\n", perms::owner_read),
            "Permission denied (it may not be run; allow it with chmod +x)");
  EXPECT_EQ(
      reason("#!/no/such/interpreter -x\n", perms::owner_all),
      "No such file or directory (its interpreter /no/such/interpreter cannot be started: No such file or "
      "directory)");
  EXPECT_EQ(
      reason("#!/bin/sh\r\necho\r\n", perms::owner_all),
      "No such file or directory (the line that names its interpreter ends in a carriage return, as Windows "
      "writes lines; end them with line feeds alone)");
  EXPECT_EQ(run_all({{.id = 1, .executable = folder_.string()}}, 1).at(1).not_started,
            "Permission denied (it is a directory)");
  EXPECT_EQ(run_all({{.id = 1, .executable = "/bin/true", .output = folder_}}, 1).at(1).not_started,
            "Is a directory (the file for what it prints)");
}

TEST_F(PoolTest, APipeWithoutAReaderBlocksNobody) {
  const std::filesystem::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto ends = run_all({{.id = 1, .executable = "/bin/true", .output = pipe}}, 1);
  EXPECT_EQ(ends.at(1).not_started, "No such device or address (the file for what it prints)");
}

TEST_F(PoolTest, AReplyWithoutEndIsStopped) {
  const auto ends = run_all({shell(1, "cat /dev/zero >&3"), shell(2, "printf good >&3")}, 2);
  EXPECT_EQ(describe(ends.at(1)), "was stopped, for its reply is longer than 16 MiB");
  EXPECT_EQ(ends.at(1).reply, "");
  EXPECT_EQ(ends.at(2).reply, "good");
}

TEST_F(PoolTest, InputAndErrorsHaveTheirFiles) {
  std::ofstream(folder_ / "in") << "asked";
  Process process = shell(1, "cat; echo aside >&2");
  process.input = folder_ / "in";
  process.errors_apart = true;
  run_all({process}, 1);
  EXPECT_EQ(contents(folder_ / "out_1"), "asked");
}

TEST_F(PoolTest, ChildrenHaveOneThreadAndNoTerminal) {
  const auto ends = run_all({shell(1, "printf $OMP_NUM_THREADS >&3; cat >&3")}, 1);
  EXPECT_EQ(ends.at(1).reply, "1");
}

// With the owner killed nobody is left to wait for it: the reaper sees it at once, or within half a second
// where somebody else holds a copy of its socket. Five seconds are for a busy machine.
TEST_F(PoolTest, WhatChildrenStartedDiesWithAnOwnerThatWasKilled) {
  const std::filesystem::path grandchild = folder_ / "orphan";
  const pid_t owner = fork();
  if (owner == 0) {
    try {
      ProcessPool pool(1);
      pool.start(shell(1, "sleep 60 & echo $! > " + grandchild.string() + "; wait"));
      if (fork() == 0) {  // holds a copy of all
        std::this_thread::sleep_for(std::chrono::seconds(5));
        _exit(0);
      }
      for (;;) pause();
    } catch (...) {
    }
    _exit(1);
  }
  for (int i = 0; i < 1000 && contents(grandchild).find('\n') == std::string::npos; ++i)
    std::this_thread::sleep_for(milliseconds(5));
  const pid_t pid = std::stoi(contents(grandchild));
  ASSERT_EQ(kill(pid, 0), 0);
  kill(owner, SIGKILL);
  waitpid(owner, nullptr, 0);
  const auto runs = [&] {  // a zombie, whose parent is slow, has ended
    const std::string stat = contents("/proc/" + std::to_string(pid) + "/stat");
    return !stat.empty() && stat.find(") Z") == std::string::npos;
  };
  for (int i = 0; i < 500 && runs(); ++i) std::this_thread::sleep_for(milliseconds(10));
  EXPECT_FALSE(runs());
}

// The pool ends although a process that was forked from its owner lives on.
TEST_F(PoolTest, EndsBesideACopyOfItsOwner) {
  const auto start = std::chrono::steady_clock::now();
  pid_t copy = 0;
  {
    ProcessPool pool(1);
    copy = fork();
    if (copy == 0) {
      std::this_thread::sleep_for(std::chrono::seconds(20));
      _exit(0);
    }
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  kill(copy, SIGKILL);
  waitpid(copy, nullptr, 0);
}

// Whoever stops processes of a study by name may stop the one that watches over the others.
TEST_F(PoolTest, EndsBesideAStoppedWatch) {
  const pid_t owner = fork();
  if (owner == 0) {
    {
      ProcessPool pool(1);
      const std::string own = std::to_string(getpid());
      kill(std::stoi(contents("/proc/" + own + "/task/" + own + "/children")), SIGSTOP);
    }
    _exit(0);
  }
  int status = -1;
  for (int i = 0; i < 1000 && waitpid(owner, &status, WNOHANG) == 0; ++i)
    std::this_thread::sleep_for(milliseconds(10));
  EXPECT_EQ(status, 0) << "the owner still waits after 10 s";
  if (status == 0) return;
  const std::string child =
      contents("/proc/" + std::to_string(owner) + "/task/" + std::to_string(owner) + "/children");
  kill(std::stoi(child), SIGKILL);
  waitpid(owner, nullptr, 0);
}

TEST_F(PoolTest, WithoutAFileChildrenPrintWhereTheOwnerDoes) {
  testing::internal::CaptureStdout();
  Process process = shell(1, "echo here");
  process.output.clear();
  run_all({process}, 1);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "here\n");
}

/// Also a program that the child has started ends with it, and a child that ignores SIGTERM.
TEST_F(PoolTest, TerminateLeavesNothingRunning) {
  const auto start = std::chrono::steady_clock::now();
  {
    ProcessPool pool(2);
    pool.start(shell(1, "sleep 60 & echo $! > " + (folder_ / "grandchild").string() + "; wait"));
    pool.start(shell(2, "trap '' TERM; echo ready > " + (folder_ / "stubborn").string() +
                            "; while true; do sleep 0.05; done"));
    while (contents(folder_ / "grandchild").empty() || contents(folder_ / "stubborn").empty()) {
      std::this_thread::sleep_for(milliseconds(5));
    }
    pool.terminate(milliseconds(100));
    EXPECT_EQ(pool.running(), 0);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  const pid_t grandchild = std::stoi(contents(folder_ / "grandchild"));
  const auto gone = [&] {
    const std::string state = contents("/proc/" + std::to_string(grandchild) + "/stat");
    return kill(grandchild, 0) != 0 || state.find(") Z ") != std::string::npos;
  };
  for (int i = 0; i < 400 && !gone(); ++i)
    std::this_thread::sleep_for(milliseconds(5));  // the kernel delivers when it can
  EXPECT_TRUE(gone());
}

TEST_F(PoolTest, WhatAChildPrintsIsKeptUnlessItIsNothing) {
  run_all({shell(1, "echo before the end; echo more >&2; kill -SEGV $$"), shell(2, "kill -SEGV $$")}, 1);
  EXPECT_EQ(contents(folder_ / "out_1"), "before the end\nmore\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out_2"));
}

}  // namespace
