// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <drawpoint/engine/collision/fcl_axis.h>
#include <drawpoint/engine/collision/fcl_signed_distance.h>
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>
#include <exception>

namespace drawpoint::engine::detail {

class FclShape : public fcl::Convexd {
 public:
  using fcl::Convexd::Convexd;
};

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

std::shared_ptr<const FclShape> fcl_shape_of(const CollisionHull& hull) {
  const auto faces = std::make_shared<std::vector<int>>();
  for (int f = 0; f < hull.face_count(); ++f) {
    faces->push_back(static_cast<int>(hull.corners(f).size()));
    for (const HullCorner& corner : hull.corners(f)) faces->push_back(corner.vertex);
  }
  const auto vertices = std::make_shared<const std::vector<Vector3d>>(hull.vertices);
  return std::make_shared<const FclShape>(vertices, hull.face_count(), faces);
}

// The two shapes of a pair, and the pose of the second in the frame of the first.
struct FclPair {
  const FclShape& a;
  const FclShape& b;
  const Isometry3d& X_AB;
};

std::optional<AxisClaim> libccd_claim(const HullPair& pair, const Vector3d& guess) {
  const SignedDistance found = fcl_signed_distance(pair, guess, constants::fcl_tolerance);
  const Vector3d way = found.on_b - found.on_a;
  if (!found.ended) return {};
  return AxisClaim{(found.value < 0 ? Vector3d(-way) : way).normalized(), found.value, true};
}

std::optional<AxisClaim> distance_claim(const FclPair& pair) {
  const fcl::DistanceRequestd request(true, false, 0, 0, constants::fcl_tolerance, fcl::GST_INDEP);
  fcl::DistanceResultd result;
  fcl::distance(&pair.a, Isometry3d::Identity(), &pair.b, pair.X_AB, request, result);
  if (!(result.min_distance > 0)) return {};
  return AxisClaim{(result.nearest_points[1] - result.nearest_points[0]).normalized(), result.min_distance};
}

std::optional<AxisClaim> collision_claim(const FclPair& pair, const Vector3d& guess) {
  fcl::CollisionRequestd request(1, true);
  request.gjk_solver_type = fcl::GST_INDEP;
  request.gjk_tolerance = constants::fcl_tolerance;
  request.enable_cached_gjk_guess = true;
  request.cached_gjk_guess = guess;
  fcl::CollisionResultd result;
  fcl::collide(&pair.a, Isometry3d::Identity(), &pair.b, pair.X_AB, request, result);
  if (!result.isCollision()) return {};
  const fcl::Contactd& contact = result.getContact(0);
  // GST_INDEP gives the depth with the other sign than GST_LIBCCD.
  return AxisClaim{contact.normal, -std::abs(contact.penetration_depth), false};
}

// Where to look for the axis first, in A's frame: along last time's normal, else along the line of centres.
Vector3d guess_of(const HullPair& pair, const ConvexContact& last) {
  if (last.normal.isZero()) return pair.X_AB * pair.b.centre - pair.a.centre;
  return last.count > 0 && last.normal_of_b ? Vector3d(pair.X_AB.linear() * last.normal) : last.normal;
}

}  // namespace

FclAxes::FclAxes(NarrowMethod method) : method_(method) {}

void FclAxes::add(int id, const CollisionHull* hull) {
  if (method_ != NarrowMethod::fcl_indep) return;  // the other takes the engine's hulls
  shapes_.resize(std::max(shapes_.size(), static_cast<std::size_t>(id) + 1));
  if (!hull) return;
  std::erase_if(known_, [](const auto& entry) { return entry.second.expired(); });
  auto& known = known_[hull];
  shapes_[static_cast<std::size_t>(id)] = known.lock();
  if (!known.expired()) return;
  shapes_[static_cast<std::size_t>(id)] = fcl_shape_of(*hull);
  known = shapes_[static_cast<std::size_t>(id)];
}

void FclAxes::remove(int id) {
  if (method_ == NarrowMethod::fcl_indep) shapes_[static_cast<std::size_t>(id)].reset();
}

std::optional<AxisClaim> FclAxes::ask(int a, int b, const HullPair& pair, const Vector3d& guess) const {
  try {
    if (method_ == NarrowMethod::fcl_libccd) return libccd_claim(pair, guess);
    const FclPair shapes{*shapes_[static_cast<std::size_t>(a)], *shapes_[static_cast<std::size_t>(b)],
                         pair.X_AB};
    const auto claim = collision_claim(shapes, guess);
    return claim ? claim : distance_claim(shapes);
  } catch (const std::exception&) {  // FCL's word for a configuration that it cannot do
    return {};
  }
}

bool find_by_fcl(const FclAxes& fcl, int a, int b, const HullPair& pair, const AxisQuery& query,
                 ConvexContactSearch& search, ConvexContact& contact) {
  const auto claim = fcl.ask(a, b, pair, guess_of(pair, contact));
  const auto axis = claim ? confirmed_axis(pair, *claim, query) : std::nullopt;
  if (axis)
    search.find_along(pair, query, *axis, contact);
  else
    search.find(pair, query, contact);
  return axis.has_value();
}

}  // namespace drawpoint::engine::detail
