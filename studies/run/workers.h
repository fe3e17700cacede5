// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Who carries out the processes of runs: this machine, or a Slurm cluster.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/doe/processes.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace drawpoint::studies {

class Workers {
 public:
  virtual ~Workers() = default;
  virtual bool full() const = 0;
  virtual int running() const = 0;  ///< started, and not yet ended
  /// False where the system has no process for it, and others run: it can wait for their ends. Throws
  /// doe::NoProcess where none run.
  virtual bool start(const doe::Process& process) = 0;
  /// Ends that came since the last call; waits at most `patience` for the first. Those of the last call are
  /// taken as stored.
  virtual std::vector<doe::ProcessEnd> wait(std::chrono::milliseconds patience) = 0;
  /// How many tasks wait and why, as text; empty where there is nothing to say.
  virtual std::string standing() const = 0;
  /// The end of this process, given by the last wait(), does not count: it is made again when it is started
  /// again.
  virtual void discard(std::int64_t id) = 0;
  /// After a signal: processes here are ended, those of a cluster go on.
  virtual void leave() = 0;
  /// The study stops: what runs or waits is ended, on a cluster, too, and nothing of it counts.
  virtual void abandon() = 0;
  /// All ends are stored.
  virtual void finish() = 0;
};

/// Throws UsageError where runs of the folder are with Slurm and settings.execution.slurm is off, std::runtime_error
/// where there is no Slurm. Says through the descriptor where fewer processes run than were asked for.
std::unique_ptr<Workers> workers_for(const Folder& folder, const Settings& settings, int message_descriptor);

/// Names of the job arrays that runs of the folder belong to, with commas between; empty: none.
std::string arrays_of(const Folder& folder);

}  // namespace drawpoint::studies
