// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_panels.h>
#include <drawpoint/studies/loading/loading_plan_view.h>
#include <drawpoint/engine/loading/strategy/column_model.hpp>

namespace drawpoint::studies {

using engine::loading::ColumnGrid;
using engine::loading::ColumnModel;
using engine::loading::CycleRecord;
using engine::loading::LoadingLog;
using engine::loading::Strip;
using nlohmann::json;

namespace {

// The columns of the log lie where the contour's values do, which are one per column along the drift.
ColumnGrid grid_of(const LoadingLog& log, const CycleRecord& cycle) {
  ColumnGrid grid;
  grid.cell = cycle.contour_x[1] - cycle.contour_x[0];
  grid.x_min = cycle.contour_x.front() - grid.cell / 2;
  grid.x_max = grid.x_min + cycle.columns_x * grid.cell;
  grid.half_width = log.numbers.at("drift_width") / 2;
  return grid;
}

ColumnModel model_of(const LoadingLog& log, const CycleRecord& cycle) {
  engine::loading::ColumnOptions options;
  options.bucket_width = log.numbers.at("bucket_width");
  options.bucket_volume = log.numbers.at("bucket_heaped_volume");
  const Eigen::Map<const Eigen::MatrixXd> heights(cycle.column_heights.data(), cycle.columns_x,
                                                  cycle.columns_y);
  return engine::loading::column_model(heights, grid_of(log, cycle), options);
}

bool has_columns(const LoadingLog& log, const CycleRecord& cycle) {
  for (const char* number : {"drift_width", "bucket_width", "bucket_heaped_volume"})
    if (!log.numbers.contains(number)) return false;
  const auto count = static_cast<std::size_t>(cycle.columns_x) * static_cast<std::size_t>(cycle.columns_y);
  return cycle.columns_x > 1 && cycle.columns_y > 0 && cycle.column_heights.size() == count &&
         cycle.contour_x.size() == static_cast<std::size_t>(cycle.columns_x) &&
         grid_of(log, cycle).ny() == cycle.columns_y;
}

// Across the drift, of the strips that have pile.
json curve(const ColumnModel& model, const char* name, double Strip::*place) {
  json x = json::array(), y = json::array();
  for (std::size_t j = 0; j < model.strips.size(); ++j) {
    if (!model.strips[j].has_pile) continue;
    x.push_back(rounded(model.strips[j].*place));
    y.push_back(rounded(model.grid.y(static_cast<double>(j))));
  }
  return {{"name", name}, {"x", x}, {"y", y}};
}

json heights_of(const ColumnModel& model) {
  json rows = json::array();
  for (Eigen::Index j = 0; j < model.heights.cols(); ++j) {
    json row = json::array();
    for (Eigen::Index i = 0; i < model.heights.rows(); ++i) row.push_back(rounded(model.heights(i, j)));
    rows.push_back(row);
  }
  return rows;
}

json middles(int count, const auto& at) {
  json places = json::array();
  for (int k = 0; k < count; ++k) places.push_back(rounded(at(k)));
  return places;
}

}  // namespace

json plan_view_panel(const LoadingLog& log, const CycleRecord& cycle, const std::string& who) {
  if (!has_columns(log, cycle)) return nullptr;
  const ColumnModel model = model_of(log, cycle);
  const auto& plan = cycle.plan;
  const double half = model.options.bucket_width / 2;
  return {{"type", "plan"},
          {"title", "The pile from above"},
          {"caption",
           who + ", from above, before it began. Each cell is a column of the pile, " +
               fixed(model.grid.cell, 2) +
               " m wide, as high as the highest rock in it. In each strip along the drift the front is "
               "where the pile begins, and the volume centre that of the columns which fill the "
               "strip's share of a heaped bucket. The bucket attacks at " +
               fixed(plan.y, 2) + " m from the middle and plans to dig " + fixed(plan.depth, 2) + " m deep."},
          {"x_label", "along the drift [m]"},
          {"y_label", "across the drift [m]"},
          {"z_label", "height [m]"},
          {"x", middles(cycle.columns_x, [&](double i) { return model.grid.x(i); })},
          {"y", middles(cycle.columns_y, [&](double j) { return model.grid.y(j); })},
          {"heights", heights_of(model)},
          {"walls", {rounded(-model.grid.half_width), rounded(model.grid.half_width)}},
          {"curves",
           {curve(model, "front", &Strip::front), curve(model, "volume centre", &Strip::volume_centre)}},
          {"place",
           {{"name", "attacked place"},
            {"x", {rounded(plan.toe), rounded(plan.toe + plan.depth)}},
            {"y", {rounded(plan.y - half), rounded(plan.y + half)}}}}};
}

}  // namespace drawpoint::studies
