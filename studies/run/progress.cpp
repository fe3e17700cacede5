// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/progress.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace drawpoint::studies {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double live_interval = 0.2;    // [s]
constexpr double plain_interval = 10.0;  // [s]

std::string number(double value, const char* unit) {
  char text[40];
  std::snprintf(text, sizeof text, value < 10.0 ? "%.1f %s" : "%.0f %s", value, unit);
  return text;
}

bool is_terminal(int descriptor) {
  const char* kind = std::getenv("TERM");
  return isatty(descriptor) == 1 && kind != nullptr && std::strcmp(kind, "dumb") != 0;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 100.0) return number(seconds, "s");
  if (seconds < 6000.0) return number(seconds / 60.0, "min");
  if (seconds < 48.0 * 3600.0) return number(seconds / 3600.0, "h");
  return number(seconds / 86400.0, "d");
}

double rate_of(const ProgressState& state) {
  return state.session > 0 && state.seconds > 0.0 ? state.session / state.seconds : 0.0;
}

double seconds_left(const ProgressState& state) { return (state.total - state.done) / rate_of(state); }

std::string progress_text(const ProgressState& state) {
  std::string text = std::to_string(state.done) + "/" + std::to_string(state.total) + " " + state.things;
  if (state.failed > 0) text += ", " + std::to_string(state.failed) + " failed";
  if (const double rate = rate_of(state); rate > 0.0) {
    text += ", " + (rate < 1.0 ? number(60.0 * rate, "per minute") : number(rate, "per second"));
    if (state.done < state.total) text += ", " + duration_text(seconds_left(state)) + " left";
  }
  if (!state.standing.empty()) text += "; " + state.standing;
  return text;
}

Progress::Progress(int descriptor, ProgressState start)
    : descriptor_(descriptor),
      live_(is_terminal(descriptor)),
      state_(start),
      start_(Clock::now()),
      shown_(start_) {
  show(false);
}

Progress::~Progress() {
  if (line_open_) dprintf(descriptor_, "\n");
}

void Progress::finished_one(bool failed) {
  ++state_.done;
  ++state_.session;
  if (failed) ++state_.failed;
  if (state_.done == state_.total) show(true);
}

void Progress::tick(const std::string& standing) {
  state_.standing = standing;
  if (seconds_since(shown_) >= (live_ ? live_interval : plain_interval)) show(false);
}

void Progress::show(bool last) {
  shown_ = Clock::now();
  state_.seconds = seconds_since(start_);
  const std::string text = progress_text(state_);
  if (!live_) {
    dprintf(descriptor_, "%s\n", text.c_str());
    return;
  }
  dprintf(descriptor_, "\r\033[K%s%s", text.c_str(), last ? "\n" : "");
  line_open_ = !last;
}

}  // namespace drawpoint::studies
