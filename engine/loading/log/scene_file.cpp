// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/log/log_parts.h>
#include <drawpoint/engine/loading/log/scene_motion.hpp>
#include <limits>
#include <tuple>

namespace drawpoint::engine::loading {
namespace {

using record::Reader;
using record::Writer;

constexpr std::size_t values_per_pose = std::tuple_size_v<ScenePose>;

void require_known(std::int32_t number, std::size_t count, const char* what) {
  if (number < 0 || static_cast<std::size_t>(number) >= count)
    contradiction(std::string("a pose is of ") + what + " " + std::to_string(number) + " of " +
                  std::to_string(count));
}

void write_bodies(Writer& file, const SceneRecord& scene) {
  std::vector<std::int32_t> shape, with;
  std::vector<double> opacity, mass;
  std::vector<std::string> color, name;
  for (const SceneBody& body : scene.bodies) {
    if (body.shape < 0 || static_cast<std::size_t>(body.shape) >= scene.shapes.size())
      contradiction("scene body \"" + body.name + "\" has shape " + std::to_string(body.shape) + " of " +
                    std::to_string(scene.shapes.size()));
    if (body.with >= 0) require_known(body.with, scene.bodies.size(), "body");
    shape.push_back(body.shape);
    with.push_back(body.with);
    opacity.push_back(body.opacity);
    mass.push_back(body.mass);
    color.push_back(body.color);
    name.push_back(body.name);
  }
  file.array("scene/bodies/shape", std::span<const std::int32_t>(shape));
  file.array("scene/bodies/with", std::span<const std::int32_t>(with));
  file.array("scene/bodies/opacity", std::span<const double>(opacity));
  file.array("scene/bodies/mass_kg", std::span<const double>(mass));
  file.texts("scene/bodies/color", color);
  file.texts("scene/bodies/name", name);
  file.describe("scene/bodies/shape", "1", "number of the body's shape in scene/shapes");
  file.describe("scene/bodies/with", "1", "number of the body whose poses it takes; -1: it has its own");
  file.describe("scene/bodies/opacity", "1", "0 clear to 1 solid");
  file.describe("scene/bodies/mass_kg", "kg", "of a rock; NaN for what is no rock");
  file.describe("scene/bodies/color", "1", "#rrggbb");
  file.describe("scene/bodies/name", "1", "part of the machine, of the drift, or rock");
}

void write_frames(Writer& file, const SceneRecord& scene) {
  std::vector<double> t, bucket_mass;
  std::vector<std::int32_t> cycle;
  std::vector<std::string> label;
  for (const SceneFrame& frame : scene.frames) {
    t.push_back(frame.t);
    bucket_mass.push_back(frame.bucket_mass);
    cycle.push_back(frame.cycle);
    label.push_back(frame.label);
  }
  file.array("scene/frames/t_s", std::span<const double>(t));
  file.array("scene/frames/cycle", std::span<const std::int32_t>(cycle));
  file.texts("scene/frames/label", label);
  file.array("scene/frames/bucket_mass_kg", std::span<const double>(bucket_mass));
  file.describe("scene/frames/t_s", "s", "time of each frame");
  file.describe("scene/frames/cycle", "1", "number of the cycle, from 1; 0: none");
  file.describe("scene/frames/label", "1", "stage of the cycle, or what the frame shows");
  file.describe("scene/frames/bucket_mass_kg", "kg", "rocks whose centre is in the heaped bucket");
}

// Number by number, so that a body's neighbouring poses, which are alike, stand beside each other.
void write_knots(Writer& file, const SceneRecord& scene) {
  const std::size_t count = scene.knots.size();
  std::vector<std::int32_t> body(count), frame(count);
  std::vector<float> pose(values_per_pose * count);
  for (std::size_t k = 0; k < count; ++k) {
    const SceneKnot& knot = scene.knots[k];
    require_known(knot.body, scene.bodies.size(), "body");
    require_known(knot.frame, scene.frames.size(), "frame");
    body[k] = knot.body;
    frame[k] = knot.frame;
    for (std::size_t i = 0; i < values_per_pose; ++i) pose[i * count + k] = knot.pose[i];
  }
  file.array("scene/motion/body", std::span<const std::int32_t>(body));
  file.array("scene/motion/frame", std::span<const std::int32_t>(frame));
  file.array("scene/motion/pose", std::span<const float>(pose), {values_per_pose, count});
  file.describe("scene/motion/body", "1", "whose pose it is; by cycle, then by body, then by frame");
  file.describe("scene/motion/frame", "1",
                "frame of the pose, from 0; until the next one of the body in the "
                "cycle it goes evenly, after the last it stays");
  file.describe("scene/motion/pose", "m, 1",
                "x y z qw qx qy qz of the centre of mass, a row each, a column per pose; NaN: not shown",
                world_frame);
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
  const auto with = file.version() < 7 ? std::vector<std::int32_t>(shape.size(), -1)
                                       : file.integers("scene/bodies/with").values;
  const std::string one_each = std::to_string(shape.size()) + ", one per body";
  require_fit(file, opacity.size() == shape.size(), "scene/bodies/opacity", one_each);
  require_fit(file, mass.size() == shape.size(), "scene/bodies/mass_kg", one_each);
  require_fit(file, with.size() == shape.size(), "scene/bodies/with", one_each);
  require_fit(file, color.size() == shape.size(), "scene/bodies/color", one_each);
  require_fit(file, name.size() == shape.size(), "scene/bodies/name", one_each);
  for (std::size_t k = 0; k < shape.size(); ++k) {
    require_fit(file, shape[k] >= 0 && static_cast<std::size_t>(shape[k]) < scene.shapes.size(),
                "scene/bodies/shape", "numbers below the " + std::to_string(scene.shapes.size()) + " shapes");
    require_fit(file, with[k] >= -1 && with[k] < static_cast<std::int32_t>(shape.size()), "scene/bodies/with",
                "numbers of bodies, or -1");
    scene.bodies.push_back({shape[k], color[k], opacity[k], name[k], mass[k], with[k]});
  }
}

void read_frames(const Reader& file, SceneRecord& scene) {
  const auto t = file.doubles("scene/frames/t_s").values;
  const auto cycle = file.integers("scene/frames/cycle").values;
  const auto label = file.texts("scene/frames/label");
  const auto bucket_mass = since_version_5(file, "scene/frames/bucket_mass_kg", t.size());
  const std::string one_each = std::to_string(t.size()) + ", one per frame";
  require_fit(file, cycle.size() == t.size(), "scene/frames/cycle", one_each);
  require_fit(file, label.size() == t.size(), "scene/frames/label", one_each);
  require_fit(file, bucket_mass.size() == t.size(), "scene/frames/bucket_mass_kg", one_each);
  for (std::size_t f = 0; f < t.size(); ++f)
    scene.frames.push_back({t[f], cycle[f], label[f], bucket_mass[f]});
}

// Up to version 6 a log has a pose of every body in every frame: body, number, frame.
void read_poses_of_all_frames(const Reader& file, SceneRecord& scene) {
  const auto poses = file.floats("scene/frames/poses").values;
  const std::size_t frames = scene.frames.size();
  require_fit(file, poses.size() == values_per_pose * scene.bodies.size() * frames, "scene/frames/poses",
              "7 numbers per body and frame");
  MotionRecorder motion(scene.knots);
  for (std::size_t f = 0; f < frames; ++f) {
    if (f > 0 && scene.frames[f].cycle != scene.frames[f - 1].cycle) motion.end();
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      SceneKnot knot{static_cast<int>(b), static_cast<int>(f), {}};
      for (std::size_t i = 0; i < values_per_pose; ++i)
        knot.pose[i] = poses[(b * values_per_pose + i) * frames + f];
      motion.add(knot, scene.frames[f].t, {});
    }
  }
  motion.end();
}

void read_knots(const Reader& file, SceneRecord& scene) {
  const auto body = file.integers("scene/motion/body").values;
  const auto frame = file.integers("scene/motion/frame").values;
  const auto pose = file.floats("scene/motion/pose").values;
  const std::size_t count = body.size();
  require_fit(file, frame.size() == count, "scene/motion/frame", std::to_string(count) + ", one per pose");
  require_fit(file, pose.size() == values_per_pose * count, "scene/motion/pose", "7 numbers per pose");
  const auto below = [](std::int32_t k, std::size_t end) {
    return k >= 0 && static_cast<std::size_t>(k) < end;
  };
  for (std::size_t k = 0; k < count; ++k) {
    require_fit(file, below(body[k], scene.bodies.size()), "scene/motion/body", "numbers of bodies");
    require_fit(file, below(frame[k], scene.frames.size()), "scene/motion/frame", "numbers of frames");
    SceneKnot knot{body[k], frame[k], {}};
    for (std::size_t i = 0; i < values_per_pose; ++i) knot.pose[i] = pose[i * count + k];
    scene.knots.push_back(knot);
  }
}

// All corners in one array: an array for each shape would take more room than its numbers.
void write_shapes(Writer& file, const SceneRecord& scene) {
  std::vector<std::int32_t> shape;
  std::vector<double> corners;
  for (std::size_t k = 0; k < scene.shapes.size(); ++k)
    for (const Eigen::Vector3d& v : scene.shapes[k].vertices()) {
      shape.push_back(static_cast<std::int32_t>(k));
      corners.insert(corners.end(), {v.x(), v.y(), v.z()});
    }
  file.array("scene/shapes/shape", std::span<const std::int32_t>(shape));
  file.array("scene/shapes/corner", std::span<const double>(corners), {shape.size(), 3});
  file.describe("scene/shapes/shape", "1",
                "number of the convex shape that a corner is of, from 0; they rise");
  file.describe("scene/shapes/corner", "m", "x y z of each corner",
                "body: origin at the centre of mass of the part or rock that has this shape");
}

void add_shape(const Reader& file, const std::string& at, std::span<const double> numbers,
               SceneRecord& scene) {
  require_fit(file, numbers.size() % 3 == 0, at, "three numbers per vertex");
  std::vector<Eigen::Vector3d> vertices;
  for (std::size_t v = 0; v < numbers.size(); v += 3)
    vertices.emplace_back(numbers[v], numbers[v + 1], numbers[v + 2]);
  scene.shapes.push_back(engine::ConvexPolyhedron::hull_of(vertices));
}

void read_shapes(const Reader& file, SceneRecord& scene) {
  const auto shape = file.integers("scene/shapes/shape").values;
  const auto corners = file.doubles("scene/shapes/corner").values;
  require_fit(file, corners.size() == 3 * shape.size(), "scene/shapes/corner", "three numbers per corner");
  for (std::size_t from = 0, to = 0; from < shape.size(); from = to) {
    require_fit(file, shape[from] == static_cast<std::int32_t>(scene.shapes.size()), "scene/shapes/shape",
                "numbers that rise by one");
    while (to < shape.size() && shape[to] == shape[from]) ++to;
    add_shape(file, "scene/shapes/corner", std::span(corners).subspan(3 * from, 3 * (to - from)), scene);
  }
}

// Up to version 6 each shape has an array.
void read_shapes_one_by_one(const Reader& file, SceneRecord& scene) {
  const std::size_t shapes = file.children("scene/shapes").size();
  for (std::size_t k = 0; k < shapes; ++k) {
    const std::string at = numbered("scene/shapes", k);
    add_shape(file, at, file.doubles(at).values, scene);
  }
}

}  // namespace

void write_scene(Writer& file, const SceneRecord& scene) {
  write_shapes(file, scene);
  write_bodies(file, scene);
  write_frames(file, scene);
  write_knots(file, scene);
}

SceneRecord read_scene(const Reader& file, LogContent content) {
  SceneRecord scene;
  if (content == LogContent::without_scene) {
    read_frames(file, scene);
    return scene;
  }
  file.version() < 7 ? read_shapes_one_by_one(file, scene) : read_shapes(file, scene);
  read_bodies(file, scene);
  read_frames(file, scene);
  if (file.version() < 7)
    read_poses_of_all_frames(file, scene);
  else
    read_knots(file, scene);
  return scene;
}

}  // namespace drawpoint::engine::loading
