// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/run/store/joined.h>
#include <drawpoint/studies/run/workers.h>
#include <sys/resource.h>
#include <drawpoint/doe/slurm_jobs.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <thread>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

int cores() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

/// File descriptors that this process needs beside those of its children: store, logs, page, standard ones.
constexpr rlim_t own_descriptors = 64;

/// Jobs that the limit on open files leaves room for, which is raised as far as it goes: one per job.
int most_jobs(int wanted) {
  rlimit limit = {};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return wanted;
  const rlim_t needed = own_descriptors + static_cast<rlim_t>(wanted);
  if (limit.rlim_cur < needed) {
    limit.rlim_cur = std::min(needed, limit.rlim_max);
    setrlimit(RLIMIT_NOFILE, &limit);
  }
  if (limit.rlim_cur >= needed) return wanted;
  return limit.rlim_cur > own_descriptors ? static_cast<int>(limit.rlim_cur - own_descriptors) : 1;
}

class LocalWorkers : public Workers {
 public:
  LocalWorkers(int jobs, int message_descriptor)
      : most_(most_jobs(jobs)), messages_(message_descriptor), pool_(most_) {
    if (most_ < jobs) say("this system's limit on open files leaves room for");
  }
  bool full() const override { return pool_.running() >= most_; }
  int running() const override { return pool_.running(); }
  bool start(const doe::Process& process) override {
    try {
      pool_.start(process);
      return true;
    } catch (const doe::NoProcess& e) {
      if (pool_.running() == 0) throw;
      most_ = pool_.running();
      say(std::string(e.what()) + ": going on with");
      return false;
    }
  }
  std::vector<doe::ProcessEnd> wait(milliseconds patience) override { return pool_.wait(patience); }
  std::string standing() const override { return ""; }
  void discard(std::int64_t) override {}
  void leave() override { pool_.terminate(time_to_end); }
  void abandon() override { leave(); }
  void finish() override {}

 private:
  void say(const std::string& why) const { dprintf(messages_, "%s %d runs at a time\n", why.c_str(), most_); }

  int most_, messages_;
  doe::ProcessPool pool_;
};

class SlurmWorkers : public Workers {
 public:
  SlurmWorkers(const Folder& folder, const Settings& settings)
      : folder_(folder.slurm()),
        jobs_({.folder = folder_,
               .at_once = settings.execution.jobs.value_or(0),
               .per_array = settings.execution.slurm_array,
               .options = settings.execution.slurm_options}) {}
  bool full() const override { return false; }
  int running() const override { return jobs_.running(); }
  bool start(const doe::Process& process) override {
    jobs_.start(process);
    return true;
  }
  std::vector<doe::ProcessEnd> wait(milliseconds patience) override { return jobs_.wait(patience); }
  std::string standing() const override { return jobs_.standing(); }
  void discard(std::int64_t id) override { jobs_.discard(id); }
  void leave() override {}
  void abandon() override {
    jobs_.cancel();
    finish();
  }
  void finish() override {
    jobs_.forget();
    std::error_code ignored;
    fs::remove(folder_, ignored);  // empty now
  }

 private:
  fs::path folder_;
  doe::SlurmJobs jobs_;
};

}  // namespace

std::unique_ptr<Workers> workers_for(const Folder& folder, const Settings& settings, int message_descriptor) {
  if (settings.execution.slurm) return std::make_unique<SlurmWorkers>(folder, settings);
  if (const std::string arrays = arrays_of(folder); !arrays.empty())
    throw UsageError("studies: runs of " + folder.path.string() + " are with Slurm (" + arrays +
                     "); go on with --slurm, or end them with scancel --name=NAME for each and remove " +
                     folder.slurm().string());
  return std::make_unique<LocalWorkers>(settings.execution.jobs.value_or(cores()), message_descriptor);
}

std::string arrays_of(const Folder& folder) {
  std::error_code none;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.slurm(), none))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return joined(names, std::identity{}, ",");
}

}  // namespace drawpoint::studies
