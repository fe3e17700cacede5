// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/scene_motion.hpp>
#include <drawpoint/engine/loading/site.hpp>
#include <map>

/// The scene for replay: shapes once, and poses where bodies leave the even way between them by more than the
/// scenario's frame_tolerance. Poses are rounded, to half a millimetre and 0.00012 of the quaternion for the
/// machine, to 4 mm and 0.004 for rocks unless the tolerance is 0. Each cycle begins with the poses of all;
/// rocks that come later are not shown before.
namespace drawpoint::engine::loading {

class SceneRecorder {
 public:
  /// Into `scene`, which is to stay.
  SceneRecorder(const Site& site, const Scenario& scenario, SceneRecord& scene);
  void frame(const Site& site, int cycle, const std::string& label);
  /// Puts into the scene what is still to come of the frames; before it is written.
  void complete();

 private:
  void add_machine(const Site& site);
  void add_part(const Lhd& lhd, int part, const engine::ConvexPolyhedron& shape, const std::string& color);
  void add_drift(const Drift& drift);
  void add_rocks(const Site& site);
  int shape_of(const granular::RockSpec& spec);

  SceneRecord& scene_;
  MotionTolerance of_rocks_, of_machine_;
  MotionRecorder motion_;
  std::map<std::pair<int, double>, int> rock_shapes_;
  std::map<int, int> carriers_;           // body of the machine: body of the scene that has its poses
  int first_fixed_ = 0, first_rock_ = 0;  // bodies of the scene
  std::size_t rocks_ = 0;
};

}  // namespace drawpoint::engine::loading
