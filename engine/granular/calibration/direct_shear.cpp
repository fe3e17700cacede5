// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/calibration/direct_shear.hpp>

#include <drawpoint/engine/granular/calibration/test_run.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/geometry/mass_properties.hpp>
#include <drawpoint/engine/granular/heap_surface.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::granular {
namespace {

using Eigen::Vector3d;

// The upper walls pass over the lower ones by this, 1 cm for rocks of 0.3 m: less than any rock and more than
// what a wall is pressed in [m].
double cut_for(double mean_length) { return mean_length / 30; }

[[noreturn]] void refuse_shear(const std::string& what) {
  throw std::invalid_argument("granular::direct_shear: " + what);
}

double checked_length(const ShearOptions& o, double L) {
  if (!(all_finite({o.box.length, o.box.width, o.box.height}) &&
        std::min({o.box.length, o.box.width, o.box.height}) >= 2))
    refuse_shear("a box of " + std::to_string(o.box.length) + " x " + std::to_string(o.box.width) + " x " +
                 std::to_string(o.box.height) + " largest rocks; give at least 2 each way");
  if (!(all_finite({o.travel, o.speed, o.stress}) && std::min({o.travel, o.speed, o.stress}) > 0 &&
        o.travel <= 0.5 && o.parts >= 6))
    refuse_shear("travel " + std::to_string(o.travel) + " of the length at " + std::to_string(o.speed) +
                 " m/s under " + std::to_string(o.stress) + " Pa in " + std::to_string(o.parts) +
                 " parts; allowed: travel up to 0.5, positive speed and stress, at least 6 parts");
  return o.box.length * L;
}

double degrees(double ratio) { return std::atan(ratio) * 180 / M_PI; }

struct Sums {
  double tangential = 0, normal = 0, rise = 0, way = 0;
  int steps = 0;
};

// Sums over the parts of the way, from the box as it stands.
class Recorder {
 public:
  Recorder(ShearBox& box, const ShearOptions& o)
      : box_(box),
        start_(box.upper().pose().translation().x()),
        height_(box.plate_height()),
        part_(o.travel * box.length() / o.parts),
        sums_(static_cast<std::size_t>(o.parts)) {}

  void note() {
    const double way = box_.upper().pose().translation().x() - start_;
    const int k = std::min(static_cast<int>(way / part_), static_cast<int>(sums_.size()) - 1);
    Sums& s = sums_[static_cast<std::size_t>(k)];
    s.tangential += box_.tangential();
    s.normal += box_.normal();
    s.rise += box_.plate_height() - height_;
    s.way += way;
    ++s.steps;
  }

  std::vector<ShearPoint> curve() const {
    std::vector<ShearPoint> points;
    for (const Sums& s : sums_)
      if (s.steps > 0) points.push_back({s.way / s.steps, s.tangential / s.normal, s.rise / s.steps});
    return points;
  }
  double mean_normal() const {
    double normal = 0;
    int steps = 0;
    for (const Sums& s : sums_) {
      normal += s.normal;
      steps += s.steps;
    }
    return normal / std::max(1, steps);
  }

 private:
  ShearBox& box_;
  double start_, height_, part_;
  std::vector<Sums> sums_;
};

}  // namespace

ShearBox::ShearBox(const RockSample& sample, const ShearOptions& o)
    : length_(checked_length(o, largest(sample.sizes))),
      width_(o.box.width * largest(sample.sizes)),
      height_(o.box.height * largest(sample.sizes)),
      mean_length_(mean_length(sample.sizes)),
      world_(o.world, calibration_materials(sample.contact)),
      upper_(Eigen::Isometry3d::Identity()) {
  const double cut = cut_for(mean_length_), middle = 0.5 * height_,
               thick = o.travel * length_ + 0.2 * length_;
  add_wall(world_, Vector3d::UnitZ(), 0, rough);
  for (double side : {-1.0, 1.0}) add_wall(world_, side * Vector3d::UnitY(), 0.5 * width_, smooth);
  // The lower walls carry what moves over them, the upper ones cover what they leave behind.
  const Vector3d low(0.5 * thick, 0.5 * width_, 0.5 * middle - 0.25 * cut);
  const double x = 0.5 * (length_ + thick);
  add_block(world_, low, {-x, 0, low.z()}, smooth);
  front_ = add_block(world_, low, {x, 0, low.z()}, smooth);
  world_.attach(&upper_);
  const Vector3d high(0.5 * thick, 0.5 * width_ - 0.5 * cut, height_);
  for (double side : {-1.0, 1.0})
    world_.add_part_shape(0, shape_of(engine::box(high)),
                          Eigen::Isometry3d(Eigen::Translation3d(side * x, 0, middle + 0.5 * cut + high.z())),
                          smooth);
}

void ShearBox::load(double stress) {
  const double cut = cut_for(mean_length_), thick = 0.1 * length_;
  const Vector3d half(0.5 * length_ - cut, 0.5 * width_ - cut, 0.5 * thick);
  const auto heights = surface_heights(world_, {-half.x(), half.x(), -half.y(), half.y()}, mean_length_ / 12);
  const double bottom = *std::max_element(heights.begin(), heights.end()), least = 0.6 * height_,
               most = 2 * height_ - thick;
  if (!(bottom >= least && bottom <= most))
    refuse_shear("rock stands " + std::to_string(bottom) + " m high in a box of " + std::to_string(height_) +
                 " m; fill it between " + std::to_string(least) + " and " + std::to_string(most) + " m");
  const auto shape = engine::box(half);
  const double weight = stress * length_ * width_, g = world_.options().gravity.norm();
  const auto properties = engine::mass_properties(shape, weight / g / shape.volume());
  plate_ = world_.add_rock({shape_of(shape), properties.mass, properties.inertia.diagonal(), rough},
                           Eigen::Isometry3d(Eigen::Translation3d(0, 0, bottom + half.z() + 1e-3)));
}

double ShearBox::tangential() const { return -upper_.contact_wrench().force.x(); }

double ShearBox::normal() const {
  const double g = world_.options().gravity.norm();
  double force = 0;
  for (const engine::Rock& rock : world_.rocks())
    if (rock.present && rock.pose.translation().z() > 0.5 * height_) force += rock.body.mass * g;
  const engine::SurfaceOwner front{engine::Owner::fixed, front_};
  for (const engine::PairForce& pair : world_.pair_forces()) {
    if (pair.b.owner != engine::Owner::rock && pair.a.owner != engine::Owner::rock) continue;
    if (pair.a == front) force -= pair.force.z();
    if (pair.b == front) force += pair.force.z();
  }
  return force;
}

double ShearBox::plate_height() const { return world_.rock(plate_).pose.translation().z(); }

ShearResult shear(ShearBox& box, const ShearOptions& o) {
  TestRun run(box.world(), o);
  Recorder recorder(box, o);
  box.upper().set_velocity({o.speed, 0, 0});
  run.go_on("shear", o.travel * box.length() / o.speed, [&] { recorder.note(); });
  ShearResult result{.status = run.status(), .curve = recorder.curve()};
  if (result.curve.size() < 6) return result;
  double peak = 0, late = 0;
  const std::size_t n = result.curve.size(), first = n - n / 3;
  for (std::size_t k = 1; k + 1 < n; ++k)
    peak =
        std::max(peak, (result.curve[k - 1].ratio + result.curve[k].ratio + result.curve[k + 1].ratio) / 3);
  for (std::size_t k = first; k < n; ++k) late += result.curve[k].ratio / static_cast<double>(n - first);
  result.peak = degrees(peak);
  result.large = degrees(late);
  result.dilation = degrees(result.curve.back().rise / result.curve.back().displacement);
  result.normal_stress = recorder.mean_normal() / (box.length() * box.width());
  result.rocks = static_cast<int>(box.world().rocks().size()) - 1;
  return result;
}

ShearResult direct_shear(const RockSample& sample, const ShearOptions& o) {
  ShearBox box(sample, o);
  TestRun run(box.world(), o);
  run.pour(sample, over_box(0, {0.5 * box.length(), 0.5 * box.width()}, largest(sample.sizes)),
           loose_solid_share * sample.density * box.length() * box.width() * box.height());
  ShearResult stopped;
  stopped.status = RunStatus::stopped;
  if (run.stopped()) return stopped;
  box.load(o.stress);
  run.settle();
  if (run.stopped()) return stopped;
  ShearResult result = shear(box, o);
  if (result.status == RunStatus::completed) result.status = run.status();
  return result;
}

}  // namespace drawpoint::engine::granular
