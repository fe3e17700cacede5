// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "drawpoint/engine/contact/batch_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <drawpoint/engine/contact/contact_law.hpp>
#include <drawpoint/engine/contact/pair_batch.hpp>

HWY_BEFORE_NAMESPACE();
namespace drawpoint::engine::contact::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Eight logical lanes: one vector of eight, two of four or eight of one. Products and sums are separate
// operations on every target (no fused multiply-add), so the bits do not depend on the target.
using D = hn::CappedTag<float, batch_lanes>;
using V = hn::Vec<D>;
constexpr D d;
constexpr int width = static_cast<int>(hn::MaxLanes(D()));

struct V3 {
  V x, y, z;
};

HWY_INLINE V load(const Lanes& lanes, int at) { return hn::Load(d, lanes + at); }
HWY_INLINE void store(V v, Lanes& lanes, int at) { hn::Store(v, d, lanes + at); }
HWY_INLINE V3 load(const Lanes (&lanes)[3], int at) {
  return {load(lanes[0], at), load(lanes[1], at), load(lanes[2], at)};
}
HWY_INLINE void store(const V3& v, Lanes (&lanes)[3], int at) {
  store(v.x, lanes[0], at);
  store(v.y, lanes[1], at);
  store(v.z, lanes[2], at);
}

HWY_INLINE V3 operator+(const V3& a, const V3& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V3 operator-(const V3& a, const V3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V3 operator*(V s, const V3& a) { return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)}; }
HWY_INLINE V add_product(V sum, V a, V b) { return hn::Add(sum, hn::Mul(a, b)); }
HWY_INLINE V dot(const V3& a, const V3& b) {
  return add_product(add_product(hn::Mul(a.x, b.x), a.y, b.y), a.z, b.z);
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

struct Symmetric {  // xx, xy, xz, yy, yz, zz
  V m[6];
};
HWY_INLINE V3 operator*(const Symmetric& A, const V3& b) {
  return {add_product(add_product(hn::Mul(A.m[0], b.x), A.m[1], b.y), A.m[2], b.z),
          add_product(add_product(hn::Mul(A.m[1], b.x), A.m[3], b.y), A.m[4], b.z),
          add_product(add_product(hn::Mul(A.m[2], b.x), A.m[4], b.y), A.m[5], b.z)};
}
HWY_INLINE Symmetric load(const Lanes (&lanes)[6], int at) {
  return {{load(lanes[0], at), load(lanes[1], at), load(lanes[2], at), load(lanes[3], at), load(lanes[4], at),
           load(lanes[5], at)}};
}

// Four floats of `width` rows as four vectors, one a column. Within blocks of four lanes; the second block
// holds rows 4 to 7.
struct Columns {
  V c[4];
};

#if HWY_TARGET == HWY_SCALAR

template <class Row>
HWY_INLINE Columns gather(const Row& row, const std::int32_t* index) {
  const float* r = row(*index);
  return {{hn::Set(d, r[0]), hn::Set(d, r[1]), hn::Set(d, r[2]), hn::Set(d, r[3])}};
}

template <class Row>
HWY_INLINE void scatter(const V3& v, const Row& row, const std::int32_t* index) {
  float* r = row(*index);
  r[0] = hn::GetLane(v.x);
  r[1] = hn::GetLane(v.y);
  r[2] = hn::GetLane(v.z);
}

#else

template <class Row>
HWY_INLINE V row_pair(const Row& row, const std::int32_t* index, int k) {
  const hn::FixedTag<float, 4> quarter;
  if constexpr (width == 8)
    return hn::Combine(d, hn::Load(quarter, row(index[k + 4])), hn::Load(quarter, row(index[k])));
  else
    return hn::Load(quarter, row(index[k]));
}

template <class Row>
HWY_INLINE Columns gather(const Row& row, const std::int32_t* index) {
  const V r0 = row_pair(row, index, 0), r1 = row_pair(row, index, 1), r2 = row_pair(row, index, 2),
          r3 = row_pair(row, index, 3);
  const V t0 = hn::InterleaveLower(d, r0, r2), t1 = hn::InterleaveLower(d, r1, r3);
  const V t2 = hn::InterleaveUpper(d, r0, r2), t3 = hn::InterleaveUpper(d, r1, r3);
  return {{hn::InterleaveLower(d, t0, t1), hn::InterleaveUpper(d, t0, t1), hn::InterleaveLower(d, t2, t3),
           hn::InterleaveUpper(d, t2, t3)}};
}

template <class Vector, class Row>
HWY_INLINE void put_row(Vector v, const Row& row, const std::int32_t* index, int k) {
  const hn::FixedTag<float, 4> quarter;
  if constexpr (width == 8) {
    hn::Store(hn::LowerHalf(quarter, v), quarter, row(index[k]));
    hn::Store(hn::UpperHalf(quarter, v), quarter, row(index[k + 4]));
  } else {
    hn::Store(v, quarter, row(index[k]));
  }
}

template <class Row>
HWY_INLINE void scatter(const V3& v, const Row& row, const std::int32_t* index) {
  const V zero = hn::Zero(d);
  const V a0 = hn::InterleaveLower(d, v.x, v.z), a1 = hn::InterleaveLower(d, v.y, zero);
  const V a2 = hn::InterleaveUpper(d, v.x, v.z), a3 = hn::InterleaveUpper(d, v.y, zero);
  put_row(hn::InterleaveLower(d, a0, a1), row, index, 0);
  put_row(hn::InterleaveUpper(d, a0, a1), row, index, 1);
  put_row(hn::InterleaveLower(d, a2, a3), row, index, 2);
  put_row(hn::InterleaveUpper(d, a2, a3), row, index, 3);
}

#endif

struct Motion {
  V3 v, w;
};

HWY_INLINE Motion gather_motion(const BodyRow* bodies, const std::int32_t* index) {
  const Columns v = gather([bodies](int k) { return bodies[k].velocity; }, index);
  const Columns w = gather([bodies](int k) { return bodies[k].angular_velocity; }, index);
  return {{v.c[0], v.c[1], v.c[2]}, {w.c[0], w.c[1], w.c[2]}};
}
HWY_INLINE void scatter_motion(const Motion& m, BodyRow* bodies, const std::int32_t* index) {
  scatter(
      m.v, [bodies](int k) { return bodies[k].velocity; }, index);
  scatter(
      m.w, [bodies](int k) { return bodies[k].angular_velocity; }, index);
}

// One half (or all) of a batch in registers: the pair's two bodies and what they answer.
class Pairs {
 public:
  HWY_INLINE Pairs(const BatchArrays& arrays, int batch, int at)
      : pair_(arrays.pairs[batch]), bodies_(arrays.bodies), at_(at) {
    n_ = load(pair_.normal, at);
    t1_ = load(pair_.tangent, at);
    t2_ = cross(n_, t1_);
    offset_ = load(pair_.offset, at);
    mass_a_ = load(pair_.mass_a, at);
    mass_b_ = load(pair_.mass_b, at);
    inertia_a_ = load(pair_.inertia_a, at);
    inertia_b_ = load(pair_.inertia_b, at);
  }

  HWY_INLINE void gather() {
    a_ = gather_motion(bodies_, pair_.a + at_);
    b_ = gather_motion(bodies_, pair_.b + at_);
  }
  HWY_INLINE void scatter() const {
    scatter_motion(a_, bodies_, pair_.a + at_);
    scatter_motion(b_, bodies_, pair_.b + at_);
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
    const V mass = linear ? hn::Add(mass_a_, mass_b_) : hn::Zero(d);
    const auto w = [&](int i, int j) { return hn::Add(dot(ra[i], Ia[j]), dot(rb[i], Ib[j])); };
    return {
        {hn::Add(mass, w(0, 0)), w(0, 1), w(0, 2), hn::Add(mass, w(1, 1)), w(1, 2), hn::Add(mass, w(2, 2))}};
  }

 private:
  const PairBatch& pair_;
  BodyRow* bodies_;
  int at_;
  V3 n_, t1_, t2_, offset_;
  V mass_a_, mass_b_;
  Symmetric inertia_a_, inertia_b_;
  Motion a_, b_;
};

HWY_INLINE V inverse_or_zero(V x) {
  const V zero = hn::Zero(d);
  return hn::IfThenElse(hn::Gt(x, zero), hn::Div(hn::Set(d, 1.0f), x), zero);
}

struct TangentInverse {
  V xx, xy, yy, rho;
};

// As the sequential sweeper's, with the bound of single precision on what is singular.
HWY_INLINE TangentInverse invert_tangents(const Symmetric& W) {
  const V a = W.m[3], b = W.m[4], c = W.m[5], half = hn::Set(d, 0.5f);
  const V difference = hn::Mul(half, hn::Sub(a, c));
  const V rho =
      hn::Add(hn::Mul(half, hn::Add(a, c)), hn::Sqrt(add_product(hn::Mul(difference, difference), b, b)));
  const V inverse_rho = inverse_or_zero(rho);
  const V determinant = hn::Sub(hn::Mul(a, c), hn::Mul(b, b));
  const auto regular = hn::Gt(determinant, hn::Mul(hn::Set(d, 1e-5f), hn::Mul(rho, rho)));
  const V inverse = inverse_or_zero(determinant);
  return {hn::IfThenElse(regular, hn::Mul(c, inverse), inverse_rho),
          hn::IfThenElseZero(regular, hn::Neg(hn::Mul(b, inverse))),
          hn::IfThenElse(regular, hn::Mul(a, inverse), inverse_rho), inverse_rho};
}

HWY_INLINE void prepare_half(const BatchArrays& arrays, int batch, int at) {
  PairBatch& pair = arrays.pairs[batch];
  const auto load_body = [&](const std::int32_t* index, Lanes(&inertia)[6], Lanes& mass) {
    const BodyResponse* r = arrays.responses;
    const Columns first = gather([r](int k) { return r[k].inertia; }, index);
    const Columns rest = gather([r](int k) { return r[k].rest; }, index);
    for (int k = 0; k < 4; ++k) store(first.c[k], inertia[k], at);
    store(rest.c[0], inertia[4], at);
    store(rest.c[1], inertia[5], at);
    store(rest.c[2], mass, at);
  };
  load_body(pair.a + at, pair.inertia_a, pair.mass_a);
  load_body(pair.b + at, pair.inertia_b, pair.mass_b);
  const Pairs pairs(arrays, batch, at);
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    PointBatch& p = arrays.points[k];
    const Symmetric W = pairs.response(load(p.arm, at), true);
    const TangentInverse inverse = invert_tangents(W);
    store(inverse_or_zero(hn::Add(W.m[0], load(p.sigma, at))), p.inverse_nn, at);
    store(W.m[1], p.w10, at);
    store(W.m[2], p.w20, at);
    store(inverse.xx, p.inverse_tt[0], at);
    store(inverse.xy, p.inverse_tt[1], at);
    store(inverse.yy, p.inverse_tt[2], at);
    store(inverse.rho, p.inverse_rho, at);
  }
  const Symmetric W = pairs.response(load(pair.offset, at), false);
  const TangentInverse inverse = invert_tangents(W);
  store(inverse_or_zero(W.m[0]), pair.moment_inverse_nn, at);
  store(W.m[1], pair.moment_w10, at);
  store(W.m[2], pair.moment_w20, at);
  store(inverse.xx, pair.moment_inverse_tt[0], at);
  store(inverse.xy, pair.moment_inverse_tt[1], at);
  store(inverse.yy, pair.moment_inverse_tt[2], at);
  store(inverse.rho, pair.moment_inverse_rho, at);
}

// Load that has built up carries over to the next substep; a blow does not (contact_law.hpp). The correction
// takes back what the extrapolation of the bodies repeats of it.
HWY_INLINE V carry_over(PointBatch& p, int at) {
  const V3 end = load(p.impulse, at);
  store(load(p.total, at) + end, p.total, at);
  const V most = add_product(hn::Mul(hn::Set(d, 2.0f), load(p.begun, at)),
                             hn::Set(d, static_cast<float>(impact_speed)), load(p.inverse_nn, at));
  const V kept = hn::Min(end.x, most), zero = hn::Zero(d);
  const V share = hn::IfThenElse(hn::Gt(end.x, most), hn::Div(kept, end.x), hn::Set(d, 1.0f));
  const V3 carried = {kept, hn::Mul(share, end.y), hn::Mul(share, end.z)};
  store(carried, p.impulse, at);
  store(kept, p.begun, at);
  const V3 correction = carried - end;
  store(correction, p.correction, at);
  return hn::IfThenElseZero(hn::Lt(correction.x, zero), correction.x);
}

HWY_INLINE void refresh_half(const BatchArrays& arrays, int batch, int at, const Substep& substep) {
  PairBatch& pair = arrays.pairs[batch];
  const V3 n = load(pair.normal, at), offset = load(pair.offset, at);
  const Motion a = gather_motion(arrays.end, pair.a + at), b = gather_motion(arrays.end, pair.b + at);
  const V h = hn::Set(d, substep.h), rate = hn::Set(d, -1.0f / substep.h), four = hn::Set(d, 4.0f);
  const V impact = hn::Set(d, static_cast<float>(-impact_speed)), zero = hn::Zero(d);
  V force = zero, dropped = zero;
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    PointBatch& p = arrays.points[k];
    const V3 arm = load(p.arm, at);
    const V approach = dot(n, (b.v + cross(b.w, arm + offset)) - (a.v + cross(a.w, arm)));
    V gap = load(p.gap, at);
    if (substep.first) {
      store(load(p.impulse[0], at), p.begun, at);
    } else {
      gap = add_product(gap, h, approach);
      store(gap, p.gap, at);
      force = hn::Add(force, load(p.impulse[0], at));
      dropped = hn::Add(dropped, carry_over(p, at));
    }
    const V open = hn::Mul(gap, rate);
    const V damping = hn::IfThenElse(hn::Lt(approach, impact), zero, approach);
    const V closed = hn::Mul(load(p.upsilon, at), add_product(damping, four, open));
    store(hn::IfThenElse(hn::Gt(gap, zero), open, closed), p.target, at);
  }
  if (substep.first) return;
  const V3 moment = load(pair.moment, at);
  store(load(pair.moment_total, at) + moment, pair.moment_total, at);
  const V share = hn::IfThenElseZero(hn::Lt(dropped, zero), hn::Div(dropped, force));
  store(share * moment, pair.moment_correction, at);
  store(moment + share * moment, pair.moment, at);
  store(dropped, pair.change, at);
}

// What refresh() took off the start impulses, off the bodies too.
HWY_INLINE void correct_half(const BatchArrays& arrays, int batch, int at) {
  const PairBatch& pair = arrays.pairs[batch];
  if (hn::AllTrue(d, hn::Eq(load(pair.change, at), hn::Zero(d)))) return;
  Pairs pairs(arrays, batch, at);
  pairs.gather();
  for (int k = pair.first; k < pair.first + pair.points; ++k)
    pairs.push(load(arrays.points[k].arm, at), load(arrays.points[k].correction, at));
  if (pair.resists) pairs.twist(load(pair.moment_correction, at));
  pairs.scatter();
}

HWY_INLINE void start_half(const BatchArrays& arrays, int batch, int at) {
  PairBatch& pair = arrays.pairs[batch];
  Pairs pairs(arrays, batch, at);
  pairs.gather();
  for (int k = pair.first; k < pair.first + pair.points; ++k)
    pairs.push(load(arrays.points[k].arm, at), load(arrays.points[k].impulse, at));
  if (pair.resists) pairs.twist(load(pair.moment, at));
  pairs.scatter();
}

struct TangentStep {
  V xx, xy, yy, rho;
};

// The tangential impulse (l1, l2) after its step against (u1, u2) within the cone of radius `limit`.
HWY_INLINE void project_tangents(V& l1, V& l2, V u1, V u2, const TangentStep& inverse, V limit) {
  const V s1 = hn::Sub(l1, add_product(hn::Mul(inverse.xx, u1), inverse.xy, u2));
  const V s2 = hn::Sub(l2, add_product(hn::Mul(inverse.xy, u1), inverse.yy, u2));
  const V limit2 = hn::Mul(limit, limit);
  const auto slides = hn::Gt(add_product(hn::Mul(s1, s1), s2, s2), limit2);
  const V p1 = hn::Sub(l1, hn::Mul(inverse.rho, u1)), p2 = hn::Sub(l2, hn::Mul(inverse.rho, u2));
  const V length2 = add_product(hn::Mul(p1, p1), p2, p2);
  const V scale =
      hn::IfThenElse(hn::Gt(length2, limit2), hn::Div(limit, hn::Sqrt(length2)), hn::Set(d, 1.0f));
  l1 = hn::IfThenElse(slides, hn::Mul(p1, scale), s1);
  l2 = hn::IfThenElse(slides, hn::Mul(p2, scale), s2);
}

HWY_INLINE V magnitude(const V3& v) { return hn::Add(hn::Add(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z)); }

HWY_INLINE void sweep_half(const BatchArrays& arrays, int batch, int at) {
  PairBatch& pair = arrays.pairs[batch];
  Pairs pairs(arrays, batch, at);
  pairs.gather();
  const V zero = hn::Zero(d), friction = load(pair.friction, at);
  V force = zero, change = zero;
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    PointBatch& p = arrays.points[k];
    const V3 arm = load(p.arm, at), u = pairs.velocity(arm), before = load(p.impulse, at);
    V3 l = before;
    const V rest = hn::Sub(add_product(u.x, load(p.sigma, at), l.x), load(p.target, at));
    l.x = hn::Max(zero, hn::Sub(l.x, hn::Mul(load(p.inverse_nn, at), rest)));
    const V dn = hn::Sub(l.x, before.x);
    const TangentStep inverse{load(p.inverse_tt[0], at), load(p.inverse_tt[1], at), load(p.inverse_tt[2], at),
                              load(p.inverse_rho, at)};
    project_tangents(l.y, l.z, add_product(u.y, load(p.w10, at), dn), add_product(u.z, load(p.w20, at), dn),
                     inverse, hn::Mul(friction, l.x));
    store(l, p.impulse, at);
    const V3 delta = l - before;
    pairs.push(arm, delta);
    force = hn::Add(force, l.x);
    change = hn::Add(change, magnitude(delta));
  }
  if (pair.resists) {
    const V3 u = pairs.spin(), before = load(pair.moment, at);
    V3 m = before;
    const V limit = hn::Mul(load(pair.spinning_arm, at), force);
    m.x = hn::Sub(m.x, hn::Mul(load(pair.moment_inverse_nn, at), u.x));
    m.x = hn::Min(limit, hn::Max(hn::Neg(limit), m.x));
    const V dn = hn::Sub(m.x, before.x);
    const TangentStep inverse{load(pair.moment_inverse_tt[0], at), load(pair.moment_inverse_tt[1], at),
                              load(pair.moment_inverse_tt[2], at), load(pair.moment_inverse_rho, at)};
    project_tangents(m.y, m.z, add_product(u.y, load(pair.moment_w10, at), dn),
                     add_product(u.z, load(pair.moment_w20, at), dn), inverse,
                     hn::Mul(load(pair.rolling_arm, at), force));
    store(m, pair.moment, at);
    pairs.twist(m - before);
  }
  store(change, pair.change, at);
  pairs.scatter();
}

HWY_INLINE V length(V x, V y) { return hn::Sqrt(add_product(hn::Mul(x, x), y, y)); }

// The natural map of the points' law at the velocities reached: how far each impulse is from its step.
HWY_INLINE void judge_half(const BatchArrays& arrays, int batch, int at) {
  PairBatch& pair = arrays.pairs[batch];
  Pairs pairs(arrays, batch, at);
  pairs.gather();
  const V zero = hn::Zero(d), friction = load(pair.friction, at);
  V normal = zero, tangent = zero, force = zero;
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    const PointBatch& p = arrays.points[k];
    const V3 u = pairs.velocity(load(p.arm, at)), l = load(p.impulse, at);
    const V rest = hn::Sub(add_product(u.x, load(p.sigma, at), l.x), load(p.target, at));
    const V next = hn::Max(zero, hn::Sub(l.x, hn::Mul(load(p.inverse_nn, at), rest)));
    normal = hn::Add(normal, hn::Abs(hn::Sub(l.x, next)));
    force = hn::Add(force, hn::Max(l.x, next));
    const V rho = load(p.inverse_rho, at), limit = hn::Mul(friction, l.x);
    const V p1 = hn::Sub(l.y, hn::Mul(rho, u.y)), p2 = hn::Sub(l.z, hn::Mul(rho, u.z)),
            reach = length(p1, p2);
    const V scale = hn::IfThenElse(hn::Gt(reach, limit), hn::Div(limit, reach), hn::Set(d, 1.0f));
    tangent = hn::Add(tangent, length(hn::Sub(l.y, hn::Mul(p1, scale)), hn::Sub(l.z, hn::Mul(p2, scale))));
  }
  store(normal, pair.change, at);
  store(tangent, pair.miss, at);
  store(force, pair.load, at);
}

template <class Half>
HWY_INLINE void over(BatchRange range, const Half& half) {
  for (int batch = range.begin; batch < range.end; ++batch)
    for (int at = 0; at < batch_lanes; at += width) half(batch, at);
}

void prepare(const BatchArrays& arrays, BatchRange range) {
  over(range, [&](int batch, int at) { prepare_half(arrays, batch, at); });
}
void refresh(const BatchArrays& arrays, BatchRange range, const Substep& substep) {
  over(range, [&](int batch, int at) { refresh_half(arrays, batch, at, substep); });
}
void start(const BatchArrays& arrays, BatchRange range) {
  over(range, [&](int batch, int at) { start_half(arrays, batch, at); });
}
void correct(const BatchArrays& arrays, BatchRange range) {
  over(range, [&](int batch, int at) { correct_half(arrays, batch, at); });
}
void judge(const BatchArrays& arrays, BatchRange range) {
  over(range, [&](int batch, int at) { judge_half(arrays, batch, at); });
}
void sweep(const BatchArrays& arrays, BatchRange range) {
  over(range, [&](int batch, int at) { sweep_half(arrays, batch, at); });
}

}  // namespace drawpoint::engine::contact::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace drawpoint::engine::contact::detail {

HWY_EXPORT(prepare);
HWY_EXPORT(refresh);
HWY_EXPORT(start);
HWY_EXPORT(sweep);
HWY_EXPORT(judge);
HWY_EXPORT(correct);

void prepare_batches(const BatchArrays& arrays, BatchRange range) {
  HWY_DYNAMIC_DISPATCH(prepare)(arrays, range);
}
void refresh_batches(const BatchArrays& arrays, BatchRange range, const Substep& substep) {
  HWY_DYNAMIC_DISPATCH(refresh)(arrays, range, substep);
}
void start_batches(const BatchArrays& arrays, BatchRange range) {
  HWY_DYNAMIC_DISPATCH(start)(arrays, range);
}
void sweep_batches(const BatchArrays& arrays, BatchRange range) {
  HWY_DYNAMIC_DISPATCH(sweep)(arrays, range);
}

void correct_batches(const BatchArrays& arrays, BatchRange range) {
  HWY_DYNAMIC_DISPATCH(correct)(arrays, range);
}
void judge_batches(const BatchArrays& arrays, BatchRange range) {
  HWY_DYNAMIC_DISPATCH(judge)(arrays, range);
}

}  // namespace drawpoint::engine::contact::detail
#endif
