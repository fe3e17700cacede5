// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/log/log_parts.h>
#include <algorithm>
#include <limits>

namespace drawpoint::engine::loading {
namespace {

using record::Reader;
using record::Writer;

void write_bodies(Writer& file, const SceneRecord& scene) {
  std::vector<std::int32_t> shape;
  std::vector<double> opacity, mass;
  std::vector<std::string> color, name;
  for (const SceneBody& body : scene.bodies) {
    if (body.shape < 0 || static_cast<std::size_t>(body.shape) >= scene.shapes.size())
      contradiction("scene body \"" + body.name + "\" has shape " + std::to_string(body.shape) + " of " +
                    std::to_string(scene.shapes.size()));
    shape.push_back(body.shape);
    opacity.push_back(body.opacity);
    mass.push_back(body.mass);
    color.push_back(body.color);
    name.push_back(body.name);
  }
  file.array("scene/bodies/shape", std::span<const std::int32_t>(shape));
  file.array("scene/bodies/opacity", std::span<const double>(opacity));
  file.array("scene/bodies/mass_kg", std::span<const double>(mass));
  file.texts("scene/bodies/color", color);
  file.texts("scene/bodies/name", name);
  file.describe("scene/bodies/shape", "1", "number of the body's shape in scene/shapes");
  file.describe("scene/bodies/opacity", "1", "0 clear to 1 solid");
  file.describe("scene/bodies/mass_kg", "kg", "of a rock; NaN for what is no rock");
  file.describe("scene/bodies/color", "1", "#rrggbb");
  file.describe("scene/bodies/name", "1", "part of the machine, of the drift, or rock");
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
  std::vector<double> t, bucket_mass;
  std::vector<std::int32_t> cycle;
  std::vector<std::string> label;
  const std::size_t numbers = values_per_pose * scene.bodies.size();
  for (const SceneFrame& frame : scene.frames) {
    if (frame.poses.size() != numbers)
      contradiction("a scene frame has " + std::to_string(frame.poses.size()) + " pose numbers for " +
                    std::to_string(scene.bodies.size()) + " bodies");
    t.push_back(frame.t);
    bucket_mass.push_back(frame.bucket_mass);
    cycle.push_back(frame.cycle);
    label.push_back(frame.label);
  }
  const std::vector<float> poses = frames_last(scene.frames, numbers);
  file.array("scene/frames/t_s", std::span<const double>(t));
  file.array("scene/frames/cycle", std::span<const std::int32_t>(cycle));
  file.texts("scene/frames/label", label);
  file.array("scene/frames/poses", std::span<const float>(poses),
             {scene.bodies.size(), values_per_pose, scene.frames.size()});
  file.array("scene/frames/bucket_mass_kg", std::span<const double>(bucket_mass));
  file.describe("scene/frames/t_s", "s", "time of each frame");
  file.describe("scene/frames/cycle", "1", "number of the cycle, from 1; 0: none");
  file.describe("scene/frames/label", "1", "stage of the cycle, or what the frame shows");
  file.describe("scene/frames/poses", "m, 1",
                "body, then x y z qw qx qy qz of its centre of mass, then frame; NaN: not shown",
                world_frame);
  file.describe("scene/frames/bucket_mass_kg", "kg", "rocks whose centre is in the heaped bucket");
}

// NaN in a log of version 4, which has no such data.
std::vector<double> since_version_5(const Reader& file, const std::string& path, std::size_t count) {
  if (file.version() < 5) return std::vector<double>(count, std::numeric_limits<double>::quiet_NaN());
  return file.doubles(path).values;
}

void read_bodies(const Reader& file, SceneRecord& scene) {
  const auto shape = file.integers("scene/bodies/shape").values;
  const auto opacity = file.doubles("scene/bodies/opacity").values;
  const auto color = file.texts("scene/bodies/color"), name = file.texts("scene/bodies/name");
  const auto mass = since_version_5(file, "scene/bodies/mass_kg", shape.size());
  const std::string one_each = std::to_string(shape.size()) + ", one per body";
  require_fit(file, opacity.size() == shape.size(), "scene/bodies/opacity", one_each);
  require_fit(file, mass.size() == shape.size(), "scene/bodies/mass_kg", one_each);
  require_fit(file, color.size() == shape.size(), "scene/bodies/color", one_each);
  require_fit(file, name.size() == shape.size(), "scene/bodies/name", one_each);
  for (std::size_t k = 0; k < shape.size(); ++k) {
    require_fit(file, shape[k] >= 0 && static_cast<std::size_t>(shape[k]) < scene.shapes.size(),
                "scene/bodies/shape", "numbers below the " + std::to_string(scene.shapes.size()) + " shapes");
    scene.bodies.push_back({shape[k], color[k], opacity[k], name[k], mass[k]});
  }
}

void read_frames(const Reader& file, SceneRecord& scene) {
  const auto t = file.doubles("scene/frames/t_s").values;
  const auto cycle = file.integers("scene/frames/cycle").values;
  const auto label = file.texts("scene/frames/label");
  const auto poses = file.floats("scene/frames/poses").values;
  const auto bucket_mass = since_version_5(file, "scene/frames/bucket_mass_kg", t.size());
  const std::string one_each = std::to_string(t.size()) + ", one per frame";
  require_fit(file, cycle.size() == t.size(), "scene/frames/cycle", one_each);
  require_fit(file, label.size() == t.size(), "scene/frames/label", one_each);
  require_fit(file, bucket_mass.size() == t.size(), "scene/frames/bucket_mass_kg", one_each);
  const std::size_t numbers = values_per_pose * scene.bodies.size();
  require_fit(file, poses.size() == numbers * t.size(), "scene/frames/poses", "7 numbers per body and frame");
  for (std::size_t f = 0; f < t.size(); ++f) {
    SceneFrame frame{t[f], cycle[f], label[f], std::vector<float>(numbers), bucket_mass[f]};
    for (std::size_t k = 0; k < numbers; ++k) frame.poses[k] = poses[k * t.size() + f];
    scene.frames.push_back(std::move(frame));
  }
}

}  // namespace

void write_scene(Writer& file, const SceneRecord& scene) {
  file.group("scene/shapes");
  for (std::size_t k = 0; k < scene.shapes.size(); ++k) {
    std::vector<double> vertices;
    for (const Eigen::Vector3d& v : scene.shapes[k].vertices())
      vertices.insert(vertices.end(), {v.x(), v.y(), v.z()});
    file.array(numbered("scene/shapes", k), std::span<const double>(vertices), {vertices.size() / 3, 3});
    file.describe(numbered("scene/shapes", k), "m", "corners of a convex body, x y z each",
                  "body: origin at the centre of mass of the part or rock that has this shape");
  }
  write_bodies(file, scene);
  write_frames(file, scene);
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

}  // namespace drawpoint::engine::loading
