// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/runs/interrupt.h>
#include <drawpoint/studies/runs/one_process.h>

#include <chrono>
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

}  // namespace drawpoint::studies
