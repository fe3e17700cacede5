// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "drawpoint/engine/solver/batch/batch_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <drawpoint/engine/solver/batch/pair_lanes-inl.h>
#include <drawpoint/engine/solver/contact_law.hpp>

HWY_BEFORE_NAMESPACE();
namespace drawpoint::engine::detail::HWY_NAMESPACE {

HWY_NOINLINE void prepare_lanes(const BatchArrays& arrays, int batch, int at) {
  PairBatch& pair = arrays.pairs[batch];
  const auto load_body = [&](const std::int32_t* index, Lanes(&inertia)[6], Lanes& mass) {
    const BodyResponse* r = arrays.responses;
    const V4 first = gather([r](int k) { return r[k].inertia; }, index);
    const V4 rest = gather([r](int k) { return r[k].rest; }, index);
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
    store(inverse_or_zero(W.m[0] + load(p.sigma, at)), p.inverse_nn, at);
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

// What of a pair's load carries over to the next substep goes to `initial_impulse`; returns what does not:
// impacts.
HWY_INLINE V add_to_totals(const BatchArrays& arrays, PairBatch& pair, int at) {
  V impacts = all(0);
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    PointBatch& p = arrays.points[k];
    const V3 end = load(p.impulse, at);
    store(load(p.total, at) + end, p.total, at);
    const V most = all(2.0f) * load(p.initial_impulse, at) +
                   all(static_cast<float>(impact_speed)) * load(p.inverse_nn, at);
    const V kept = min(end.x, most);
    store(kept, p.initial_impulse, at);
    impacts = impacts + (end.x - kept);
  }
  store(load(pair.moment_total, at) + load(pair.moment, at), pair.moment_total, at);
  return impacts;
}

// Load that has built up carries over to the next substep; an impact does not (contact_law.hpp).
HWY_NOINLINE void end_substep_lanes(const BatchArrays& arrays, int batch, int at) {
  PairBatch& pair = arrays.pairs[batch];
  const V impacts = add_to_totals(arrays, pair, at);
  if (all_zero(impacts)) return;
  Pairs corrections(arrays, batch, at);
  corrections.gather(arrays.corrections);
  V force = all(0);
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    PointBatch& p = arrays.points[k];
    const V3 end = load(p.impulse, at);
    const V kept = load(p.initial_impulse, at), share = select(end.x > kept, kept / end.x, all(1.0f));
    const V3 carried = {kept, share * end.y, share * end.z};
    store(carried, p.impulse, at);
    corrections.push(load(p.arm, at), carried - end);
    force = force + end.x;
  }
  if (pair.resists) {
    const V3 moment = load(pair.moment, at);
    const V3 correction = select_or_zero(impacts > all(0), -impacts / force) * moment;
    store(moment + correction, pair.moment, at);
    corrections.twist(correction);
  }
  corrections.scatter(arrays.corrections);
}

// Gaps and targets of a substep, from the velocities at the end of the last one.
HWY_NOINLINE void bias_lanes(const BatchArrays& arrays, int batch, int at, const Iteration& iteration) {
  const PairBatch& pair = arrays.pairs[batch];
  const V3 n = load(pair.normal, at), offset = load(pair.offset, at);
  const Motion a = gather_motion(arrays.begin, pair.a + at), b = gather_motion(arrays.begin, pair.b + at);
  const V h = all(iteration.h), rate = all(-1.0f / iteration.h), four = all(4.0f);
  const V impact = all(static_cast<float>(-impact_speed)), zero = all(0);
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    PointBatch& p = arrays.points[k];
    const V3 arm = load(p.arm, at);
    const V approach = dot(n, (b.v + cross(b.w, arm + offset)) - (a.v + cross(a.w, arm)));
    V gap = load(p.gap, at);
    if (iteration.first_substep) {
      store(load(p.impulse[0], at), p.initial_impulse, at);
    } else {
      gap = gap + h * approach;
      store(gap, p.gap, at);
    }
    const V open = gap * rate;
    const V damping = select(approach < impact, zero, approach);
    const V closed = load(p.upsilon, at) * (damping + four * open);
    store(select(gap > zero, open, closed), p.target, at);
  }
}

HWY_NOINLINE void start_lanes(const BatchArrays& arrays, int batch, int at) {
  PairBatch& pair = arrays.pairs[batch];
  Pairs pairs(arrays, batch, at);
  pairs.gather(arrays.bodies);
  for (int k = pair.first; k < pair.first + pair.points; ++k)
    pairs.push(load(arrays.points[k].arm, at), load(arrays.points[k].impulse, at));
  if (pair.resists) pairs.twist(load(pair.moment, at));
  pairs.scatter(arrays.bodies);
}

struct TangentStep {
  V xx, xy, yy, rho;
};

// The tangential impulse (l1, l2) after its step against (u1, u2) within the cone of radius `limit`.
HWY_INLINE void project_tangents(V& l1, V& l2, V u1, V u2, const TangentStep& inverse, V limit) {
  const V s1 = l1 - (inverse.xx * u1 + inverse.xy * u2);
  const V s2 = l2 - (inverse.xy * u1 + inverse.yy * u2);
  const V limit2 = limit * limit;
  const Mask slides = (s1 * s1 + s2 * s2) > limit2;
  const V p1 = l1 - inverse.rho * u1, p2 = l2 - inverse.rho * u2;
  const V length2 = p1 * p1 + p2 * p2;
  const V scale = select(length2 > limit2, limit / sqrt(length2), all(1.0f));
  l1 = select(slides, p1 * scale, s1);
  l2 = select(slides, p2 * scale, s2);
}

HWY_INLINE V magnitude(const V3& v) { return abs(v.x) + abs(v.y) + abs(v.z); }

// What an iteration changes and carries, lane by lane.
struct alignas(64) LaneSums {
  Lanes change, normal_load;
};

HWY_NOINLINE void sweep_lanes(const BatchArrays& arrays, int batch, int at, LaneSums& sums) {
  PairBatch& pair = arrays.pairs[batch];
  Pairs pairs(arrays, batch, at);
  pairs.gather(arrays.bodies);
  const V zero = all(0), friction = load(pair.friction, at);
  V force = zero, change = zero;
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    PointBatch& p = arrays.points[k];
    const V3 arm = load(p.arm, at), u = pairs.velocity(arm), before = load(p.impulse, at);
    V3 l = before;
    const V rest = (u.x + load(p.sigma, at) * l.x) - load(p.target, at);
    l.x = max(zero, l.x - load(p.inverse_nn, at) * rest);
    const V dn = l.x - before.x;
    const TangentStep inverse{load(p.inverse_tt[0], at), load(p.inverse_tt[1], at), load(p.inverse_tt[2], at),
                              load(p.inverse_rho, at)};
    project_tangents(l.y, l.z, u.y + load(p.w10, at) * dn, u.z + load(p.w20, at) * dn, inverse,
                     friction * l.x);
    store(l, p.impulse, at);
    const V3 delta = l - before;
    pairs.push(arm, delta);
    force = force + l.x;
    change = change + magnitude(delta);
  }
  if (pair.resists) {
    const V3 u = pairs.spin(), before = load(pair.moment, at);
    V3 m = before;
    const V limit = load(pair.spinning_arm, at) * force;
    m.x = m.x - load(pair.moment_inverse_nn, at) * u.x;
    m.x = min(limit, max(-limit, m.x));
    const V dn = m.x - before.x;
    const TangentStep inverse{load(pair.moment_inverse_tt[0], at), load(pair.moment_inverse_tt[1], at),
                              load(pair.moment_inverse_tt[2], at), load(pair.moment_inverse_rho, at)};
    project_tangents(m.y, m.z, u.y + load(pair.moment_w10, at) * dn, (u.z + load(pair.moment_w20, at) * dn),
                     inverse, load(pair.rolling_arm, at) * force);
    store(m, pair.moment, at);
    pairs.twist(m - before);
  }
  pairs.scatter(arrays.bodies);
  store(change, sums.change, at);
  store(force, sums.normal_load, at);
}

HWY_INLINE V length(V x, V y) { return sqrt(x * x + y * y); }

// The natural map of the points' law at the velocities reached: how far each impulse is from its step.
HWY_NOINLINE void evaluate_lanes(const BatchArrays& arrays, int batch, int at) {
  PairBatch& pair = arrays.pairs[batch];
  Pairs pairs(arrays, batch, at);
  pairs.gather(arrays.bodies);
  const V zero = all(0), friction = load(pair.friction, at);
  V normal = zero, tangent = zero, force = zero;
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    const PointBatch& p = arrays.points[k];
    const V3 u = pairs.velocity(load(p.arm, at)), l = load(p.impulse, at);
    const V rest = (u.x + load(p.sigma, at) * l.x) - load(p.target, at);
    const V next = max(zero, l.x - load(p.inverse_nn, at) * rest);
    normal = normal + abs(l.x - next);
    force = force + max(l.x, next);
    const V rho = load(p.inverse_rho, at), limit = friction * l.x;
    const V p1 = l.y - rho * u.y, p2 = l.z - rho * u.z, reach = length(p1, p2);
    const V scale = select(reach > limit, limit / reach, all(1.0f));
    tangent = tangent + length(l.y - p1 * scale, l.z - p2 * scale);
  }
  store(normal, pair.normal_miss, at);
  store(tangent, pair.tangent_miss, at);
  store(force, pair.load, at);
}

template <class Kernel>
HWY_INLINE void over(BatchRange range, const Kernel& kernel) {
  for (int k = range.begin; k < range.end; ++k) kernel(range.forward ? k : range.begin + range.end - 1 - k);
}
template <class Kernel>
HWY_INLINE void over_lanes(BatchRange range, const Kernel& kernel) {
  over(range, [&](int batch) {
    for (int at = 0; at < batch_lanes; at += width) kernel(batch, at);
  });
}

void prepare(const BatchArrays& arrays, BatchRange range) {
  over_lanes(range, [&](int batch, int at) { prepare_lanes(arrays, batch, at); });
}
void start(const BatchArrays& arrays, BatchRange range) {
  over_lanes(range, [&](int batch, int at) { start_lanes(arrays, batch, at); });
}
void end_substep(const BatchArrays& arrays, BatchRange range) {
  over_lanes(range, [&](int batch, int at) { end_substep_lanes(arrays, batch, at); });
}
void evaluate(const BatchArrays& arrays, BatchRange range) {
  over_lanes(range, [&](int batch, int at) { evaluate_lanes(arrays, batch, at); });
}
void iteration(const BatchArrays& arrays, BatchRange range, const Iteration& this_iteration) {
  LaneSums sums;
  over(range, [&](int batch) {
    for (int at = 0; at < batch_lanes; at += width) {
      if (this_iteration.first) bias_lanes(arrays, batch, at, this_iteration);
      sweep_lanes(arrays, batch, at, sums);
      if (this_iteration.last) end_substep_lanes(arrays, batch, at);
    }
    arrays.sums[batch] = {sum_of(sums.change), sum_of(sums.normal_load)};
  });
}

}  // namespace drawpoint::engine::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace drawpoint::engine::detail {

HWY_EXPORT(prepare);
HWY_EXPORT(start);
HWY_EXPORT(iteration);
HWY_EXPORT(evaluate);
HWY_EXPORT(end_substep);

void prepare_batches(const BatchArrays& arrays, BatchRange range) {
  HWY_DYNAMIC_DISPATCH(prepare)(arrays, range);
}
void start_batches(const BatchArrays& arrays, BatchRange range) {
  HWY_DYNAMIC_DISPATCH(start)(arrays, range);
}
void iterate_batches(const BatchArrays& arrays, BatchRange range, const Iteration& this_iteration) {
  HWY_DYNAMIC_DISPATCH(iteration)(arrays, range, this_iteration);
}
void end_substep_batches(const BatchArrays& arrays, BatchRange range) {
  HWY_DYNAMIC_DISPATCH(end_substep)(arrays, range);
}
void evaluate_batches(const BatchArrays& arrays, BatchRange range) {
  HWY_DYNAMIC_DISPATCH(evaluate)(arrays, range);
}

}  // namespace drawpoint::engine::detail
#endif
