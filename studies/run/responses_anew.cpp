// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/responses_anew.h>
#include <drawpoint/studies/run/store/option_values.h>
#include <drawpoint/studies/run/store/run_logs.h>
#include <drawpoint/doe/black_box.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

/// A run that came back with values must have its log, or they were lost without a word.
std::string runs_without_log(const Folder& from, const std::vector<Run>& runs) {
  std::string text;
  for (const Run& run : runs) {
    if (run.kind == Kind::imported || !has_ended(run)) continue;
    const LogState state = log_state(from, run);
    const bool should_be_there = run.status == Status::done || !run.log.empty();
    const bool lost = state == LogState::other || (state == LogState::none && should_be_there);
    if (lost) text += (text.empty() ? "" : ", ") + std::to_string(run.id);
  }
  return text;
}

void take_anew(const Study& study, const Folder& from, const OptionValues& options, Run& run) {
  if (run.kind == Kind::imported) {
    run.status = Status::failed;
    run.reason = "imported: there is no log to take its responses from";
    return;
  }
  if (run.log.empty()) return;  // failed before it wrote one
  const doe::Outcome outcome = doe::detail::checked(
      doe::detail::guarded<doe::Outcome>([&] { return study.logs.responses(from.log(run.id), options); }),
      study.problem);
  if (outcome.failed() && run.status == Status::failed) return;  // what it failed of then says more
  run.status = outcome.failed() ? Status::failed : Status::done;
  run.reason = outcome.failed() ? outcome.reason() : "";
  if (!outcome.failed()) run.y = outcome.values();
}

}  // namespace

void require_same_simulation(const Study& study, const Identity& from, const OptionValues& given) {
  std::string other;
  if (from.study != study.name) other = "it is of the study \"" + from.study + "\"";
  doe::Problem simulated = study.problem;
  simulated.responses = from.problem.responses;
  if (other.empty()) other = difference(from.problem, simulated);
  std::vector<StudyOption> options;
  OptionValues stored = with_later_ones(study.options, from.options), asked = given;
  for (const StudyOption& option : study.options) {
    if (!option.of_responses) {
      options.push_back(option);
      continue;
    }
    stored.erase(option.name);
    asked.erase(option.name);
  }
  if (other.empty()) other = difference(stored, asked, true);
  if (other.empty()) other = difference(stored, with_defaults(options, stored), false);
  if (!other.empty())
    throw UsageError("rerun-responses: the runs of --from cannot be those of this study: " + other);
}

OptionValues options_anew(const Study& study, const Identity& from, const OptionValues& given) {
  OptionValues options = with_later_ones(study.options, from.options);
  for (const StudyOption& option : study.options)
    if (option.of_responses) options.erase(option.name);
  options.insert(given.begin(), given.end());
  return with_defaults(study.options, options);
}

std::vector<Run> runs_with_responses_anew(const Study& study, const Folder& from,
                                          const std::vector<Run>& runs, const OptionValues& options) {
  if (const std::string lost = runs_without_log(from, runs); !lost.empty())
    throw std::runtime_error("rerun-responses: no sound log of run " + lost + " in " + from.logs().string() +
                             "; bring it back, or make it again with the program as it was when the folder "
                             "was made: evaluate --run N "
                             "--out " +
                             from.path.string() + " --log FILE, with the name that the others there have");
  std::vector<Run> anew = runs;
  const std::int64_t adaptive = count_points(runs, Kind::adaptive);
  for (Run& run : anew) {
    run.y.resize(0);
    run.predicted.resize(0);
    run.lower.resize(0);
    run.upper.resize(0);
    if (run.status == Status::running) run.status = Status::planned;
    if (run.kind == Kind::confirmation) {
      run.kind = Kind::adaptive;
      run.point += adaptive;
    }
    if (has_ended(run)) take_anew(study, from, options, run);
  }
  return anew;
}

void bring_files(const Folder& from, const Folder& to, const std::vector<Run>& runs) {
  fs::create_directories(to.logs());
  for (const Run& run : runs)
    if (!run.log.empty()) link_or_copy(from.log(run.id), to.log(run.id));
  if (!fs::exists(from.shared())) return;
  for (const auto& entry : fs::recursive_directory_iterator(from.shared())) {
    const fs::path there = to.shared() / fs::relative(entry.path(), from.shared());
    fs::create_directories(entry.is_directory() ? there : there.parent_path());
    if (entry.is_regular_file()) link_or_copy(entry.path(), there);
  }
  if (fs::exists(from.shared_checksums())) fs::copy_file(from.shared_checksums(), to.shared_checksums());
}

}  // namespace drawpoint::studies
