// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/loading/site.hpp>
#include <map>

/// Pictures of the scene for replay: shapes once, poses per frame. Rocks that come later are hidden in
/// earlier frames.
namespace drawpoint::engine::loading {

class SceneRecorder {
 public:
  /// Into `scene`, which is to stay.
  SceneRecorder(const Site& site, const Drift& drift, SceneRecord& scene);
  void frame(const Site& site, int cycle, const std::string& label);
  /// Gives all frames a pose for every body there is; before the scene is written.
  void complete();

 private:
  int shape_of(const granular::RockSpec& spec);
  void add_rocks(const Site& site);

  SceneRecord& scene_;
  std::map<std::pair<int, double>, int> rock_shapes_;
  std::size_t machine_bodies_ = 0, fixed_bodies_ = 0, rocks_ = 0;
};

}  // namespace drawpoint::engine::loading
