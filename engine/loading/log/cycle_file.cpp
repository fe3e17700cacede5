// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/log/log_parts.h>
#include <algorithm>
#include <stdexcept>

namespace drawpoint::engine::loading {
namespace {

using record::Reader;
using record::Table;
using record::Writer;

struct NumberName {
  const char* name;
  LogNumber meaning;
};

// One list of the plan's and the cycle's numbers serves writing and reading.
template <class PlanOrConst, class Visit>
void visit_numbers(PlanOrConst& plan, Visit&& visit) {
  visit({"y_m", {"m", "lateral place of the bucket's middle"}}, plan.y);
  visit({"depth_m", {"m", "horizontal thickness of the slice"}}, plan.depth);
  visit({"height_m", {"m", "of the slice"}}, plan.height);
  visit({"tilt_rad", {"rad", "of the bucket at the end of the lift"}}, plan.tilt);
  visit({"slope_rad", {"rad", "of the pile in the row"}}, plan.slope);
  visit({"toe_m", {"m", "x of the pile's toe in the row"}}, plan.toe);
  visit({"volume_centre_m", {"m", "x of the row's centre of volume"}}, plan.volume_centre);
  visit({"crest_m", {"m", "highest point of the row's contour"}}, plan.crest);
  visit({"height_limit_m", {"m", "largest height of the slice"}}, plan.height_limit);
  visit({"area_m2", {"m²", "of the slice"}}, plan.area);
  visit({"phi_max_rad", {"rad", "angle of the bucket at the end of the curl"}}, plan.phi_max);
}

template <class CycleOrConst, class Visit>
void visit_cycle_numbers(CycleOrConst& cycle, Visit&& visit) {
  visit({"t_start_s", {"s", "start of the drive-in"}}, cycle.t_start);
  visit({"t_end_s", {"s", "end of backing out"}}, cycle.t_end);
  visit({"loaded_mass_kg", {"kg", "that the bucket carries once it stands"}}, cycle.loaded_mass);
}

// Since version 8.
template <class CycleOrConst, class Visit>
void visit_left_out(CycleOrConst& cycle, Visit&& visit) {
  visit({"left_out_time_s", {"s", "of approach and way back that were not simulated"}}, cycle.left_out_time);
  visit({"left_out_energy_J", {"J", "of the wheel motors in these"}}, cycle.left_out_energy);
}

struct ArrayName {
  const char *name, *unit, *description;
};

template <class CycleOrConst, class Visit>
void visit_arrays(CycleOrConst& cycle, Visit&& visit) {
  visit({"loaded_rock_masses_kg", "kg", "of each rock that the bucket carried away"},
        cycle.loaded_rock_masses);
  visit({"planned_x_m", "m", "planned path of the bucket's tip, x"}, cycle.planned_x);
  visit({"planned_z_m", "m", "planned path of the bucket's tip, z"}, cycle.planned_z);
  visit({"contour_x_m", "m", "pile along the attacked row at the start, x"}, cycle.contour_x);
  visit({"contour_z_m", "m", "pile along the attacked row at the start, height"}, cycle.contour_z);
}

void write_plan(Writer& file, const std::string& group, const Plan& plan) {
  visit_numbers(plan, [&](const NumberName& number, double value) {
    write_number(file, group + "/" + number.name, value, &number.meaning);
  });
  file.text(group, "message", plan.message);
  file.integer(group, "feasible", plan.feasible);
  file.integer(group, "limited", plan.limited);
  file.integer(group, "row", plan.row);
  file.integer(group, "curl", static_cast<int>(plan.curl));
  file.integer(group, "lift", static_cast<int>(plan.lift));
  std::vector<double> corners;
  for (const TipPose& corner : plan.corners) corners.insert(corners.end(), {corner.x, corner.z, corner.phi});
  const std::string path = group + "/corners_x_z_phi";
  file.array(path, std::span<const double>(corners), {plan.corners.size(), 3});
  file.describe(
      path, "m, m, rad",
      "corners A to E of the planned path: tip x and z, angle of the bucket's bottom, nose up positive",
      world_frame);
}

Plan read_plan(const Reader& file, const std::string& group) {
  Plan plan;
  visit_numbers(
      plan, [&](const NumberName& number, double& value) { value = read_number(file, group, number.name); });
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
  table.columns = {{"stage", "1", "1 drive-in, 2 lift, 3 curl, 4 back out"},
                   {"reason", "1", "why it ended: 0 goal, 1 time-out, 2 a drive too slow"},
                   {"t_start", "s", "from the start of the run"},
                   {"t_end", "s", "from the start of the run"},
                   {"progress", "1", "of its way when it ended, 0 to 1"},
                   {"start_x", "m", "tip at the start, into the drift"},
                   {"start_z", "m", "tip at the start, above the floor"},
                   {"start_phi", "rad", "bucket's bottom at the start, edge up positive"},
                   {"end_x", "m", "tip at the end, into the drift"},
                   {"end_z", "m", "tip at the end, above the floor"},
                   {"end_phi", "rad", "bucket's bottom at the end, edge up positive"}};
  for (const StageResult& s : stages)
    table.append_row(std::vector<double>{static_cast<double>(s.stage), static_cast<double>(s.reason),
                                         s.t_start, s.t_end, s.progress, s.start.x, s.start.z, s.start.phi,
                                         s.end.x, s.end.z, s.end.phi});
  return table;
}

/// A whole number within bounds, which names of stages are looked up by.
int stage_code(const Reader& file, const std::string& data, double value, int least, int most) {
  require_fit(file, value >= least && value <= most && value == static_cast<int>(value), data,
              "whole numbers from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(value);
}

std::vector<StageResult> stages_of(const Reader& file, const std::string& data) {
  const Table table = file.table(data);
  constexpr int last_stage = static_cast<int>(Stage::finished),
                last_end = static_cast<int>(StageEnd::slow_actuator);
  std::vector<StageResult> stages;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const auto at = [&](const char* name) { return table.at(k, table.index(name)); };
    stages.push_back(
        {.stage = static_cast<Stage>(stage_code(file, data + "/stage", at("stage"), 1, last_stage)),
         .reason = static_cast<StageEnd>(stage_code(file, data + "/reason", at("reason"), 0, last_end)),
         .t_start = at("t_start"),
         .t_end = at("t_end"),
         .progress = at("progress"),
         .start = {at("start_x"), at("start_z"), at("start_phi")},
         .end = {at("end_x"), at("end_z"), at("end_phi")}});
  }
  return stages;
}

}  // namespace

void write_cycle(Writer& file, const std::string& group, const CycleRecord& cycle) {
  const auto nx = static_cast<std::size_t>(std::max(cycle.columns_x, 0));
  const auto ny = static_cast<std::size_t>(std::max(cycle.columns_y, 0));
  if (cycle.column_heights.size() != nx * ny)
    contradiction(group + " has " + std::to_string(cycle.column_heights.size()) + " column heights for " +
                  std::to_string(nx) + " x " + std::to_string(ny) + " columns");
  file.integer(group, "number", cycle.number);
  const auto write = [&](const NumberName& number, double value) {
    write_number(file, group + "/" + number.name, value, &number.meaning);
  };
  visit_cycle_numbers(cycle, write);
  visit_left_out(cycle, write);
  visit_arrays(cycle, [&](const ArrayName& data, const std::vector<double>& values) {
    const std::string path = group + "/" + data.name;
    file.array(path, std::span(values));
    file.describe(path, data.unit, data.description, data.unit == std::string("m") ? world_frame : "");
  });
  const std::string heights = group + "/column_heights_m", stages = group + "/stages";
  file.array(heights, std::span(cycle.column_heights), {ny, nx});
  file.describe(heights, "m",
                "top of the pile at the start, mean over each column: rows along y, columns along x",
                world_frame);
  file.table(stages, stage_table(cycle.stages));
  file.describe(stages + "/values", "stages/units",
                "a row per stage of the cycle, a column per name in stages/columns", world_frame);
  write_plan(file, group + "/plan", cycle.plan);
}

CycleRecord read_cycle(const Reader& file, const std::string& group) {
  CycleRecord cycle;
  cycle.number = static_cast<int>(file.integer(group, "number"));
  const auto read = [&](const NumberName& number, double& value) {
    value = read_number(file, group, number.name);
  };
  visit_cycle_numbers(cycle, read);
  if (file.version() >= 8) visit_left_out(cycle, read);
  visit_arrays(cycle, [&](const ArrayName& data, std::vector<double>& values) {
    values = file.doubles(group + "/" + data.name).values;
  });
  auto heights = file.doubles(group + "/column_heights_m");
  require_fit(file, heights.shape.size() == 2, group + "/column_heights_m", "a matrix, ny x nx");
  cycle.columns_y = static_cast<int>(heights.shape[0]);
  cycle.columns_x = static_cast<int>(heights.shape[1]);
  cycle.column_heights = std::move(heights.values);
  cycle.stages = stages_of(file, group + "/stages");
  cycle.plan = read_plan(file, group + "/plan");
  return cycle;
}

}  // namespace drawpoint::engine::loading
