// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <drawpoint/engine/loading/log/scene_motion.hpp>
#include <limits>
#include <tuple>
#include <utility>

namespace drawpoint::engine::loading {
namespace {

constexpr std::size_t place_numbers = 3;

double allowed(const MotionTolerance& tolerance, std::size_t k) {
  return k < place_numbers ? tolerance.place : tolerance.turn;
}

// The same turn, with the quaternion in the half that `before` is in.
ScenePose turned_like(ScenePose pose, const ScenePose& before) {
  double dot = 0;
  for (std::size_t k = place_numbers; k < pose.size(); ++k) dot += pose[k] * before[k];
  if (dot < 0)
    for (std::size_t k = place_numbers; k < pose.size(); ++k) pose[k] = -pose[k];
  return pose;
}

ScenePose mixed(const ScenePose& a, const ScenePose& b, double share) {
  const ScenePose end = turned_like(b, a);
  ScenePose pose{};
  double square = 0;
  for (std::size_t k = 0; k < pose.size(); ++k) {
    pose[k] = static_cast<float>(a[k] + share * (end[k] - a[k]));
    if (k >= place_numbers) square += pose[k] * pose[k];
  }
  for (std::size_t k = place_numbers; square > 0 && k < pose.size(); ++k)
    pose[k] = static_cast<float>(pose[k] / std::sqrt(square));
  return pose;
}

auto place_in_order(const SceneKnot& knot) { return std::tie(knot.body, knot.frame); }

}  // namespace

void MotionRecorder::begin(Line& line, const SceneKnot& sample, double t) {
  line.begun = line.still = true;
  line.first = line.last = sample;
  line.t_first = t;
  line.low.fill(-std::numeric_limits<double>::infinity());
  line.high.fill(std::numeric_limits<double>::infinity());
}

bool MotionRecorder::meets(const Line& line, const ScenePose& pose, double dt) {
  for (std::size_t k = 0; k < pose.size(); ++k) {
    const double slope = (double(pose[k]) - line.first.pose[k]) / dt;
    if (slope < line.low[k] || slope > line.high[k]) return false;
  }
  return true;
}

void MotionRecorder::narrow(Line& line, const ScenePose& pose, double dt, const MotionTolerance& tolerance) {
  for (std::size_t k = 0; k < pose.size(); ++k) {
    const double way = double(pose[k]) - line.first.pose[k], room = allowed(tolerance, k);
    line.low[k] = std::max(line.low[k], (way - room) / dt);
    line.high[k] = std::min(line.high[k], (way + room) / dt);
    if (std::abs(way) > room) line.still = false;
  }
}

// The last sample is a knot unless the body has not left the first, which is one.
void MotionRecorder::finish(Line& line) {
  if (!line.still) knots_.push_back(line.last);
}

void MotionRecorder::add(const SceneKnot& given, double t, const MotionTolerance& tolerance) {
  const auto body = static_cast<std::size_t>(given.body);
  if (lines_.size() <= body) lines_.resize(body + 1), t_last_.resize(body + 1);
  Line& line = lines_[body];
  SceneKnot sample = given;
  const double before = std::exchange(t_last_[body], t);
  const bool hidden = is_hidden(sample.pose);
  if (!line.begun || hidden != is_hidden(line.first.pose)) {
    if (line.begun) finish(line);
    knots_.push_back(sample);
    return begin(line, sample, t);
  }
  if (hidden) return;
  sample.pose = turned_like(sample.pose, line.last.pose);
  if (!meets(line, sample.pose, t - line.t_first)) {
    knots_.push_back(line.last);
    begin(line, line.last, before);
  }
  narrow(line, sample.pose, t - line.t_first, tolerance);
  line.last = sample;
}

void MotionRecorder::end() {
  for (Line& line : lines_)
    if (line.begun) finish(line);
  std::sort(knots_.begin() + static_cast<std::ptrdiff_t>(sorted_), knots_.end(),
            [](const SceneKnot& a, const SceneKnot& b) { return place_in_order(a) < place_in_order(b); });
  sorted_ = knots_.size();
  lines_.clear();
  t_last_.clear();
}

std::optional<ScenePose> pose_in(const SceneRecord& scene, int body, int frame) {
  const int own = scene.bodies[static_cast<std::size_t>(body)].with < 0
                      ? body
                      : scene.bodies[static_cast<std::size_t>(body)].with;
  const auto cycle_of = [&](int f) { return scene.frames[static_cast<std::size_t>(f)].cycle; };
  const auto rank = [&](const SceneKnot& knot) {
    return std::make_tuple(cycle_of(knot.frame), knot.body, knot.frame);
  };
  const auto next =
      std::upper_bound(scene.knots.begin(), scene.knots.end(), std::make_tuple(cycle_of(frame), own, frame),
                       [&](const auto& wanted, const SceneKnot& knot) { return wanted < rank(knot); });
  const auto same_run = [&](const SceneKnot& knot) {
    return knot.body == own && cycle_of(knot.frame) == cycle_of(frame);
  };
  if (next == scene.knots.begin() || !same_run(*std::prev(next))) return std::nullopt;
  const SceneKnot& last = *std::prev(next);
  if (is_hidden(last.pose)) return std::nullopt;
  if (next == scene.knots.end() || !same_run(*next) || is_hidden(next->pose)) return last.pose;
  const auto time = [&](int f) { return scene.frames[static_cast<std::size_t>(f)].t; };
  return mixed(last.pose, next->pose,
               (time(frame) - time(last.frame)) / (time(next->frame) - time(last.frame)));
}

}  // namespace drawpoint::engine::loading
