// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/options/output_file.h>
#include <drawpoint/studies/commands/options/points.h>
#include <drawpoint/studies/run/points/point_table.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/folder.h>

namespace drawpoint::studies {
namespace {

Eigen::MatrixXd asked_points(const doe::Problem& problem, const PredictSettings& asked) {
  if (asked.x.empty() && asked.points.empty())
    throw UsageError("predict: give points with --x, or a table of them with --points");
  if (asked.points.empty()) return checked_points(problem, asked.x);
  Eigen::MatrixXd points = points_of_table(asked.points, "--points", problem);
  if (asked.x.empty()) return points;
  const Eigen::MatrixXd typed = checked_points(problem, asked.x);
  points.conservativeResize(points.rows() + typed.rows(), points.cols());
  points.bottomRows(typed.rows()) = typed;
  return points;
}

}  // namespace

int predict_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  const Eigen::MatrixXd points = asked_points(study.problem, settings.predict);
  ExportSettings wanted = settings.exported;
  wanted.file = output_file(folder, wanted.file);
  const Store store = open_store(study, folder);
  write_table(study, predictions_table(store.identity(), store.runs(), points), wanted);
  return 0;
}

}  // namespace drawpoint::studies
