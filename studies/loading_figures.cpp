// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading_figures.h>
#include <drawpoint/studies/loading_scenario.h>
#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/pile_shape.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <thread>

namespace drawpoint::studies {
namespace {

using engine::loading::CycleRecord;
using engine::loading::LoadingLog;
using engine::loading::SceneKnot;
using nlohmann::json;

// Three decimals: millimetres, and the text of a number stays short.
json rounded(double value) { return std::round(value * 1e3) / 1e3; }
json rounded(const std::vector<double>& values) {
  json out = json::array();
  for (double value : values) out.push_back(rounded(value));
  return out;
}

std::string fixed(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

struct Rows {
  std::size_t first, last;  // half open
};

Rows rows_of(const LoadingLog& log, int cycle) {
  const std::vector<double> column = log.signals.column("cycle");
  const auto begin = std::lower_bound(column.begin(), column.end(), cycle);
  const auto end = std::upper_bound(column.begin(), column.end(), cycle);
  return {static_cast<std::size_t>(begin - column.begin()), static_cast<std::size_t>(end - column.begin())};
}

// All values of a signal in one cycle: a line that leaves samples out hides its peaks.
std::vector<double> samples(const LoadingLog& log, const char* name, Rows rows) {
  const std::size_t column = log.signals.index(name);
  std::vector<double> out;
  for (std::size_t r = rows.first; r < rows.last; ++r) out.push_back(log.signals.at(r, column));
  return out;
}

json stage_paths(const LoadingLog& log, Rows rows) {
  const std::vector<double> stage = samples(log, "stage", rows), x = samples(log, "tip_x", rows),
                            z = samples(log, "tip_z", rows);
  json stages = json::array();
  for (int k = 1; k <= 4; ++k) {
    json xs = json::array(), zs = json::array();
    for (std::size_t i = 0; i < stage.size(); ++i)
      if (stage[i] == k) {
        xs.push_back(rounded(x[i]));
        zs.push_back(rounded(z[i]));
      }
    stages.push_back(
        {{"name", std::string(name(static_cast<engine::loading::Stage>(k)))}, {"x", xs}, {"z", zs}});
  }
  return stages;
}

std::string name_of(const CycleRecord& cycle) { return "Cycle " + std::to_string(cycle.number); }

json path_panel(const LoadingLog& log, const CycleRecord& cycle) {
  const Rows rows = rows_of(log, cycle.number);
  return {
      {"type", "path"},
      {"title", "Planned and actual path of the cutting edge"},
      {"caption", name_of(cycle) +
                      " of the run shown, from the side. The pile's contour is the mean over the "
                      "bucket's breadth before "
                      "the cycle; planned depth " +
                      fixed(cycle.plan.depth, 2) + " m, height " + fixed(cycle.plan.height, 2) +
                      " m, slope " + fixed(cycle.plan.slope * 180 / M_PI, 0) + " deg."},
      {"x_label", "along the drift [m]"},
      {"z_label", "height [m]"},
      {"contour", {{"x", rounded(cycle.contour_x)}, {"z", rounded(cycle.contour_z)}}},
      {"planned", {{"x", rounded(cycle.planned_x)}, {"z", rounded(cycle.planned_z)}}},
      {"actual", {{"x", rounded(samples(log, "tip_x", rows))}, {"z", rounded(samples(log, "tip_z", rows))}}},
      {"stages", stage_paths(log, rows)}};
}

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
    bodies.push_back(
        {{"shape", body.shape}, {"color", body.color}, {"opacity", body.opacity}, {"name", body.name}});
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

// What the log leaves out (scene_recorder.h) without a tolerance of its own; older logs have each pose to 2 mm.
std::string scene_caption(const LoadingLog& log, const CycleRecord& cycle) {
  return name_of(cycle) + " of the run shown: drag to turn, wheel to zoom, play to watch it load. " +
         rate_of(log, frames_of(log, cycle.number)) +
         "In a picture a rock is within 2.5 cm and 3 degrees of where it was, the machine within 2 mm. "
         "Walls "
         "and roof are drawn transparent. Below, of every sample: the highest and the lowest are kept where "
         "a "
         "plot is narrower than its samples. The torque is the length of its two components that twist the "
         "bucket on its pin, as it is; damage looks at it low-passed at 20 Hz.";
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

json scene_signals(const LoadingLog& log, const CycleRecord& cycle, double yield_torque) {
  const Rows rows = rows_of(log, cycle.number), frames = frames_of(log, cycle.number);
  std::vector<double> t = samples(log, "time", rows), torque = samples(log, "hinge_G_torque_x", rows);
  const std::vector<double> about_z = samples(log, "hinge_G_torque_z", rows);
  for (std::size_t i = 0; i < t.size(); ++i) {
    t[i] -= cycle.t_start;
    torque[i] = 1e-3 * std::hypot(torque[i], about_z[i]);
  }
  json signals = {signal("Speed of the cutting edge", "m/s", t, tip_speed(log, rows, t)),
                  signal("Torque that twists hinge G", "kN m", t, torque)};
  signals[1]["lines"] = {{{"name", "yield torque"}, {"y", 1e-3 * yield_torque}}};
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

// The cycle's frames; the poster shows the bucket as it breaks out.
json scene_panel(const LoadingLog& log, const CycleRecord& cycle, double yield_torque) {
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
                {"title", "The machine in the drift"},
                {"caption", scene_caption(log, cycle)},
                {"shapes", shapes},
                {"bodies", bodies_of(log, rows)},
                {"frames", frames},
                {"signals", scene_signals(log, cycle, yield_torque)},
                {"camera", {{"eye", {toe - 3.5, -11.0, 5.5}}, {"target", {toe - 1.2, 0.0, 1.3}}}},
                {"poster_frame", poster}};
  if (const auto machine = body_named(log, "front unit")) panel["follow"] = *machine;
  return panel;
}

json line(const LoadingLog& log, Rows rows, const char* signal, const char* label, double scale) {
  std::vector<double> t = samples(log, "time", rows), y = samples(log, signal, rows);
  const double start = t.empty() ? 0 : t.front();
  for (double& value : t) value -= start;
  for (double& value : y) value *= scale;
  return {{"name", label}, {"x", rounded(t)}, {"y", rounded(y)}};
}

// The yield torque in either direction.
std::vector<json> yield_lines(const LoadingLog& log, Rows rows, double yield_torque) {
  if (rows.first == rows.last) return {};
  const std::size_t time = log.signals.index("time");
  const double end = log.signals.at(rows.last - 1, time) - log.signals.at(rows.first, time);
  std::vector<json> lines;
  for (const double torque : {yield_torque, -yield_torque})
    lines.push_back({{"name", torque > 0 ? "yield torque" : "yield torque, other way"},
                     {"x", rounded({0.0, end})},
                     {"y", rounded({1e-3 * torque, 1e-3 * torque})}});
  return lines;
}

json forces_panel(const LoadingLog& log, const CycleRecord& cycle, double yield_torque) {
  const Rows rows = rows_of(log, cycle.number);
  const bool cylinders = log.texts.at("arm_drive") == "cylinders";
  json series = {line(log, rows, "lift_force", "lift", 1e-3), line(log, rows, "tilt_force", "tilt", 1e-3),
                 line(log, rows, "wheel_torque", "wheels, sum [kN m]", 1e-3),
                 line(log, rows, "hinge_G_torque_x", "hinge G, about long axis", 1e-3),
                 line(log, rows, "hinge_G_torque_z", "hinge G, about upright axis", 1e-3)};
  for (const json& yield : yield_lines(log, rows, yield_torque)) series.push_back(yield);
  return {
      {"type", "lines"},
      {"title", "Drive forces and the torque in hinge G"},
      {"caption",
       name_of(cycle) +
           " of the run shown. The two torque components twist the bucket on its pin. Damage integrates the "
           "excess of the torque over the yield torque of " +
           fixed(1e-3 * yield_torque, 0) +
           " kN m, low-passed at 20 Hz, relative to it. Every sample is drawn."},
      {"x_label", "time [s]"},
      {"y_label", cylinders ? "force [kN], torque [kN m]" : "torque [kN m]"},
      {"series", series}};
}

json bucket_panel(const LoadingLog& log, const CycleRecord& cycle) {
  std::vector<double> t, mass;
  for (const auto& frame : log.scene.frames) {
    if (frame.cycle != cycle.number || std::isnan(frame.bucket_mass)) continue;
    t.push_back(frame.t - cycle.t_start);
    mass.push_back(1e-3 * frame.bucket_mass);
  }
  return {{"type", "lines"},
          {"title", "Rock in the bucket"},
          {"caption", name_of(cycle) +
                          " of the run shown: the mass of all rocks whose centre is in the heaped bucket, "
                          "also while the bucket only passes round them. At the end it carried " +
                          fixed(1e-3 * cycle.loaded_mass, 1) + " t."},
          {"x_label", "time [s]"},
          {"y_label", "mass [t]"},
          {"series", {{{"name", "rock in the bucket"}, {"x", rounded(t)}, {"y", rounded(mass)}}}}};
}

json cycles_panel(const LoadingLog& log) {
  json rows = json::array();
  for (const CycleRecord& c : log.cycles) {
    std::string ends;
    for (const auto& stage : c.stages)
      ends += (ends.empty() ? "" : ", ") + std::string(name(stage.stage)) + ": " +
              std::string(name(stage.reason));
    rows.push_back({std::to_string(c.number), fixed(c.t_end - c.t_start, 1), fixed(c.loaded_mass, 0),
                    fixed(c.spilled_mass, 0), fixed(c.plan.depth, 2), fixed(c.plan.height, 2), ends});
  }
  return {
      {"type", "table"},
      {"title", "Cycles of the run shown"},
      {"caption",
       "How each stage ended: at its goal, by its time limit, or because a drive was too slow under load."},
      {"columns",
       {"cycle", "time [s]", "loaded [kg]", "spilled [kg]", "planned depth [m]", "planned height [m]",
        "stages"}},
      {"rows", rows}};
}

}  // namespace

void settle_pile(engine::loading::Scenario scenario) {
  engine::loading::check(scenario);
  scenario.world.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u));
  int told = -1;
  const auto pile = engine::loading::prepared_pile(scenario, [&](double share) {
    const int percent = static_cast<int>(100 * share) / 10 * 10;
    if (percent == told) return;
    told = percent;
    if (percent < 100)
      std::fprintf(stderr, "pouring the pile: %d %%\n", percent);
    else
      std::fprintf(stderr, "pouring the pile: done, settling\n");
  });
  const engine::loading::PileShape shape = engine::loading::pile_shape(pile, scenario);
  std::fprintf(stderr, "the pile: %zu rocks, %.0f t, %s after %.0f s; crest %.2f m, surface at %.1f deg\n",
               pile.rocks.size(), shape.mass / 1e3, pile.timed_out ? "still creeping" : "at rest",
               pile.poured_s, shape.surface.crest, shape.surface.mean * 180 / M_PI);
}

json loading_figures(const std::filesystem::path& log_file, const OptionValues& options) {
  const LoadingLog log = engine::loading::read_log(log_file);
  if (log.cycles.empty()) return json::array();
  const CycleRecord& cycle = log.cycles.front();
  const double yield_torque = damage_options(options).tau_y;
  json panels = {path_panel(log, cycle), scene_panel(log, cycle, yield_torque),
                 forces_panel(log, cycle, yield_torque)};
  json bucket = bucket_panel(log, cycle);
  if (!bucket["series"][0]["x"].empty()) panels.push_back(std::move(bucket));  // logs of version 4 have none
  panels.push_back(cycles_panel(log));
  return panels;
}

}  // namespace drawpoint::studies
