// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/calibration/tilting_box.hpp>

#include <drawpoint/engine/granular/calibration/test_run.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/granular/heap_surface.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::engine::granular {
namespace {

using Eigen::Vector3d;

constexpr double degree = M_PI / 180;
constexpr double steepest = 80;        // [deg]
constexpr double slid = 0.5;           // of a mean length: the way of a layer that slides
constexpr double share_of_end = 0.85;  // of the fill that the lower end holds back
constexpr double rib = 0.3;            // height and thickness of the floor's ribs, of a mean length
constexpr double thickness = 0.5;      // of floor and walls [m]

[[noreturn]] void refuse_tilt(const std::string& what) {
  throw std::invalid_argument("granular::tilting_box: " + what);
}

double checked_size(const TiltingBoxOptions& o, double L) {
  if (!(all_finite({o.length, o.width, o.height}) && std::min({o.length, o.width, o.height}) >= 3))
    refuse_tilt("a box of " + std::to_string(o.length) + " x " + std::to_string(o.width) + " x " +
                std::to_string(o.height) + " largest rocks; give at least 3 each way");
  if (!(std::isfinite(o.rate) && o.rate > 0))
    refuse_tilt("a rate of " + std::to_string(o.rate) + " deg/s; give more than 0, 1 is usual");
  return o.length * L;
}

/// The rocks at the top of the bed and where they lay in the box before it turned.
class UpperLayer {
 public:
  explicit UpperLayer(TiltingBox& box) : box_(box) {
    const Area middle{-box.length() + box.largest(), -box.largest(), -box.width() / 2, box.width() / 2};
    const double bottom = mean_height(box.world(), middle, box.mean_length() / 6) - box.largest();
    for (int k = 0; k < static_cast<int>(box.world().rocks().size()); ++k) {
      const Vector3d p = box.inside(box.world().rock(k).pose.translation());
      if (box.world().rock(k).present && p.z() > bottom && p.x() > middle.x0 && p.x() < middle.x1) {
        rocks_.push_back(k);
        start_.push_back(p.x());
        way_.push_back(0);
      }
    }
    if (rocks_.empty()) refuse_tilt("no rock lies in the middle of the box; fill it");
  }

  /// Median way down the slope [m]; of a rock that fell out, up to there.
  double way() {
    for (std::size_t k = 0; k < rocks_.size(); ++k) {
      const engine::Rock& rock = box_.world().rock(rocks_[k]);
      if (rock.present) way_[k] = box_.inside(rock.pose.translation()).x() - start_[k];
    }
    std::vector<double> ways = way_;
    const auto middle = ways.begin() + static_cast<std::ptrdiff_t>(ways.size() / 2);
    std::nth_element(ways.begin(), middle, ways.end());
    return *middle;
  }

 private:
  TiltingBox& box_;
  std::vector<int> rocks_;
  std::vector<double> start_, way_;
};

}  // namespace

TiltingBox::TiltingBox(const RockSample& sample, const TiltingBoxOptions& o)
    : length_(checked_size(o, granular::largest(sample.sizes))),
      width_(o.width * granular::largest(sample.sizes)),
      height_(o.height * granular::largest(sample.sizes)),
      mean_length_(granular::mean_length(sample.sizes)),
      largest_(granular::largest(sample.sizes)),
      rate_(o.rate * degree),
      world_(o.world, calibration_materials(sample.contact)),
      box_(Eigen::Isometry3d::Identity()) {
  world_.attach(&box_);
  const auto add = [&](const Vector3d& half, const Vector3d& centre, int kind) {
    world_.add_part_shape(0, shape_of(engine::box(half)), Eigen::Isometry3d(Eigen::Translation3d(centre)),
                          kind);
  };
  const double half = thickness / 2, end = share_of_end * height_ / 2, back = 1.5 * height_ / 2;
  add({length_ / 2, width_, half}, {-length_ / 2, 0, -half}, rough);
  for (double x = -0.5 * mean_length_; o.ribs && x > -length_; x -= mean_length_)
    add(0.5 * rib * mean_length_ * Vector3d(1, 2 * width_ / (rib * mean_length_), 1),
        {x, 0, 0.5 * rib * mean_length_}, rough);
  add({half, width_, end}, {half, 0, end}, smooth);
  add({half, width_, back}, {-length_ - half, 0, back}, smooth);
  for (double side : {-1.0, 1.0}) add_wall(world_, side * Vector3d::UnitY(), width_ / 2, smooth);
}

void TiltingBox::turn() { box_.set_velocity(Vector3d::Zero(), {0, rate_, 0}); }
void TiltingBox::stop() { box_.set_velocity(Vector3d::Zero()); }

double TiltingBox::tilt() const {
  const Vector3d x = box_.pose().linear().col(0);
  return std::atan2(-x.z(), x.x());
}

TiltResult tilt(TiltingBox& box, const RunOptions& o) {
  TestRun run(box.world(), o);
  UpperLayer layer(box);
  TiltResult result;
  for (const engine::Rock& rock : box.world().rocks()) result.rocks += rock.present ? 1 : 0;
  box.turn();
  run.go_until("tilt", steepest * degree / box.rate(), [&] {
    remove_fallen(box.world());
    if (layer.way() < slid * box.mean_length()) return false;
    result.start = box.tilt() / degree;
    return true;
  });
  box.stop();
  result.status = run.status();
  return result;
}

TiltResult tilting_box(const RockSample& sample, const TiltingBoxOptions& o) {
  TiltingBox box(sample, o);
  TestRun run(box.world(), o);
  run.pour(sample, over_box(-box.length() / 2, {0.5 * box.length(), 0.5 * box.width()}, box.largest()),
           loose_solid_share * sample.density * box.length() * box.width() * box.height(),
           [&] { remove_fallen(box.world()); });
  if (run.stopped()) return {.status = RunStatus::stopped};
  TiltResult result = tilt(box, o);
  if (result.status == RunStatus::completed) result.status = run.status();
  return result;
}

}  // namespace drawpoint::engine::granular
