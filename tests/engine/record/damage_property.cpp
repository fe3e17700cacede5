// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// No damage goes unseen and no failure leaves half a file: truncation at every scale, flipped bits anywhere,
// foreign files, a full disk.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <drawpoint/engine/record/file.hpp>
#include <filesystem>
#include <fstream>
#include <stdexcept>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::record;

namespace {

namespace fs = std::filesystem;

const FileKind kind{"drawpoint test file", 3};

class RecordDamage : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file(const std::string& name = "file.h5") const { return folder_ / name; }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("drawpoint_damage_" + std::to_string(::getpid()));
};

// Numbers without pattern, so that hardly a byte of the file is idle.
std::vector<double> rough_numbers(std::size_t count) {
  std::vector<double> values(count);
  std::uint64_t state = 1;
  for (double& value : values) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    value = static_cast<double>(state >> 11);
  }
  return values;
}

void write_example(const fs::path& path, std::size_t count = 2000) {
  const std::vector<double> values = rough_numbers(count);
  Writer writer(path, kind);
  writer.text("about", "machine", "LH621 class");
  writer.number("about", "mass", 57000);
  writer.array("data/values", std::span<const double>(values));
  writer.commit();
}

// Everything that the example holds, or the reason why not.
std::string read_example(const fs::path& path) {
  try {
    const Reader reader(path, kind);
    const bool right = reader.text("about", "machine") == "LH621 class" &&
                       reader.number("about", "mass") == 57000 &&
                       reader.doubles("data/values").values == rough_numbers(2000);
    return right ? "right" : "wrong";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

void put_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST_F(RecordDamage, ATruncatedFileIsRefused) {
  write_example(file());
  const std::string whole = bytes_of(file());
  ASSERT_EQ(read_example(file()), "right");
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 97) {
    put_bytes(file("short.h5"), whole.substr(0, length));
    const std::string told = read_example(file("short.h5"));
    EXPECT_NE(told.find("short.h5"), std::string::npos) << length;
    EXPECT_TRUE(told.find("truncated") != told.npos || told.find("empty") != told.npos ||
                told.find("not an HDF5 file") != told.npos)
        << length << ": " << told;
  }
}

TEST_F(RecordDamage, AFlippedBitIsSeen) {
  write_example(file());
  const std::string whole = bytes_of(file());
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 311) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
    put_bytes(file("flipped.h5"), flipped);
    EXPECT_NE(read_example(file("flipped.h5")).find("flipped.h5"), std::string::npos) << "byte " << at;
  }
  put_bytes(file("longer.h5"), whole + '\0');
  EXPECT_NE(read_example(file("longer.h5")).find("longer.h5"), std::string::npos);
}

TEST_F(RecordDamage, ForeignFilesAreNamed) {
  put_bytes(file("notes.txt"), "production 550 kg/s\n");
  EXPECT_EQ(read_example(file("notes.txt")), "record::Reader: \"" + file("notes.txt").string() +
                                                 "\" is not an HDF5 file; give a file that Drawpoint wrote");
  EXPECT_NE(read_example(file("missing.h5")).find("No such file"), std::string::npos);
  EXPECT_NE(read_example(folder()).find("cannot be opened"), std::string::npos);
  Writer other(file("pile.h5"), {"drawpoint settled pile", 3});
  other.commit();
  EXPECT_NE(read_example(file("pile.h5")).find("is a drawpoint settled pile, not a drawpoint test file"),
            std::string::npos);
  Writer newer(file("newer.h5"), {kind.format, 4});
  newer.commit();
  EXPECT_NE(read_example(file("newer.h5")).find("has version 4 of its format, not 3"), std::string::npos);
}

// A limit on the size of files acts as a full disk does: write(2) fails part of the way.
TEST_F(RecordDamage, AFullDiskLeavesTheOldFile) {
  write_example(file());
  const std::string before = bytes_of(file());
  rlimit old_limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{8192, old_limit.rlim_max};
  std::string told;
  setrlimit(RLIMIT_FSIZE, &small);
  try {
    write_example(file(), 50000);
  } catch (const std::runtime_error& error) {
    told = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(told.find("cannot write"), std::string::npos) << told;
  EXPECT_NE(told.find("check the folder and the free space"), std::string::npos);
  EXPECT_EQ(bytes_of(file()), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder()), {}), 1);
}

TEST_F(RecordDamage, AMissingFolderIsNamed) {
  try {
    write_example(folder() / "nowhere" / "file.h5");
    FAIL() << "a file in a missing folder was written";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos);
  }
  EXPECT_TRUE(fs::is_empty(folder()));
}

TEST_F(RecordDamage, ATargetThatIsAFolderIsKept) {
  fs::create_directories(file("taken.h5") / "inside");
  EXPECT_THROW(write_example(file("taken.h5")), std::runtime_error);
  EXPECT_TRUE(fs::exists(file("taken.h5") / "inside"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder()), {}), 1);
}

}  // namespace
