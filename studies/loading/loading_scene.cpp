// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_looks.h>
#include <drawpoint/studies/loading/loading_panels.h>
#include <drawpoint/studies/loading/loading_scene.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace drawpoint::studies {

using engine::loading::CycleRecord;
using engine::loading::LoadingLog;
using engine::loading::SceneKnot;
using nlohmann::json;

namespace {

json shape_of(const engine::ConvexPolyhedron& shape) {
  json vertices = json::array();
  for (const auto& v : shape.vertices()) vertices.push_back({rounded(v.x()), rounded(v.y()), rounded(v.z())});
  return {{"vertices", vertices}, {"faces", shape.faces()}};
}

// Frames of a cycle, half open.
Rows frames_of(const LoadingLog& log, int cycle) {
  const auto& frames = log.scene.frames;
  const auto is_of_cycle = [&](const auto& frame) { return frame.cycle == cycle; };
  const auto begin = std::find_if(frames.begin(), frames.end(), is_of_cycle);
  const auto end = std::find_if_not(begin, frames.end(), is_of_cycle);
  return {static_cast<std::size_t>(begin - frames.begin()), static_cast<std::size_t>(end - frames.begin())};
}

// [frame, x, y, z, qw, qx, qy, qz], or [frame] where the body is not shown from there on.
json pose_of(const SceneKnot& knot, std::size_t first_frame) {
  json row = {static_cast<std::size_t>(knot.frame) - first_frame};
  if (!std::isnan(knot.pose[0]))
    for (double value : knot.pose) row.push_back(value);
  return row;
}

json bodies_of(const LoadingLog& log, Rows frames) {
  json bodies = json::array();
  for (const auto& body : log.scene.bodies) {
    bodies.push_back({{"shape", body.shape},
                      {"color", body.color},
                      {"opacity", body.opacity},
                      {"name", body.name},
                      {"look", look_of(body)}});
    if (body.with >= 0)
      bodies.back()["with"] = body.with;
    else
      bodies.back()["track"] = json::array();
  }
  for (const SceneKnot& knot : log.scene.knots) {
    const auto frame = static_cast<std::size_t>(knot.frame);
    if (frame >= frames.first && frame < frames.last)
      bodies[static_cast<std::size_t>(knot.body)]["track"].push_back(pose_of(knot, frames.first));
  }
  return bodies;
}

// "curl, 3.2 t in the bucket"; logs of version 4 do not know the mass.
std::string label_of(const engine::loading::SceneFrame& frame) {
  if (std::isnan(frame.bucket_mass)) return frame.label;
  return frame.label + ", " + fixed(1e-3 * frame.bucket_mass, 1) + " t in the bucket";
}

// "20 pictures per second"; the last one, of the weighing, comes later than the others.
std::string rate_of(const LoadingLog& log, Rows frames) {
  if (frames.last - frames.first < 3) return "";
  const auto& all = log.scene.frames;
  const double span = all[frames.last - 2].t - all[frames.first].t;
  const double rate = static_cast<double>(frames.last - 2 - frames.first) / span;
  return "The log has " + fixed(rate, rate < 10 ? 1 : 0) +
         " pictures per second; between them bodies move evenly. ";
}

// How to read any scene. What the log leaves out is in scene_recorder.h; older logs have each pose to 2 mm.
std::string scene_note(const LoadingLog& log, const CycleRecord& cycle) {
  return "Drag to turn, wheel to zoom, play to watch it load. " + rate_of(log, frames_of(log, cycle.number)) +
         "In a picture a rock is within 2.5 cm and 3 degrees of where it was, a part of the machine "
         "within 4 mm and 0.3 degrees. The wall or roof between the reader and the machine is left out; "
         "roughness of the "
         "drift, lamps and tread are drawn, not simulated. The plots have every sample: "
         "the highest and the lowest are kept where a plot is narrower than its samples. The torque is as "
         "it is, damage looks at it low-passed at 20 Hz. Rock in the bucket is the mass of all rocks whose "
         "centre is in the heaped bucket, also while the bucket only passes round them.";
}

// Of the cycle, on the clock of the scene.
json signal(const std::string& name, const std::string& unit, const std::vector<double>& t,
            const std::vector<double>& y) {
  return {{"name", name}, {"unit", unit}, {"t", rounded(t)}, {"y", rounded(y)}};
}

// Way of the cutting edge's middle from sample to sample, over the time between them.
std::vector<double> tip_speed(const LoadingLog& log, Rows rows, const std::vector<double>& t) {
  std::vector<double> speed(t.size());
  const std::vector<double> x = samples(log, "tip_x", rows), y = samples(log, "tip_y", rows),
                            z = samples(log, "tip_z", rows);
  for (std::size_t i = 1; i < t.size(); ++i)
    speed[i] = std::hypot(x[i] - x[i - 1], y[i] - y[i - 1], z[i] - z[i - 1]) / (t[i] - t[i - 1]);
  if (t.size() > 1) speed[0] = speed[1];
  return speed;
}

json scene_signals(const LoadingLog& log, const CycleRecord& cycle,
                   const engine::loading::DamageOptions& damage) {
  const Rows rows = rows_of(log, cycle.number), frames = frames_of(log, cycle.number);
  std::vector<double> t = samples(log, "time", rows);
  for (double& time : t) time -= cycle.t_start;
  const bool all = damage.component == engine::loading::TorqueComponent::all;
  json signals = {signal("Speed of the cutting edge", "m/s", t, tip_speed(log, rows, t)),
                  signal(all ? "Torque in hinge G" : "Torque that twists hinge G", "kN m", t,
                         hinge_torque(log, rows, damage.component))};
  signals[1]["lines"] = {{{"name", "yield torque"}, {"y", 1e-3 * damage.tau_y}}};
  std::vector<double> at, mass;
  for (std::size_t f = frames.first; f < frames.last; ++f) {
    const auto& frame = log.scene.frames[f];
    if (std::isnan(frame.bucket_mass)) continue;
    at.push_back(frame.t - cycle.t_start);
    mass.push_back(1e-3 * frame.bucket_mass);
  }
  if (!at.empty()) signals.push_back(signal("Rock in the bucket", "t", at, mass));
  return signals;
}

std::optional<std::size_t> body_named(const LoadingLog& log, const char* name) {
  const auto& bodies = log.scene.bodies;
  const auto found =
      std::find_if(bodies.begin(), bodies.end(), [&](const auto& body) { return body.name == name; });
  if (found == bodies.end()) return std::nullopt;
  return static_cast<std::size_t>(found - bodies.begin());
}

}  // namespace

json scene_panel(const LoadingLog& log, const CycleRecord& cycle, const std::string& who,
                 const std::string& title, const engine::loading::DamageOptions& damage) {
  json shapes = json::array(), frames = json::array();
  for (const auto& shape : log.scene.shapes) shapes.push_back(shape_of(shape));
  const Rows rows = frames_of(log, cycle.number);
  std::size_t poster = 0;
  for (std::size_t f = rows.first; f < rows.last; ++f) {
    const auto& frame = log.scene.frames[f];
    if (frame.label == "curl") poster = f - rows.first;
    frames.push_back({{"t", rounded(frame.t - cycle.t_start)}, {"label", label_of(frame)}});
  }
  const double toe = cycle.plan.toe;
  json panel = {{"type", "scene"},
                {"title", title},
                {"caption", who + "."},
                {"note", scene_note(log, cycle)},
                {"shapes", shapes},
                {"bodies", bodies_of(log, rows)},
                {"frames", frames},
                {"signals", scene_signals(log, cycle, damage)},
                {"camera", {{"eye", {toe - 5.2, -9.6, 4.4}}, {"target", {toe - 0.8, 0.2, 1.5}}}},
                {"poster_frame", poster}};
  if (json drift = drift_of(log.scene); !drift.is_null()) panel["drift"] = std::move(drift);
  if (const auto machine = body_named(log, "front unit")) panel["follow"] = *machine;
  return panel;
}

}  // namespace drawpoint::studies
