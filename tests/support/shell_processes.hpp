// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <drawpoint/doe/processes.hpp>
#include <drawpoint/tests/support/files.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Shell scripts as the processes of a pool, for tests of how children end.
namespace drawpoint::support {

/// What it prints goes to folder/out_ID.
inline doe::Process shell(const std::filesystem::path& folder, std::int64_t id, const std::string& script,
                          double time_limit = 0.0) {
  return {.id = id,
          .executable = "/bin/sh",
          .arguments = {"-c", script},
          .output = folder / ("out_" + std::to_string(id)),
          .time_limit = time_limit};
}

/// How each ended, by id.
inline std::map<std::int64_t, doe::ProcessEnd> run_all(const std::vector<doe::Process>& jobs, int at_once) {
  doe::ProcessPool pool(at_once);
  std::map<std::int64_t, doe::ProcessEnd> ends;
  std::size_t next = 0;
  while (next < jobs.size() || pool.running() > 0) {
    while (next < jobs.size() && !pool.full()) pool.start(jobs[next++]);
    EXPECT_LE(pool.running(), at_once);
    for (const auto& end : pool.wait(std::chrono::milliseconds(100))) ends[end.id] = end;
  }
  return ends;
}

}  // namespace drawpoint::support
