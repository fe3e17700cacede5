// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fronts/front.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/times.h>
#include <drawpoint/studies/say/live/standing.h>

#include <algorithm>

namespace drawpoint::studies {
namespace {

int unfinished(const Counts& counts) { return counts.of(Status::planned) + counts.of(Status::running); }

std::string runs_text(int runs) { return std::to_string(runs) + (runs == 1 ? " run" : " runs"); }

std::string adaptive_note(const Contents& contents, const Counts& counts) {
  if (counts.adaptive_points >= contents.sampling.points) return "";
  if (const StopNote& stopped = contents.sampling.stopped; !stopped.why.empty())
    return " The command that chose adaptive points stopped: " + stopped.why +
           "; to go on: " + stopped.go_on + ".";
  return " " + std::to_string(counts.adaptive_points) + " of " + std::to_string(contents.sampling.points) +
         " adaptive points are chosen.";
}

Standing working(const Contents& contents, const Counts& counts) {
  const int left = unfinished(counts);
  return {StandingKind::working,
          (left > 0 ? "A command is at work: " + runs_text(left) + " to go."
                    : "A command is at work: every planned run is made, and it fits models, chooses further "
                      "runs or writes the report.") +
              adaptive_note(contents, counts),
          ""};
}

Standing stopped(const Study& study, const Contents& contents, const Counts& counts, const Folder& folder) {
  std::string text = "No command of this machine is at work here, and " + runs_text(unfinished(counts)) +
                     (unfinished(counts) == 1 ? " is" : " are") + " still to be made.";
  if (counts.of(Status::running) > 0)
    text +=
        " Those that count as running were in flight when a command was stopped, or are being made from "
        "another machine.";
  return {StandingKind::stopped, text + adaptive_note(contents, counts),
          making_command(study) + out_option(folder)};
}

Standing ended(const Study& study, const Contents& contents, const Counts& counts, const Folder& folder) {
  const auto end = [&](const std::string& text, const std::string& command) {
    return Standing{StandingKind::ended,
                    "Every planned run has ended." + adaptive_note(contents, counts) + text,
                    command + out_option(folder)};
  };
  if (counts.of(Status::done) == 0)
    return end(" None has succeeded: mend what the failures below name, and make them again.",
               making_command(study) + " --retry-failed");
  if (counts.adaptive_points < contents.sampling.points && !contents.sampling.stopped.enough &&
      counts.of(Kind::confirmation, Status::done) == 0)
    return end(" Next: those that are left, unless the command says that no more are wanted.",
               making_command(study));
  if (!has_objective(contents.identity.problem)) return end(" Next: the report.", "report");
  if (contents.identity.simulator != study.simulator.name)
    return end(
        " No run can be added: another simulator made them, or one with fewer responses. Next: the report.",
        "report");
  const bool confirmed = counts.of(Kind::confirmation, Status::done) > 0;
  if (!confirmed)
    return end(" Next: simulate the points of the predicted front that a decision would rest on.",
               confirming_command(study));
  return end(" Next: the front, with its simulated points.", "front");
}

/// The first run of the command that works there began then; 0: none has.
std::time_t session_start(const std::vector<Run>& runs, std::time_t since) {
  const std::string earliest = utc_text(since);
  std::string first;
  for (const Run& run : runs) {
    if (run.kind == Kind::imported || run.started < earliest) continue;
    if (first.empty() || run.started < first) first = run.started;
  }
  return first.empty() ? 0 : time_of(first);
}

}  // namespace

std::string to_string(StandingKind kind) {
  switch (kind) {
    case StandingKind::absent:
      return "absent";
    case StandingKind::unreadable:
      return "unreadable";
    case StandingKind::working:
      return "working";
    case StandingKind::stopped:
      return "stopped";
    default:
      return "ended";
  }
}

Standing standing_of(const Study& study, const Folder& folder, const View& view) {
  if (!view.there)
    return {StandingKind::absent,
            "There is no study in " + folder.path.string() + " yet. This page waits until the command " +
                making_command(study) + " of " + study.name + " starts one there.",
            view.holder ? "" : making_command(study) + out_option(folder)};
  if (!view.trouble.empty())
    return {StandingKind::unreadable, "The study cannot be read at the moment: " + view.trouble, ""};
  if (!view.contents) return {StandingKind::unreadable, "The study has not been read yet.", ""};
  const Counts counts = count(view.contents->runs);
  if (view.holder) return working(*view.contents, counts);
  if (unfinished(counts) > 0) return stopped(study, *view.contents, counts, folder);
  return ended(study, *view.contents, counts, folder);
}

ProgressState progress_of(const View& view, std::time_t now) {
  const std::vector<Run>& runs = view.contents->runs;
  const Counts counts = count(runs);
  ProgressState state{.done = counts.of(Status::done) + counts.of(Status::failed),
                      .failed = counts.of(Status::failed),
                      .total = static_cast<int>(runs.size())};
  const std::time_t start = view.holder ? session_start(runs, view.holder->since) : 0;
  if (start == 0) return state;
  const std::string from = utc_text(start);
  state.session = static_cast<int>(std::count_if(runs.begin(), runs.end(), [&](const Run& run) {
    return has_ended(run) && run.kind != Kind::imported && run.started >= from;
  }));
  state.seconds = std::max(0.0, std::difftime(now, start));
  return state;
}

}  // namespace drawpoint::studies
