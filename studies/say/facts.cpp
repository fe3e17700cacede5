// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fronts/confirmations.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/progress.h>
#include <drawpoint/studies/run/store/option_values.h>
#include <drawpoint/studies/say/facts.h>
#include <drawpoint/studies/say/versions.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <thread>

namespace drawpoint::studies {
namespace {

/// The text after the first "key<separator>" of a file of such lines, without quotes; "unknown" if there is
/// none.
std::string entry(const char* file, const std::string& key, char separator) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    const auto at = line.find(separator);
    if (at == std::string::npos) continue;
    std::string value;
    for (const char c : line.substr(at + 1)) {
      if (c != '"' && !(c == ' ' && value.empty())) value += c;
    }
    return value;
  }
  return "unknown";
}

std::string machine() {
  return entry("/proc/cpuinfo", "model name", ':') + ", " +
         std::to_string(std::thread::hardware_concurrency()) + " threads";
}

std::string system_name() {
  utsname name = {};
  const std::string kernel = uname(&name) == 0 ? std::string(", ") + name.sysname + " " + name.release : "";
  return entry("/etc/os-release", "PRETTY_NAME", '=') + kernel;
}

std::string time_span(const std::vector<Run>& runs) {
  std::string first, last;
  for (const auto& run : runs) {
    if (run.finished.empty()) continue;
    if (first.empty() || run.started < first) first = run.started;
    if (run.finished > last) last = run.finished;
  }
  return first.empty() ? "none" : first + " to " + last;
}

std::string time_in_runs(const std::vector<Run>& runs) {
  double seconds = 0.0;
  int finished = 0;
  for (const auto& run : runs) {
    seconds += run.seconds;
    if (!run.finished.empty()) ++finished;
  }
  if (finished == 0) return "none";
  return duration_text(seconds) + " in all, " + duration_text(seconds / finished) + " per run";
}

std::string design(const Store& store, const std::vector<Run>& runs) {
  const Identity& identity = store.identity();
  std::string text = std::to_string(count_points(runs, Kind::training)) + " training points, Latin hypercube";
  if (identity.corners) text += " with the corners of the box";
  if (identity.replicates > 1) text += ", " + std::to_string(identity.replicates) + " runs each";
  if (const int more = count_points(runs, Kind::adaptive); more > 0)
    text += "; " + std::to_string(more) + " adaptive points, the last by " + store.sampling().criteria;
  if (const int more = count_points(runs, Kind::confirmation); more > 0)
    text += "; " + std::to_string(more) + " points of predicted fronts";
  if (const int more = count_points(runs, Kind::imported); more > 0)
    text += "; " + std::to_string(more) + " points made elsewhere";
  return text + "; " + std::to_string(count_points(runs, Kind::validation)) + " validation points, uniform";
}

}  // namespace

void add_options(const Identity& identity, std::vector<std::pair<std::string, std::string>>& all) {
  std::string options;
  for (const auto& [name, value] : identity.options)
    options += (options.empty() ? "--" : ", --") + name + " " + value;
  if (!options.empty()) all.emplace_back("Options", options);
  if (!identity.simulator.empty()) all.emplace_back("Simulator", identity.simulator);
}

std::vector<std::pair<std::string, std::string>> facts(const Study& study, const Store& store,
                                                       const std::vector<Run>& runs) {
  const Identity& identity = store.identity();
  std::vector<std::pair<std::string, std::string>> all = {{"Design", design(store, runs)},
                                                          {"Seed", std::to_string(identity.seed)}};
  if (const std::string typed = typed_options(study.options, study.presets, identity.options); !typed.empty())
    all.emplace_back("Options that differ from the defaults", typed);
  add_options(identity, all);
  const Sampling& sampling = store.sampling();
  if (!sampling.until.empty()) all.emplace_back("Until", sampling.until);
  if (const StopNote& stopped = sampling.stopped; !stopped.why.empty())
    all.emplace_back("Stopped", stopped.why + "; to go on: " + stopped.go_on);
  all.insert(all.end(), {{"Runs made", time_span(runs)},
                         {"Time in runs", time_in_runs(runs)},
                         {"Machine", machine()},
                         {"System", system_name()},
                         {"Program", program_version()}});
  const CheckedRuns adaptive = check_predictions(runs, identity.problem, Kind::adaptive);
  if (!adaptive.runs.empty())
    all.emplace_back("Adaptive runs, predicted before they were made", text(adaptive));
  return all;
}

}  // namespace drawpoint::studies
