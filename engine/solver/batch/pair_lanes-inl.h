// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// As many pairs of a batch as a V holds, with the motion of their bodies: what the kernels
/// (batch_kernels.cpp) do with them, compiled once per instruction set.
///
/// Impulses and velocities of a point are in the pair's frame (n, t1, t2), t2 = n × t1. A body answers an
/// impulse P at the arm r with Δv = P/m, Δω = I⁻¹ (r × P). The contact law on V is in namespace law
/// (contact_law-inl.h). Included once a target, hence the toggle.
#if defined(DRAWPOINT_PAIR_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DRAWPOINT_PAIR_LANES_INL
#undef DRAWPOINT_PAIR_LANES_INL
#else
#define DRAWPOINT_PAIR_LANES_INL
#endif

#include <drawpoint/engine/solver/batch/lanes-inl.h>
#include <drawpoint/engine/base/constants.hpp>

HWY_BEFORE_NAMESPACE();
namespace drawpoint::engine::detail::HWY_NAMESPACE {

struct Motion {
  V3 v, w;
};

HWY_INLINE Motion gather_motion(const BodyRow* bodies, const std::int32_t* index) {
  const V4 v = gather([bodies](int k) { return bodies[k].velocity; }, index);
  const V4 w = gather([bodies](int k) { return bodies[k].angular_velocity; }, index);
  return {{v.c[0], v.c[1], v.c[2]}, {w.c[0], w.c[1], w.c[2]}};
}
HWY_INLINE void scatter_motion(const Motion& m, BodyRow* bodies, const std::int32_t* index) {
  scatter(
      m.v, [bodies](int k) { return bodies[k].velocity; }, index);
  scatter(
      m.w, [bodies](int k) { return bodies[k].angular_velocity; }, index);
}

// As many pairs of a batch as a V holds: their two bodies and what these answer.
class Pairs {
 public:
  HWY_INLINE Pairs(const BatchArrays& arrays, int batch, int at) : pair_(arrays.pairs[batch]), at_(at) {
    n_ = load(pair_.normal, at);
    t1_ = load(pair_.tangent, at);
    t2_ = cross(n_, t1_);
    offset_ = load(pair_.offset, at);
    mass_a_ = load(pair_.mass_a, at);
    mass_b_ = load(pair_.mass_b, at);
    inertia_a_ = load(pair_.inertia_a, at);
    inertia_b_ = load(pair_.inertia_b, at);
  }

  HWY_INLINE void gather(const BodyRow* bodies) {
    a_ = gather_motion(bodies, pair_.a + at_);
    b_ = gather_motion(bodies, pair_.b + at_);
  }
  HWY_INLINE void scatter(BodyRow* bodies) const {
    scatter_motion(a_, bodies, pair_.a + at_);
    scatter_motion(b_, bodies, pair_.b + at_);
  }

  HWY_INLINE V3 in_frame(const V3& u) const { return {dot(n_, u), dot(t1_, u), dot(t2_, u)}; }
  HWY_INLINE V3 to_world(const V3& l) const { return l.x * n_ + l.y * t1_ + l.z * t2_; }
  HWY_INLINE V3 velocity(const V3& arm) const {
    return in_frame((b_.v + cross(b_.w, arm + offset_)) - (a_.v + cross(a_.w, arm)));
  }
  HWY_INLINE V3 spin() const { return in_frame(b_.w - a_.w); }

  HWY_INLINE void push(const V3& arm, const V3& impulse) {
    const V3 P = to_world(impulse);
    a_.v = a_.v - mass_a_ * P;
    b_.v = b_.v + mass_b_ * P;
    a_.w = a_.w - inertia_a_ * cross(arm, P);
    b_.w = b_.w + inertia_b_ * cross(arm + offset_, P);
  }
  HWY_INLINE void twist(const V3& moment) {
    const V3 M = to_world(moment);
    a_.w = a_.w - inertia_a_ * M;
    b_.w = b_.w + inertia_b_ * M;
  }

  // Upper triangle of W in the frame, for a point (`linear` true) or a moment.
  HWY_INLINE Symmetric response(const V3& arm, bool linear) const {
    const V3 axes[3] = {n_, t1_, t2_};
    V3 ra[3], rb[3], Ia[3], Ib[3];
    for (int i = 0; i < 3; ++i) {
      ra[i] = linear ? cross(arm, axes[i]) : axes[i];
      rb[i] = linear ? cross(arm + offset_, axes[i]) : axes[i];
      Ia[i] = inertia_a_ * ra[i];
      Ib[i] = inertia_b_ * rb[i];
    }
    const V mass = linear ? mass_a_ + mass_b_ : all(0);
    const auto w = [&](int i, int j) { return dot(ra[i], Ia[j]) + dot(rb[i], Ib[j]); };
    return {{mass + w(0, 0), w(0, 1), w(0, 2), mass + w(1, 1), w(1, 2), mass + w(2, 2)}};
  }

 private:
  const PairBatch& pair_;
  int at_;
  V3 n_, t1_, t2_, offset_;
  V mass_a_, mass_b_;
  Symmetric inertia_a_, inertia_b_;
  Motion a_, b_;
};

namespace law {
template <class T>
HWY_INLINE T number(double x) {
  return all(static_cast<float>(x));
}
constexpr double singular_determinant = constants::singular_single;
// Lanes do not branch.
HWY_INLINE bool none(const Mask&) { return false; }
}  // namespace law
#include <drawpoint/engine/solver/contact_law-inl.h>

HWY_INLINE law::TangentInverse<V> invert_tangents(const Symmetric& W) {
  return law::invert_tangents(W.m[3], W.m[4], W.m[5]);
}

}  // namespace drawpoint::engine::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
