// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/machine_looks.h>
#include <drawpoint/engine/loading/scene_recorder.h>
#include <cmath>
#include <drawpoint/engine/granular/rock_shapes.hpp>

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

// What a metre and a quaternion's component are rounded to: fewer digits take less room.
struct Parts {
  double place, turn;
};
constexpr Parts fine{1024, 4096}, coarse{128, 128};
constexpr double share_of_machine = 0.1;  // of the tolerance

float rounded_to(double value, double parts) { return static_cast<float>(std::round(value * parts) / parts); }

ScenePose rounded_pose(const Eigen::Isometry3d& X, const Parts& parts) {
  const Eigen::Vector3d p = X.translation();
  const Eigen::Quaterniond q(X.linear());
  ScenePose pose{};
  for (int k = 0; k < 3; ++k) pose[static_cast<std::size_t>(k)] = rounded_to(p[k], parts.place);
  std::size_t k = 3;
  for (double value : {q.w(), q.x(), q.y(), q.z()}) pose[k++] = rounded_to(value, parts.turn);
  return pose;
}

}  // namespace

SceneRecorder::SceneRecorder(const Site& site, const Scenario& scenario, SceneRecord& scene)
    : scene_(scene),
      of_rocks_{scenario.frame_tolerance, scenario.frame_tolerance},
      of_machine_{share_of_machine * of_rocks_.place, share_of_machine * of_rocks_.turn},
      motion_(scene.knots) {
  add_machine(site);
  first_fixed_ = static_cast<int>(scene_.bodies.size());
  add_drift(scenario.drift);
  first_rock_ = static_cast<int>(scene_.bodies.size());
  add_rocks(site);
}

void SceneRecorder::add_machine(const Site& site) {
  const Lhd& lhd = site.lhd();
  for (const LhdSurface& s : lhd.surfaces)
    if (is_drawn_as_it_is(s)) add_part(lhd, s.body, drawable(s.shape), s.color);
  for (const DrawnPart& p : machine_looks(lhd)) add_part(lhd, p.body, p.shape, p.color);
}

// The first of a body has its poses.
void SceneRecorder::add_part(const Lhd& lhd, int part, const ConvexPolyhedron& shape,
                             const std::string& color) {
  const auto [carrier, is_first] = carriers_.emplace(part, static_cast<int>(scene_.bodies.size()));
  scene_.bodies.push_back({.shape = static_cast<int>(scene_.shapes.size()),
                           .color = color,
                           .name = lhd.spec.bodies[static_cast<std::size_t>(part)].name,
                           .with = is_first ? -1 : carrier->second});
  scene_.shapes.push_back(shape);
}

void SceneRecorder::add_drift(const Drift& d) {
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
  if (!scene_.frames.empty() && scene_.frames.back().cycle != cycle) motion_.end();
  const int number = static_cast<int>(scene_.frames.size());
  const double t = site.world().time();
  scene_.frames.push_back({t, cycle, label, site.mass_in_bucket()});
  for (const auto& [part, body] : carriers_)
    motion_.add({body, number, rounded_pose(site.machine().pose(part), fine)}, t, of_machine_);
  for (int body = first_fixed_; body < first_rock_; ++body)
    motion_.add({body, number, rounded_pose(Eigen::Isometry3d::Identity(), fine)}, t, of_machine_);
  int body = first_rock_;
  const Parts& parts = of_rocks_.place > 0 ? coarse : fine;
  for (const engine::Rock& rock : site.world().rocks())
    motion_.add({body++, number, rock.present ? rounded_pose(rock.pose, parts) : hidden_pose}, t, of_rocks_);
}

void SceneRecorder::complete() { motion_.end(); }

}  // namespace drawpoint::engine::loading
