// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/runs/interrupt.h>
#include <drawpoint/studies/runs/workers.h>
#include <drawpoint/doe/slurm_jobs.hpp>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <thread>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

int cores() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

class LocalWorkers : public Workers {
 public:
  explicit LocalWorkers(int jobs) : pool_(jobs) {}
  bool full() const override { return pool_.full(); }
  int running() const override { return pool_.running(); }
  void start(const doe::Process& process) override { pool_.start(process); }
  std::vector<doe::ProcessEnd> wait(milliseconds patience) override { return pool_.wait(patience); }
  std::string standing() const override { return ""; }
  void discard(std::int64_t) override {}
  void leave() override { pool_.terminate(time_to_end); }
  void finish() override {}

 private:
  doe::ProcessPool pool_;
};

class SlurmWorkers : public Workers {
 public:
  SlurmWorkers(const Folder& folder, const Settings& settings)
      : folder_(folder.slurm()),
        jobs_({.folder = folder_, .at_once = settings.jobs.value_or(0), .options = settings.slurm_options}) {}
  bool full() const override { return false; }
  int running() const override { return jobs_.running(); }
  void start(const doe::Process& process) override { jobs_.start(process); }
  std::vector<doe::ProcessEnd> wait(milliseconds patience) override { return jobs_.wait(patience); }
  std::string standing() const override { return jobs_.standing(); }
  void discard(std::int64_t id) override { jobs_.discard(id); }
  void leave() override {}
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

std::unique_ptr<Workers> workers_for(const Folder& folder, const Settings& settings) {
  if (settings.slurm) return std::make_unique<SlurmWorkers>(folder, settings);
  if (const std::string arrays = arrays_of(folder); !arrays.empty())
    throw UsageError("studies: runs of " + folder.path.string() + " are with Slurm (" + arrays +
                     "); go on with --slurm, or end them with scancel --name=NAME for each and remove " +
                     folder.slurm().string());
  return std::make_unique<LocalWorkers>(settings.jobs.value_or(cores()));
}

std::string arrays_of(const Folder& folder) {
  std::error_code none;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.slurm(), none))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

}  // namespace drawpoint::studies
