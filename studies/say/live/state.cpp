// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/run_noise.h>
#include <drawpoint/studies/run/program/printed_text.h>
#include <drawpoint/studies/run/store/times.h>
#include <drawpoint/studies/say/live/best.h>
#include <drawpoint/studies/say/live/standing.h>
#include <drawpoint/studies/say/live/state.h>
#include <drawpoint/studies/say/number_or_null.h>
#include <drawpoint/studies/say/page/data.h>

#include <algorithm>
#include <map>
#include <utility>

namespace drawpoint::studies {
namespace {

using nlohmann::ordered_json;

ordered_json list_of(const Eigen::VectorXd& values) {
  ordered_json list = ordered_json::array();
  for (const double value : values) list.push_back(number_or_null(value));
  return list;
}

ordered_json responses_of(const Run& run) {
  return run.status == Status::done ? list_of(run.y) : ordered_json();
}

ordered_json row_of(const Run& run) { return {run.id, name_of(run.kind), list_of(run.x), responses_of(run)}; }

/// Texts of programs may be long.
std::string shortened(const std::string& text) {
  return text.size() <= longest_reason ? text : text.substr(0, longest_reason) + " ...";
}

ordered_json counts_json(const Counts& counts) {
  ordered_json kinds = ordered_json::object();
  for (const Kind kind : all_kinds) {
    for (const Status status : all_states) kinds[name_of(kind)][name_of(status)] = counts.of(kind, status);
  }
  return kinds;
}

ordered_json reached_json(const Contents& contents) {
  ordered_json all = ordered_json::array();
  const std::vector<Reached> responses = reached(contents);
  for (std::size_t j = 0; j < responses.size(); ++j) {
    const Reached& of = responses[j];
    ordered_json improvements = ordered_json::array(), best, error;
    for (const Improvement& each : of.improvements) {
      const Run& run = contents.runs[each.run];
      improvements.push_back({each.ended, run.id, number_or_null(run.y[static_cast<Eigen::Index>(j)])});
    }
    if (!of.improvements.empty()) {
      const Run& run = contents.runs[of.improvements.back().run];
      best = row_of(run);
      error = number_or_null(told_error(contents.identity.problem, j, run.y));
    }
    all.push_back({{"lowest", number_or_null(of.lowest)},
                   {"highest", number_or_null(of.highest)},
                   {"done", of.done},
                   {"within", of.within},
                   {"improvements", std::move(improvements)},
                   {"best", std::move(best)},
                   {"best_error", std::move(error)}});
  }
  return all;
}

/// The most frequent first.
std::vector<std::pair<std::string, int>> failures_of(const Counts& counts) {
  std::vector<std::pair<std::string, int>> all(counts.failures.begin(), counts.failures.end());
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return all;
}

void add_failures(ordered_json& state, const Contents& contents, const Counts& counts) {
  std::map<std::string, std::int64_t> last;
  for (const std::size_t i : contents.ended) {
    const Run& run = contents.runs[i];
    if (run.status == Status::failed) last[without_log_name(run.reason)] = run.id;
  }
  const auto failures = failures_of(counts);
  const std::size_t shown = std::min(failures.size(), most_failures);
  state["failures"] = ordered_json::array();
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& [reason, times] = failures[i];
    state["failures"].push_back(
        {{"reason", shortened(reason)}, {"times", times}, {"run", last[without_log_name(reason)]}});
  }
  state["more_failures"] = failures.size() - shown;
}

ordered_json running_json(const std::vector<Run>& runs) {
  ordered_json all = ordered_json::array();
  for (const Run& run : runs) {
    if (run.status != Status::running || all.size() == most_running) continue;
    all.push_back(
        {{"run", run.id}, {"kind", name_of(run.kind)}, {"x", list_of(run.x)}, {"started", run.started}});
  }
  return all;
}

ordered_json last_json(const Contents& contents) {
  if (contents.ended.empty()) return {};
  const Run& run = contents.runs[contents.ended.back()];
  return {{"run", run.id},           {"kind", name_of(run.kind)},       {"x", list_of(run.x)},
          {"y", responses_of(run)},  {"reason", shortened(run.reason)}, {"seconds", run.seconds},
          {"finished", run.finished}};
}

/// The last run that ended and wrote a log.
ordered_json logged_run(const Study& study, const Contents& contents) {
  if (!study.presentation.illustrate) return {};
  for (auto i = contents.ended.rbegin(); i != contents.ended.rend(); ++i)
    if (!contents.runs[*i].log.empty()) return contents.runs[*i].id;
  return {};
}

void add_rows(ordered_json& state, const Contents& contents, const Kept& kept) {
  const std::string epoch = std::to_string(contents.epoch);
  const std::size_t count = contents.ended.size();
  const std::size_t from = kept.epoch == epoch ? std::min(kept.since, count) : 0;
  state["epoch"] = epoch;
  state["from"] = from;
  state["rows"] = ordered_json::array();
  for (std::size_t k = from; k < std::min(count, from + most_rows); ++k)
    state["rows"].push_back(row_of(contents.runs[contents.ended[k]]));
  state["ended"] = count;
}

void add_progress(ordered_json& state, const View& view, const Counts& counts, std::time_t now) {
  const ProgressState progress = progress_of(view, now);
  const double rate = rate_of(progress);
  state["total"] = progress.total;
  state["counts"] = counts_json(counts);
  state["progress"] = progress_text(progress);
  state["runs_per_hour"] = rate > 0.0 ? ordered_json(3600.0 * rate) : ordered_json();
  state["seconds_left"] = rate > 0.0 ? ordered_json(seconds_left(progress)) : ordered_json();
  state["left"] = rate > 0.0 ? ordered_json(duration_text(seconds_left(progress))) : ordered_json();
  state["seconds"] = counts.seconds;
  state["time"] = duration_text(counts.seconds);
}

}  // namespace

ordered_json state_of(const Followed& followed, const View& view, const Kept& kept, std::time_t now) {
  const auto& [study, folder, program] = followed;
  const Standing standing = standing_of(study, folder, view);
  ordered_json state = {
      {"study", study.name},
      {"about", study.about},
      {"folder", folder.path.string()},
      {"program", program},
      {"now", utc_text(now)},
      {"standing", {{"kind", to_string(standing.kind)}, {"text", standing.text}, {"next", standing.next}}}};
  if (!view.contents) return state;
  const Contents& contents = *view.contents;
  const Counts counts = count(contents.runs);
  state["problem"] = detail::described(study.problem);
  add_progress(state, view, counts, now);
  state["responses"] = reached_json(contents);
  add_failures(state, contents, counts);
  state["running"] = running_json(contents.runs);
  state["last"] = last_json(contents);
  state["logged"] = logged_run(study, contents);
  add_rows(state, contents, kept);
  return state;
}

}  // namespace drawpoint::studies
