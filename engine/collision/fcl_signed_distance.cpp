// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Compiled without assertions, and so alone: see the header.
#include <fcl/narrowphase/detail/convexity_based_algorithm/gjk_libccd.h>

#include <drawpoint/engine/collision/fcl_signed_distance.h>
#include <drawpoint/engine/geometry/hull_extremes.h>

#include <cmath>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

// GJK and EPA of rocks take some 40, of a wheel on a slab some 100.
constexpr int most_supports = 2000;
constexpr unsigned long most_iterations = 1000;  // FCL's own, of its distance

struct Body {
  const CollisionHull& hull;
  Eigen::Isometry3d pose;
  Vector3d first_direction;
  int supports = 0;
};

Vector3d from_ccd(const ccd_vec3_t& v) { return {v.v[0], v.v[1], v.v[2]}; }

void to_ccd(const Vector3d& from, ccd_vec3_t* to) { ccdVec3Set(to, from.x(), from.y(), from.z()); }

void first_direction(const void* a, const void*, ccd_vec3_t* direction) {
  to_ccd(static_cast<const Body*>(a)->first_direction, direction);
}

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  Body& body = *static_cast<Body*>(const_cast<void*>(object));  // libccd hands on what it was given
  const Vector3d local = body.pose.linear().transpose() * from_ccd(*direction);
  if (!local.allFinite()) body.supports = most_supports;  // shapes in one place: FCL has no direction
  if (++body.supports > most_supports) {
    to_ccd(Vector3d::Zero(), point);
    return;
  }
  to_ccd(body.pose * body.hull.vertices[static_cast<std::size_t>(lowest(body.hull, -local).vertex)], point);
}

// libccd's polytope, which EPA grows in memory of its own.
class Polytope {
 public:
  Polytope() { ccdPtInit(&polytope_); }
  ~Polytope() { ccdPtDestroy(&polytope_); }
  Polytope(const Polytope&) = delete;
  Polytope& operator=(const Polytope&) = delete;

  ccd_pt_t* get() { return &polytope_; }

 private:
  ccd_pt_t polytope_;
};

// FCL's ccdGJKSignedDist(), which does not free the polytope when EPA throws.
double signed_distance(const Body& a, const Body& b, const ccd_t& ccd, SignedDistance& result) {
  namespace ccd_extension = fcl::detail::libccd_extension;
  ccd_vec3_t on_a, on_b;
  to_ccd(Vector3d::Zero(), &on_a), to_ccd(Vector3d::Zero(), &on_b);
  ccd_simplex_t simplex;
  double value = -1;  // EPA's word for no answer
  if (ccd_extension::__ccdGJK(&a, &b, &ccd, &simplex) != 0) {
    value = ccd_extension::_ccdDist(&a, &b, &ccd, &simplex, &on_a, &on_b);
  } else {
    Polytope polytope;
    ccd_pt_el_t* nearest = nullptr;
    if (ccd_extension::__ccdEPA(&a, &b, &ccd, &simplex, polytope.get(), &nearest) == 0 && nearest) {
      value = -std::sqrt(nearest->dist);
      ccd_extension::penEPAPosClosest(nearest, &on_a, &on_b);
    }
  }
  result.on_a = from_ccd(on_a), result.on_b = from_ccd(on_b);
  return value;
}

}  // namespace

SignedDistance fcl_signed_distance(const HullPair& pair, const Vector3d& guess, double tolerance) {
  Body a{pair.a, Eigen::Isometry3d::Identity(), guess}, b{pair.b, pair.X_AB, guess};
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.first_dir = first_direction;
  ccd.max_iterations = most_iterations;
  ccd.dist_tolerance = ccd.epa_tolerance = tolerance;
  SignedDistance result;
  result.value = signed_distance(a, b, ccd, result);
  result.ended = a.supports <= most_supports && b.supports <= most_supports;
  return result;
}

}  // namespace drawpoint::engine::detail
