// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the tests of studies share: a folder that goes away, a small problem, file contents.

#include <drawpoint/studies/run/store/identity.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <drawpoint/tests/support/files.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace drawpoint::studies::test {

class TestFolder {
 public:
  TestFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "drawpoint-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

using support::contents;

inline void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline doe::Problem two_by_two() {
  return {
      .variables = {{"alpha", "1", 0.2, 2.0}, {"lip", "m", -1.0, 3.0}},
      .responses = {{"production", "kg/s", doe::Goal::maximize}, {"spill", "1", doe::Goal::at_most, 0.25}}};
}

inline Identity identity(bool corners = false, int replicates = 1) {
  return {.study = "sample",
          .problem = two_by_two(),
          .seed = 18446744073709551557ull,
          .replicates = replicates,
          .corners = corners};
}

/// The text of the exception that f throws; the test fails if it throws nothing.
template <class F>
std::string complaint(const F& f) {
  try {
    f();
  } catch (const std::exception& e) {
    return e.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace drawpoint::studies::test
