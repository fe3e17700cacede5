// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/live/site.h>
#include <drawpoint/studies/say/live/standing.h>
#include <drawpoint/studies/say/page/page.h>
#include <drawpoint/studies/say/run_replay.h>

#include <ctime>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace drawpoint::studies {
namespace {

constexpr const char* html = "text/html; charset=utf-8";
constexpr const char* plain = "text/plain; charset=utf-8";
constexpr const char* json_type = "application/json";

template <class Json>
Answer as_json(const Json& json, int status = 200) {
  return {status, json_type, json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

/// Throws std::runtime_error where there is none, or it says nothing of single runs.
const Run& run_in(const Study& study, const View& view, std::int64_t run) {
  if (!study.presentation.illustrate)
    throw std::runtime_error(
        "this study does not say what to draw of a run's log (Presentation::illustrate)");
  if (!view.contents || run < 1 || run > static_cast<std::int64_t>(view.contents->runs.size()))
    throw std::runtime_error("there is no run " + std::to_string(run));
  return view.contents->runs[static_cast<std::size_t>(run) - 1];
}

}  // namespace

Site::Site(Followed followed)
    : followed_(std::move(followed)), follower_(followed_.study, followed_.folder) {}

Answer Site::page(const std::string& nonce) const {
  return {200, html, detail::live_page(followed_.study.name + ", live", nonce)};
}

Answer Site::state(const Kept& kept) {
  return as_json(state_of(followed_, follower_.look(), kept, std::time(nullptr)));
}

Answer Site::figures(std::int64_t run) {
  const View view = follower_.look();
  try {
    const Run& shown = run_in(followed_.study, view, run);
    std::vector<std::string> cautions;
    const std::lock_guard lock(logs_);
    nlohmann::json figures =
        flat_figures(followed_.study, view.contents->identity, followed_.folder, shown, cautions);
    return as_json(
        nlohmann::json{{"run", run}, {"illustrations", std::move(figures)}, {"cautions", cautions}});
  } catch (const std::exception& e) {
    return as_json(nlohmann::json{{"error", e.what()}}, 404);
  }
}

Answer Site::replay(std::int64_t run) {
  const View view = follower_.look();
  try {
    const Run& shown = run_in(followed_.study, view, run);
    const std::lock_guard lock(logs_);
    const std::string command = followed_.program + " replay --run " + std::to_string(run);
    return {200, html,
            replay_page(followed_.study, view.contents->identity, followed_.folder, {shown}, command)};
  } catch (const std::exception& e) {
    return {404, plain, std::string(e.what()) + "\n"};
  }
}

std::string Site::standing() { return standing_of(followed_.study, followed_.folder, follower_.look()).text; }

}  // namespace drawpoint::studies
