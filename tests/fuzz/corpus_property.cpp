// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What the fuzz targets were begun with, and what they once found, is taken or refused.

#include <gtest/gtest.h>

#include <drawpoint/tests/fuzz/readers.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

using namespace drawpoint;

namespace {

std::string bytes_in(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(FuzzCorpus, IsTakenOrRefusedByEachReader) {
  for (const auto& [name, read] : fuzz::readers) {
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(FUZZ_CORPUS) / name)) {
      SCOPED_TRACE(entry.path().string());
      const std::string bytes = bytes_in(entry.path());
      EXPECT_NO_THROW(read({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}));
      ++files;
    }
    EXPECT_GE(files, 3) << name;
  }
}

}  // namespace
