// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/log/logged_bucket.h>
#include <cmath>
#include <drawpoint/engine/loading/lhd.hpp>
#include <drawpoint/engine/loading/log/rock_left.hpp>
#include <drawpoint/engine/loading/log/scene_motion.hpp>
#include <drawpoint/engine/loading/strategy/column_model.hpp>
#include <stdexcept>

namespace drawpoint::engine::loading {
namespace {

double number_of(const LoadingLog& log, const char* name) {
  const auto found = log.numbers.find(name);
  if (found == log.numbers.end())
    throw std::invalid_argument("loading::rock_left: the log has no number \"" + std::string(name) +
                                "\"; give the log of a run of version 5 or later");
  return found->second;
}

Eigen::Isometry3d pose_of(const ScenePose& p) {
  Eigen::Isometry3d X(Eigen::Quaterniond(p[3], p[4], p[5], p[6]).normalized());
  X.translation() = Eigen::Vector3d(p[0], p[1], p[2]);
  return X;
}

int last_frame(const SceneRecord& scene, int cycle) {
  int last = -1;
  for (std::size_t k = 0; k < scene.frames.size(); ++k)
    if (scene.frames[k].cycle == cycle) last = static_cast<int>(k);
  if (last < 0 || scene.knots.empty())
    throw std::invalid_argument("loading::rock_left: the log has no pictures of cycle " +
                                std::to_string(cycle) + "; read it with its scene");
  return last;
}

int bucket_of_scene(const SceneRecord& scene) {
  for (std::size_t k = 0; k < scene.bodies.size(); ++k)
    if (scene.bodies[k].name == "bucket" && scene.bodies[k].with < 0) return static_cast<int>(k);
  throw std::invalid_argument(
      "loading::rock_left: the log's scene has no bucket; give the log of a simulated run");
}

// Rocks that are not in the bucket at the end of a cycle.
std::vector<PosedRock> rocks_outside(const LoadingLog& log, const Lhd& lhd, int frame) {
  const SceneRecord& scene = log.scene;
  const auto bucket = pose_in(scene, bucket_of_scene(scene), frame);
  std::vector<PosedRock> rocks;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    if (std::isnan(scene.bodies[k].mass)) continue;
    const auto pose = pose_in(scene, static_cast<int>(k), frame);
    if (!pose) continue;
    const Eigen::Isometry3d X = pose_of(*pose);
    if (bucket && in_heaped_bucket(lhd, pose_of(*bucket).inverse() * X.translation() +
                                            lhd.spec.bodies[static_cast<std::size_t>(lhd.bucket)].centre))
      continue;
    rocks.push_back(
        {&scene.shapes[static_cast<std::size_t>(scene.bodies[k].shape)], X, scene.bodies[k].mass});
  }
  return rocks;
}

// Strip by strip, the x of the first empty column from the wall outward.
std::vector<double> literal_fronts(const ColumnModel& model) {
  std::vector<double> fronts;
  for (Eigen::Index j = 0; j < model.heights.cols(); ++j) {
    Eigen::Index i = model.heights.rows() - 1;
    while (i >= 0 && model.heights(i, j) > model.options.h_tol) --i;
    fronts.push_back(model.grid.x(static_cast<double>(i) + 0.5));
  }
  return fronts;
}

RockLeft left_of(const std::vector<PosedRock>& rocks, const ColumnModel& model, const Plan& plan) {
  const std::vector<double> fronts = literal_fronts(model);
  RockLeft left;
  for (const PosedRock& rock : rocks) {
    const Eigen::Vector3d centre = rock.pose.translation();
    if (lies_in_front(model, centre) && std::abs(centre.y() - plan.y) <= 0.5 * model.options.bucket_width)
      left.in_lane += rock.mass;
    const double strip = std::floor(centre.y() / model.grid.cell + 0.5 * model.grid.ny());
    if (strip >= 0 && strip < static_cast<double>(fronts.size()) &&
        centre.x() < fronts[static_cast<std::size_t>(strip)])
      left.before_front += rock.mass;
  }
  return left;
}

}  // namespace

std::vector<RockLeft> rock_left_by_cycle(const LoadingLog& log) {
  const Lhd lhd = sandvik_lh621({.bucket = logged_bucket(log).value_or(BucketOptions{})});
  const ColumnGrid grid{.x_max = number_of(log, "drift_length"),
                        .half_width = number_of(log, "drift_width") / 2};
  const ColumnOptions options{.bucket_width = lhd.bucket_width, .bucket_volume = lhd.bucket_volume};
  std::vector<RockLeft> left;
  for (const CycleRecord& cycle : log.cycles) {
    const auto rocks = rocks_outside(log, lhd, last_frame(log.scene, cycle.number));
    left.push_back(left_of(rocks, column_model(rocks, grid, options), cycle.plan));
  }
  return left;
}

RockLeft rock_left(const LoadingLog& log) {
  RockLeft mean;
  for (const RockLeft& left : rock_left_by_cycle(log)) {
    mean.in_lane += left.in_lane;
    mean.before_front += left.before_front;
  }
  mean.in_lane /= static_cast<double>(log.cycles.size());
  mean.before_front /= static_cast<double>(log.cycles.size());
  return mean;
}

}  // namespace drawpoint::engine::loading
