// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A snapshot file gives back its bytes, or says what is wrong with it: cut at every byte, each byte flipped.
#include <gtest/gtest.h>
#include <unistd.h>

#include <drawpoint/engine/record/snapshot_file.hpp>
#include <filesystem>
#include <fstream>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::record;

namespace {

std::vector<std::byte> some_state() {
  std::vector<std::byte> state(300);
  for (std::size_t k = 0; k < state.size(); ++k) state[k] = static_cast<std::byte>(k * 37 + 11);
  return state;
}

std::string told(std::span<const std::byte> file) {
  try {
    const auto state = engine::record::detail::unwrapped_snapshot(file, "run.snapshot");
    const auto expected = some_state();
    return std::equal(state.begin(), state.end(), expected.begin(), expected.end()) ? "right" : "wrong";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(SnapshotFile, GivesBackWhatWasWritten) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("drawpoint_snapshot_" + std::to_string(::getpid()));
  write_snapshot(path, some_state());
  EXPECT_EQ(read_snapshot(path), some_state());
  write_snapshot(path, {});
  EXPECT_TRUE(read_snapshot(path).empty());
  std::filesystem::remove(path);
  EXPECT_THROW(read_snapshot(path), std::runtime_error);
}

TEST(SnapshotFile, SeesEveryCutAndEveryFlippedByte) {
  const std::vector<std::byte> file = engine::record::detail::wrapped_snapshot(some_state());
  ASSERT_EQ(told(file), "right");
  for (std::size_t length = 0; length < file.size(); ++length) {
    const std::string what = told(std::span(file).first(length));
    EXPECT_NE(what.find("run.snapshot"), std::string::npos) << length << ": " << what;
  }
  for (std::size_t at = 0; at < file.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      std::vector<std::byte> flipped = file;
      flipped[at] ^= static_cast<std::byte>(1 << bit);
      EXPECT_NE(told(flipped).find("run.snapshot"), std::string::npos) << "byte " << at << " bit " << bit;
    }
  std::vector<std::byte> longer = file;
  longer.push_back(std::byte{0});
  EXPECT_NE(told(longer).find("cut or was added to"), std::string::npos);
}

}  // namespace
