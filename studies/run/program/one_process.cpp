// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/run/program/one_process.h>

#include <chrono>
#include <filesystem>
#include <system_error>
#include <vector>

namespace drawpoint::studies {

doe::ProcessEnd end_of(const doe::Process& process) {
  doe::ProcessPool pool(1);
  pool.start(process);
  std::vector<doe::ProcessEnd> ends;
  while (ends.empty()) {
    if (InterruptGuard::requested()) {
      pool.terminate(time_to_end);
      throw Interrupted{};
    }
    ends = pool.wait(std::chrono::milliseconds(100));
  }
  return ends.front();
}

doe::ProcessEnd end_on_cluster(const doe::Process& process, const doe::SlurmOptions& options) {
  doe::SlurmJobs jobs(options);
  jobs.start(process);
  std::vector<doe::ProcessEnd> ends;
  const auto leave = [&] {
    jobs.forget();
    std::error_code ignored;
    std::filesystem::remove(options.folder, ignored);  // empty now
  };
  while (ends.empty()) {
    if (InterruptGuard::requested()) {
      jobs.cancel();
      leave();
      throw Interrupted{};
    }
    ends = jobs.wait(std::chrono::milliseconds(100));
  }
  leave();
  return ends.front();
}

}  // namespace drawpoint::studies
