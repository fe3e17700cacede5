// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/scene_recorder.h>
#include <cmath>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <limits>

namespace drawpoint::engine::loading {
namespace {

using engine::ConvexPolyhedron;

constexpr int wheel_sides = 32;
const char* rock_colors[] = {"#6b6f76", "#7d7468", "#8a8378", "#5e6066", "#77706a", "#6f7a80"};

ConvexPolyhedron drawable(const engine::Shape& shape) {
  if (const auto* cylinder = std::get_if<engine::Cylinder>(&shape))
    return engine::prism(cylinder->radius, cylinder->half_width, wheel_sides);
  return std::get<ConvexPolyhedron>(shape);
}

ConvexPolyhedron block(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return engine::box(0.5 * (high - low))
      .transformed(Eigen::Isometry3d(Eigen::Translation3d(0.5 * (low + high))));
}

// A picture needs no more, and a rock that trembles by less is one that stands still: its numbers repeat.
constexpr double parts_per_metre = 512, parts_of_unit_quaternion = 1024;

float rounded_to(double value, double parts) { return static_cast<float>(std::round(value * parts) / parts); }

void append_pose(std::vector<float>& poses, const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  for (double place : X.translation()) poses.push_back(rounded_to(place, parts_per_metre));
  for (double value : {q.w(), q.x(), q.y(), q.z()})
    poses.push_back(rounded_to(value, parts_of_unit_quaternion));
}

void append_hidden(std::vector<float>& poses) {
  poses.insert(poses.end(), values_per_pose, std::numeric_limits<float>::quiet_NaN());
}

}  // namespace

SceneRecorder::SceneRecorder(const Site& site, const Drift& d, SceneRecord& scene) : scene_(scene) {
  for (const LhdSurface& s : site.lhd().surfaces) {
    scene_.bodies.push_back(
        {static_cast<int>(scene_.shapes.size()), s.color, 1.0, site.lhd().spec.bodies[s.body].name});
    scene_.shapes.push_back(drawable(s.shape));
  }
  machine_bodies_ = scene_.bodies.size();
  const double w = d.width / 2, back = d.length - 18, hole = d.raise_axis().x() - d.raise_radius;
  const auto fixed = [&](const ConvexPolyhedron& shape, const char* color, double opacity, const char* name) {
    scene_.bodies.push_back({static_cast<int>(scene_.shapes.size()), color, opacity, name});
    scene_.shapes.push_back(shape);
  };
  fixed(block({back, -w, -0.1}, {d.length, w, 0}), "#9b958c", 1.0, "floor");
  fixed(block({back, w, 0}, {d.length, w + 0.1, d.height}), "#a39d94", 0.18, "left wall");
  fixed(block({back, -w - 0.1, 0}, {d.length, -w, d.height}), "#a39d94", 0.10, "right wall");
  fixed(block({d.length, -w, 0}, {d.length + 0.1, w, d.height}), "#8c867d", 0.6, "back wall");
  fixed(block({back, -w, d.height}, {hole, w, d.height + 0.1}), "#a39d94", 0.12, "roof");
  fixed_bodies_ = scene_.bodies.size() - machine_bodies_;
  add_rocks(site);
}

int SceneRecorder::shape_of(const granular::RockSpec& spec) {
  const auto key = std::make_pair(spec.shape, spec.size);
  const auto found = rock_shapes_.find(key);
  if (found != rock_shapes_.end()) return found->second;
  scene_.shapes.push_back(granular::rock_shapes()[spec.shape].scaled(spec.size));
  return rock_shapes_[key] = static_cast<int>(scene_.shapes.size()) - 1;
}

void SceneRecorder::add_rocks(const Site& site) {
  for (; rocks_ < site.world().rocks().size(); ++rocks_)
    scene_.bodies.push_back({shape_of(site.specs()[rocks_]), rock_colors[rocks_ % 6], 1.0, "rock",
                             site.world().rocks()[rocks_].body.mass});
}

void SceneRecorder::frame(const Site& site, int cycle, const std::string& label) {
  add_rocks(site);
  SceneFrame frame{site.world().time(), cycle, label, {}, site.mass_in_bucket()};
  for (std::size_t k = 0; k < machine_bodies_; ++k)
    append_pose(frame.poses, site.machine().pose(site.lhd().surfaces[k].body));
  for (std::size_t k = 0; k < fixed_bodies_; ++k) append_pose(frame.poses, Eigen::Isometry3d::Identity());
  for (const engine::Rock& rock : site.world().rocks()) {
    if (rock.present)
      append_pose(frame.poses, rock.pose);
    else
      append_hidden(frame.poses);
  }
  scene_.frames.push_back(std::move(frame));
}

void SceneRecorder::complete() {
  for (SceneFrame& frame : scene_.frames)
    while (frame.poses.size() < values_per_pose * scene_.bodies.size()) append_hidden(frame.poses);
}

}  // namespace drawpoint::engine::loading
