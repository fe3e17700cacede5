// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A log on the disk grows cycle by cycle: what is there stays as it is, and is read whenever the run ends.
#include <gtest/gtest.h>
#include <unistd.h>
#include <drawpoint/engine/loading/log/log_stream.hpp>

#include <drawpoint/tests/support/told.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

namespace fs = std::filesystem;

class Stream : public testing::Test {
 protected:
  Stream() {
    fs::create_directories(folder_);
    log_.signals.columns = {{"time", "s"}, {"cycle", "1"}};
  }
  ~Stream() override { fs::remove_all(folder_); }

  fs::path file() const { return folder_ / "run.h5"; }

  // Three samples, two frames and a rock that is new and moves.
  void do_cycle(int number) {
    for (int k = 0; k < 3; ++k) log_.signals.append_row(std::vector<double>{10.0 * number + k, 1.0 * number});
    CycleRecord cycle;
    cycle.number = number;
    cycle.loaded_mass = 1000 + number;
    log_.cycles.push_back(cycle);
    log_.scene.shapes.push_back(box({0.1 * number, 0.2, 0.3}));
    log_.scene.bodies.push_back({number - 1, "#808080", 1.0, "rock", 100.0 * number});
    const int frame = static_cast<int>(log_.scene.frames.size());
    for (int k = 0; k < 2; ++k) {
      log_.scene.frames.push_back({10.0 * number + k, number, "lift", 5.0 * k});
      log_.scene.knots.push_back({number - 1, frame + k, {1.0f * static_cast<float>(k), 2, 3, 1, 0, 0, 0}});
    }
    log_.numbers["present_mass"] = 100 - number;
    log_.message = "not finished: written after cycle " + std::to_string(number);
  }

  void expect_read(const LoadingLog& wanted) const {
    const LoadingLog read = read_log(file());
    EXPECT_EQ(read.completed, wanted.completed);
    EXPECT_EQ(read.message, wanted.message);
    EXPECT_EQ(read.numbers, wanted.numbers);
    EXPECT_EQ(read.signals.values, wanted.signals.values);
    ASSERT_EQ(read.cycles.size(), wanted.cycles.size());
    for (std::size_t k = 0; k < read.cycles.size(); ++k)
      EXPECT_EQ(read.cycles[k].loaded_mass, wanted.cycles[k].loaded_mass);
    EXPECT_EQ(read.scene.bodies.size(), wanted.scene.bodies.size());
    EXPECT_EQ(read.scene.shapes.size(), wanted.scene.shapes.size());
    EXPECT_EQ(read.scene.frames.size(), wanted.scene.frames.size());
    ASSERT_EQ(read.scene.knots.size(), wanted.scene.knots.size());
    for (std::size_t k = 0; k < read.scene.knots.size(); ++k) {
      EXPECT_EQ(read.scene.knots[k].frame, wanted.scene.knots[k].frame);
      EXPECT_EQ(read.scene.knots[k].pose, wanted.scene.knots[k].pose);
    }
  }

  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      std::ifstream in(entry.path(), std::ios::binary);
      all[entry.path().filename().string()] = std::string(std::istreambuf_iterator<char>(in), {});
    }
    return all;
  }

  fs::path folder_ = fs::temp_directory_path() / ("drawpoint_stream_" + std::to_string(::getpid()));
  LoadingLog log_;
};

TEST_F(Stream, IsReadAfterEachCycleAndNothingIsWrittenAgain) {
  LogStream stream(file());
  std::map<std::string, std::string> before;
  for (int cycle = 1; cycle <= 4; ++cycle) {
    do_cycle(cycle);
    stream.keep(log_);
    expect_read(log_);
    const auto now = contents();
    EXPECT_EQ(now.size(), static_cast<std::size_t>(cycle));
    for (const auto& [name, bytes] : before) EXPECT_EQ(now.at(name), bytes) << name;
    before = now;
  }
  EXPECT_TRUE(before.contains("run.h5.part0004"));
}

TEST_F(Stream, EndsAsTheFileThatWriteLogWrites) {
  LogStream stream(file());
  for (int cycle = 1; cycle <= 3; ++cycle) {
    do_cycle(cycle);
    stream.keep(log_);
  }
  log_.completed = true;
  log_.message.clear();
  stream.finish(log_);
  const auto streamed = contents();
  ASSERT_EQ(streamed.size(), 1u);
  write_log(file(), log_);
  EXPECT_EQ(contents(), streamed);
  expect_read(log_);
}

// A finished log, and a stream that begins, have nothing to do with what an earlier run left.
TEST_F(Stream, PartsOfAnotherRunAreNotRead) {
  LogStream killed(file());
  for (int cycle = 1; cycle <= 3; ++cycle) {
    do_cycle(cycle);
    killed.keep(log_);
  }
  const LoadingLog whole = log_;
  const auto parts = contents();
  write_log(file(), whole);
  EXPECT_EQ(contents().size(), parts.size());
  expect_read(whole);
  LogStream next(file());
  EXPECT_EQ(contents().size(), 1u) << "the log itself stays until there is a new one";
  expect_read(whole);
  log_ = {};
  log_.signals.columns = whole.signals.columns;
  do_cycle(1);
  next.keep(log_);
  expect_read(log_);
}

// What a killed run left, made one file.
TEST_F(Stream, PartsAreJoined) {
  LogStream killed(file());
  for (int cycle = 1; cycle <= 3; ++cycle) {
    do_cycle(cycle);
    killed.keep(log_);
  }
  join_parts(file());
  EXPECT_EQ(contents().size(), 1u);
  expect_read(log_);
  join_parts(file());
  expect_read(log_);
  join_parts(folder_ / "none.h5");
  EXPECT_EQ(contents().size(), 1u);
}

TEST_F(Stream, APartOfAnotherRunIsRefused) {
  LogStream stream(file());
  for (int cycle = 1; cycle <= 2; ++cycle) {
    do_cycle(cycle);
    stream.keep(log_);
  }
  const std::string untold = " does not go on with the log that it stands beside";
  fs::copy_file(part_path(file(), 2), part_path(file(), 3));
  support::expect_told<std::runtime_error>([&] { read_log(file()); }, {"run.h5.part0003" + untold});
  fs::remove(part_path(file(), 3));
  LoadingLog other = log_;
  other.texts["seed"] = "2";
  other.cycles.front().number = 3;
  write_log(part_path(file(), 3), other);
  support::expect_told<std::runtime_error>([&] { read_log(file()); }, {"run.h5.part0003" + untold});
}

TEST_F(Stream, ADamagedPartIsRefusedByItsName) {
  LogStream stream(file());
  for (int cycle = 1; cycle <= 2; ++cycle) {
    do_cycle(cycle);
    stream.keep(log_);
  }
  fs::resize_file(part_path(file(), 2), fs::file_size(part_path(file(), 2)) - 40);
  support::expect_told<std::runtime_error>([&] { read_log(file()); }, {"run.h5.part0002", "truncated"});
}

TEST_F(Stream, WithoutAPathNothingIsWritten) {
  LogStream stream{{}};
  do_cycle(1);
  stream.keep(log_);
  stream.finish(log_);
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
