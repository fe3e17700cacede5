// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/record/file.hpp>
#include <stdexcept>

namespace drawpoint::engine::loading {
namespace {

using record::Reader;
using record::Table;
using record::Writer;

const record::FileKind kind{"drawpoint loading log", 4};

std::string numbered(const std::string& group, std::size_t k) {
  std::string digits = std::to_string(k);
  return group + "/" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

[[noreturn]] void contradiction(const std::string& what) {
  throw std::invalid_argument("loading::write_log: " + what + "; make the log agree with itself");
}

// What another program wrote, or a damaged file that its checksum does not know of.
void require_fit(const Reader& file, bool fits, const std::string& data, const std::string& expected) {
  if (!fits)
    throw std::runtime_error("loading::read_log: " + file.path().string() + ": /" + data +
                             " does not fit the rest of the log; expected " + expected +
                             "; let the run be written anew");
}

// One list of the plan's and the cycle's numbers serves writing and reading.
template <class PlanOrConst, class Visit>
void visit_numbers(PlanOrConst& plan, Visit&& visit) {
  visit("y_m", plan.y);
  visit("depth_m", plan.depth);
  visit("height_m", plan.height);
  visit("tilt_rad", plan.tilt);
  visit("slope_rad", plan.slope);
  visit("toe_m", plan.toe);
  visit("volume_centre_m", plan.volume_centre);
  visit("crest_m", plan.crest);
  visit("height_limit_m", plan.height_limit);
  visit("area_m2", plan.area);
  visit("phi_max_rad", plan.phi_max);
}

template <class CycleOrConst, class Visit>
void visit_cycle_numbers(CycleOrConst& cycle, Visit&& visit) {
  visit("t_start_s", cycle.t_start);
  visit("t_end_s", cycle.t_end);
  visit("loaded_mass_kg", cycle.loaded_mass);
  visit("front_mass_kg", cycle.front_mass);
  visit("spilled_mass_kg", cycle.spilled_mass);
}

template <class CycleOrConst, class Visit>
void visit_arrays(CycleOrConst& cycle, Visit&& visit) {
  visit("loaded_rock_masses_kg", cycle.loaded_rock_masses);
  visit("planned_x_m", cycle.planned_x);
  visit("planned_z_m", cycle.planned_z);
  visit("contour_x_m", cycle.contour_x);
  visit("contour_z_m", cycle.contour_z);
}

void write_plan(Writer& file, const std::string& group, const Plan& plan) {
  visit_numbers(plan, [&](const char* name, double value) { file.number(group, name, value); });
  file.text(group, "message", plan.message);
  file.integer(group, "feasible", plan.feasible);
  file.integer(group, "limited", plan.limited);
  file.integer(group, "row", plan.row);
  file.integer(group, "curl", static_cast<int>(plan.curl));
  file.integer(group, "lift", static_cast<int>(plan.lift));
  std::vector<double> corners;
  for (const TipPose& corner : plan.corners) corners.insert(corners.end(), {corner.x, corner.z, corner.phi});
  file.array(group + "/corners_x_z_phi", std::span<const double>(corners), {plan.corners.size(), 3});
}

Plan read_plan(const Reader& file, const std::string& group) {
  Plan plan;
  visit_numbers(plan, [&](const char* name, double& value) { value = file.number(group, name); });
  plan.message = file.text(group, "message");
  plan.feasible = file.integer(group, "feasible") != 0;
  plan.limited = file.integer(group, "limited") != 0;
  plan.row = static_cast<int>(file.integer(group, "row"));
  plan.curl = static_cast<CurlMode>(file.integer(group, "curl"));
  plan.lift = static_cast<LiftGoal>(file.integer(group, "lift"));
  const auto corners = file.doubles(group + "/corners_x_z_phi").values;
  require_fit(file, corners.size() == 3 * plan.corners.size(), group + "/corners_x_z_phi",
              std::to_string(plan.corners.size()) + " rows of 3");
  for (std::size_t k = 0; k < plan.corners.size(); ++k)
    plan.corners[k] = {corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]};
  return plan;
}

Table stage_table(const std::vector<StageResult>& stages) {
  Table table;
  table.columns = {{"stage", "1"},    {"reason", "1"},  {"t_start", "s"},  {"t_end", "s"},
                   {"progress", "1"}, {"start_x", "m"}, {"start_z", "m"},  {"start_phi", "rad"},
                   {"end_x", "m"},    {"end_z", "m"},   {"end_phi", "rad"}};
  for (const StageResult& s : stages)
    table.append_row(std::vector<double>{static_cast<double>(s.stage), static_cast<double>(s.reason),
                                         s.t_start, s.t_end, s.progress, s.start.x, s.start.z, s.start.phi,
                                         s.end.x, s.end.z, s.end.phi});
  return table;
}

std::vector<StageResult> stages_of(const Table& table) {
  std::vector<StageResult> stages;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const auto at = [&](const char* name) { return table.at(k, table.index(name)); };
    stages.push_back({.stage = static_cast<Stage>(static_cast<int>(at("stage"))),
                      .reason = static_cast<StageEnd>(static_cast<int>(at("reason"))),
                      .t_start = at("t_start"),
                      .t_end = at("t_end"),
                      .progress = at("progress"),
                      .start = {at("start_x"), at("start_z"), at("start_phi")},
                      .end = {at("end_x"), at("end_z"), at("end_phi")}});
  }
  return stages;
}

void write_cycle(Writer& file, const std::string& group, const CycleRecord& cycle) {
  const auto nx = static_cast<std::size_t>(std::max(cycle.columns_x, 0));
  const auto ny = static_cast<std::size_t>(std::max(cycle.columns_y, 0));
  if (cycle.column_heights.size() != nx * ny)
    contradiction(group + " has " + std::to_string(cycle.column_heights.size()) + " column heights for " +
                  std::to_string(nx) + " x " + std::to_string(ny) + " columns");
  file.integer(group, "number", cycle.number);
  visit_cycle_numbers(cycle, [&](const char* name, double value) { file.number(group, name, value); });
  visit_arrays(cycle, [&](const char* name, const std::vector<double>& values) {
    file.array(group + "/" + name, std::span(values));
  });
  file.array(group + "/column_heights_m", std::span(cycle.column_heights), {ny, nx});
  file.table(group + "/stages", stage_table(cycle.stages));
  write_plan(file, group + "/plan", cycle.plan);
}

CycleRecord read_cycle(const Reader& file, const std::string& group) {
  CycleRecord cycle;
  cycle.number = static_cast<int>(file.integer(group, "number"));
  visit_cycle_numbers(cycle, [&](const char* name, double& value) { value = file.number(group, name); });
  visit_arrays(cycle, [&](const char* name, std::vector<double>& values) {
    values = file.doubles(group + "/" + name).values;
  });
  auto heights = file.doubles(group + "/column_heights_m");
  require_fit(file, heights.shape.size() == 2, group + "/column_heights_m", "a matrix, ny x nx");
  cycle.columns_y = static_cast<int>(heights.shape[0]);
  cycle.columns_x = static_cast<int>(heights.shape[1]);
  cycle.column_heights = std::move(heights.values);
  cycle.stages = stages_of(file.table(group + "/stages"));
  cycle.plan = read_plan(file, group + "/plan");
  return cycle;
}

void write_bodies(Writer& file, const SceneRecord& scene) {
  std::vector<std::int32_t> shape;
  std::vector<double> opacity;
  std::vector<std::string> color, name;
  for (const SceneBody& body : scene.bodies) {
    if (body.shape < 0 || static_cast<std::size_t>(body.shape) >= scene.shapes.size())
      contradiction("scene body \"" + body.name + "\" has shape " + std::to_string(body.shape) + " of " +
                    std::to_string(scene.shapes.size()));
    shape.push_back(body.shape);
    opacity.push_back(body.opacity);
    color.push_back(body.color);
    name.push_back(body.name);
  }
  file.array("scene/bodies/shape", std::span<const std::int32_t>(shape));
  file.array("scene/bodies/opacity", std::span<const double>(opacity));
  file.texts("scene/bodies/color", color);
  file.texts("scene/bodies/name", name);
}

// Poses body by body and number by number, the frames last: what stands still is a row of equal numbers and
// takes next to no room in the file.
std::vector<float> frames_last(const std::vector<SceneFrame>& frames, std::size_t numbers) {
  std::vector<float> poses(frames.size() * numbers);
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (std::size_t k = 0; k < numbers; ++k) poses[k * frames.size() + f] = frames[f].poses[k];
  return poses;
}

void write_frames(Writer& file, const SceneRecord& scene) {
  std::vector<double> t;
  std::vector<std::int32_t> cycle;
  std::vector<std::string> label;
  const std::size_t numbers = values_per_pose * scene.bodies.size();
  for (const SceneFrame& frame : scene.frames) {
    if (frame.poses.size() != numbers)
      contradiction("a scene frame has " + std::to_string(frame.poses.size()) + " pose numbers for " +
                    std::to_string(scene.bodies.size()) + " bodies");
    t.push_back(frame.t);
    cycle.push_back(frame.cycle);
    label.push_back(frame.label);
  }
  const std::vector<float> poses = frames_last(scene.frames, numbers);
  file.array("scene/frames/t_s", std::span<const double>(t));
  file.array("scene/frames/cycle", std::span<const std::int32_t>(cycle));
  file.texts("scene/frames/label", label);
  file.array("scene/frames/poses", std::span<const float>(poses),
             {scene.bodies.size(), values_per_pose, scene.frames.size()});
}

void write_scene(Writer& file, const SceneRecord& scene) {
  file.group("scene/shapes");
  for (std::size_t k = 0; k < scene.shapes.size(); ++k) {
    std::vector<double> vertices;
    for (const Eigen::Vector3d& v : scene.shapes[k].vertices())
      vertices.insert(vertices.end(), {v.x(), v.y(), v.z()});
    file.array(numbered("scene/shapes", k), std::span<const double>(vertices), {vertices.size() / 3, 3});
  }
  write_bodies(file, scene);
  write_frames(file, scene);
}

void read_bodies(const Reader& file, SceneRecord& scene) {
  const auto shape = file.integers("scene/bodies/shape").values;
  const auto opacity = file.doubles("scene/bodies/opacity").values;
  const auto color = file.texts("scene/bodies/color"), name = file.texts("scene/bodies/name");
  const std::string one_each = std::to_string(shape.size()) + ", one per body";
  require_fit(file, opacity.size() == shape.size(), "scene/bodies/opacity", one_each);
  require_fit(file, color.size() == shape.size(), "scene/bodies/color", one_each);
  require_fit(file, name.size() == shape.size(), "scene/bodies/name", one_each);
  for (std::size_t k = 0; k < shape.size(); ++k) {
    require_fit(file, shape[k] >= 0 && static_cast<std::size_t>(shape[k]) < scene.shapes.size(),
                "scene/bodies/shape", "numbers below the " + std::to_string(scene.shapes.size()) + " shapes");
    scene.bodies.push_back({shape[k], color[k], opacity[k], name[k]});
  }
}

void read_frames(const Reader& file, SceneRecord& scene) {
  const auto t = file.doubles("scene/frames/t_s").values;
  const auto cycle = file.integers("scene/frames/cycle").values;
  const auto label = file.texts("scene/frames/label");
  const auto poses = file.floats("scene/frames/poses").values;
  const std::string one_each = std::to_string(t.size()) + ", one per frame";
  require_fit(file, cycle.size() == t.size(), "scene/frames/cycle", one_each);
  require_fit(file, label.size() == t.size(), "scene/frames/label", one_each);
  const std::size_t numbers = values_per_pose * scene.bodies.size();
  require_fit(file, poses.size() == numbers * t.size(), "scene/frames/poses", "7 numbers per body and frame");
  for (std::size_t f = 0; f < t.size(); ++f) {
    SceneFrame frame{t[f], cycle[f], label[f], std::vector<float>(numbers)};
    for (std::size_t k = 0; k < numbers; ++k) frame.poses[k] = poses[k * t.size() + f];
    scene.frames.push_back(std::move(frame));
  }
}

SceneRecord read_scene(const Reader& file) {
  SceneRecord scene;
  const std::size_t shapes = file.children("scene/shapes").size();
  for (std::size_t k = 0; k < shapes; ++k) {
    const auto values = file.doubles(numbered("scene/shapes", k)).values;
    require_fit(file, values.size() % 3 == 0, numbered("scene/shapes", k), "three numbers per vertex");
    std::vector<Eigen::Vector3d> vertices;
    for (std::size_t v = 0; v < values.size(); v += 3)
      vertices.emplace_back(values[v], values[v + 1], values[v + 2]);
    scene.shapes.push_back(engine::ConvexPolyhedron::hull_of(vertices));
  }
  read_bodies(file, scene);
  read_frames(file, scene);
  return scene;
}

}  // namespace

void write_log(const std::filesystem::path& path, const LoadingLog& log) {
  Writer file(path, kind);
  file.integer("/", "completed", log.completed);
  file.text("/", "message", log.message);
  file.group("numbers");
  file.group("texts");
  file.group("cycles");
  for (const auto& [name, value] : log.numbers) file.number("numbers", name, value);
  for (const auto& [name, value] : log.texts) file.text("texts", name, value);
  file.table("signals", log.signals);
  for (std::size_t k = 0; k < log.cycles.size(); ++k) write_cycle(file, numbered("cycles", k), log.cycles[k]);
  write_scene(file, log.scene);
  file.commit();
}

LoadingLog read_log(const std::filesystem::path& path) {
  const Reader file(path, kind);
  LoadingLog log;
  log.completed = file.integer("/", "completed") != 0;
  log.message = file.text("/", "message");
  for (const std::string& name : file.attributes("numbers")) log.numbers[name] = file.number("numbers", name);
  for (const std::string& name : file.attributes("texts")) log.texts[name] = file.text("texts", name);
  log.signals = file.table("signals");
  const std::size_t cycles = file.children("cycles").size();
  for (std::size_t k = 0; k < cycles; ++k) log.cycles.push_back(read_cycle(file, numbered("cycles", k)));
  log.scene = read_scene(file);
  return log;
}

}  // namespace drawpoint::engine::loading
