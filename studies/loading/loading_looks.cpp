// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_looks.h>

#include <algorithm>
#include <array>

namespace drawpoint::studies {

using engine::loading::SceneBody;
using engine::loading::SceneRecord;
using nlohmann::json;

namespace {

constexpr std::array drift_parts{"floor", "left wall", "right wall", "back wall", "roof"};
constexpr double raise_to_back_wall = 0.3;  // that Drift leaves between them [m]

bool is_one_of(const std::string& text, const auto& all) {
  return std::find(all.begin(), all.end(), text) != all.end();
}

// machine_looks.cpp and lhd.cpp give parts their colours.
bool is_bare_metal(const std::string& color) {
  return is_one_of(color, std::array{"#5b5e63", "#8d8f94", "#d8dce2", "#4a4e55"});
}

struct Extent {
  Eigen::Vector3d low, high;
};

const SceneBody* named(const SceneRecord& scene, const char* name) {
  const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(),
                                  [&](const SceneBody& body) { return body.name == name; });
  return found == scene.bodies.end() ? nullptr : &*found;
}

Extent extent_of(const SceneRecord& scene, const SceneBody& body) {
  const auto& vertices = scene.shapes[static_cast<std::size_t>(body.shape)].vertices();
  Extent extent{vertices.front(), vertices.front()};
  for (const auto& v : vertices) {
    extent.low = extent.low.cwiseMin(v);
    extent.high = extent.high.cwiseMax(v);
  }
  return extent;
}

}  // namespace

std::string look_of(const SceneBody& body) {
  if (body.name == "rock") return "rock";
  if (is_one_of(body.name, drift_parts)) return "drift";
  if (body.name.ends_with("wheel") && body.with < 0) return "tyre";
  if (body.color == "#fff3cf") return "lamp";
  if (body.color == "#8fb4c9") return "glass";
  return is_bare_metal(body.color) ? "steel" : "paint";
}

json drift_of(const SceneRecord& scene) {
  const SceneBody *floor = named(scene, "floor"), *roof = named(scene, "roof");
  if (floor == nullptr || roof == nullptr) return nullptr;
  const Extent ground = extent_of(scene, *floor), top = extent_of(scene, *roof);
  // The roof ends where the raise begins.
  const double length = ground.high.x(), radius = (length - raise_to_back_wall - top.high.x()) / 2;
  return {{"from", ground.low.x()},
          {"length", length},
          {"width", ground.high.y() - ground.low.y()},
          {"height", top.low.z()},
          {"raise", {{"x", length - raise_to_back_wall - radius}, {"radius", radius}}}};
}

}  // namespace drawpoint::studies
