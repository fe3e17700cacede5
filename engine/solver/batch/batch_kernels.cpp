// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "drawpoint/engine/solver/batch/batch_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <drawpoint/engine/solver/batch/pair_lanes-inl.h>

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
    const law::TangentInverse<V> inverse = invert_tangents(W);
    store(law::inverse_or_zero(W.m[0] + load(p.sigma, at)), p.inverse_nn, at);
    store(W.m[1], p.w10, at);
    store(W.m[2], p.w20, at);
    store(inverse.xx, p.inverse_tt[0], at);
    store(inverse.xy, p.inverse_tt[1], at);
    store(inverse.yy, p.inverse_tt[2], at);
    store(inverse.rho, p.inverse_rho, at);
  }
  const Symmetric W = pairs.response(load(pair.offset, at), false);
  const law::TangentInverse<V> inverse = invert_tangents(W);
  store(law::inverse_or_zero(W.m[0]), pair.moment_inverse_nn, at);
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
    const V kept = law::kept_load(end.x, load(p.initial_impulse, at), load(p.inverse_nn, at));
    store(kept, p.initial_impulse, at);
    impacts = impacts + (end.x - kept);
  }
  store(load(pair.moment_total, at) + load(pair.moment, at), pair.moment_total, at);
  return impacts;
}

// Load that has built up carries over to the next substep; an impact does not (law::kept_load).
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
    const V kept = load(p.initial_impulse, at), share = law::warm_start_fraction(end.x, kept);
    const V3 carried = {kept, share * end.y, share * end.z};
    store(carried, p.impulse, at);
    corrections.push(load(p.arm, at), carried - end);
    force = force + end.x;
  }
  if (pair.resists) {
    const V3 moment = load(pair.moment, at);
    const V3 correction = law::moment_change(impacts, force) * moment;
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
  const V h = all(iteration.h), closing_rate = all(-1.0f / iteration.h);
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
    store(law::bias_velocity(gap, approach, load(p.upsilon, at), closing_rate), p.target, at);
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

HWY_INLINE law::TangentInverse<V> load_tangents(const Lanes (&inverse)[3], const Lanes& rho, int at) {
  return {load(inverse[0], at), load(inverse[1], at), load(inverse[2], at), load(rho, at)};
}

HWY_INLINE V magnitude(const V3& v) { return abs(v.x) + abs(v.y) + abs(v.z); }

// What an iteration changes and carries, lane by lane.
struct alignas(64) LaneSums {
  Lanes change, normal_load;
};

// What an iteration starts a block from.
HWY_INLINE V3 start_impulse(const Lanes (&impulse)[3], Lanes (&previous)[3], int at,
                            const Iteration& iteration) {
  const V3 now = load(impulse, at);
  V3 start = now;
  if (iteration.momentum > 0) start = now + all(iteration.momentum) * (now - load(previous, at));
  if (iteration.remember) store(now, previous, at);
  return start;
}

HWY_NOINLINE void sweep_lanes(const BatchArrays& arrays, int batch, int at, const Iteration& iteration,
                              LaneSums& sums) {
  PairBatch& pair = arrays.pairs[batch];
  Pairs pairs(arrays, batch, at);
  pairs.gather(arrays.bodies);
  const V zero = all(0), friction = load(pair.friction, at),
          fastest = all(static_cast<float>(constants::push_out_speed));
  V force = zero, change = zero;
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    PointBatch& p = arrays.points[k];
    const V3 arm = load(p.arm, at), u = pairs.velocity(arm),
             before = start_impulse(p.impulse, p.previous, at, iteration);
    V3 l = before;
    l.x = law::normal_step(l.x, u.x, load(p.sigma, at), load(p.target, at), load(p.inverse_nn, at), fastest);
    const V dn = l.x - before.x;
    law::tangent_step(l.y, l.z, u.y + load(p.w10, at) * dn, u.z + load(p.w20, at) * dn,
                      load_tangents(p.inverse_tt, p.inverse_rho, at), friction * l.x);
    store(l, p.impulse, at);
    const V3 delta = l - before;
    pairs.push(arm, delta);
    force = force + l.x;
    change = change + magnitude(delta);
  }
  if (pair.resists) {
    const V3 u = pairs.spin(), before = start_impulse(pair.moment, pair.moment_previous, at, iteration);
    V3 m = before;
    m.x = law::spin_step(m.x, u.x, load(pair.moment_inverse_nn, at), load(pair.spinning_arm, at) * force);
    const V dn = m.x - before.x;
    law::tangent_step(m.y, m.z, u.y + load(pair.moment_w10, at) * dn, u.z + load(pair.moment_w20, at) * dn,
                      load_tangents(pair.moment_inverse_tt, pair.moment_inverse_rho, at),
                      load(pair.rolling_arm, at) * force);
    store(m, pair.moment, at);
    pairs.twist(m - before);
  }
  pairs.scatter(arrays.bodies);
  store(change, sums.change, at);
  store(force, sums.normal_load, at);
}

// The natural map of the points' law at the velocities reached: how far each impulse is from its step.
HWY_NOINLINE void evaluate_lanes(const BatchArrays& arrays, int batch, int at) {
  PairBatch& pair = arrays.pairs[batch];
  Pairs pairs(arrays, batch, at);
  pairs.gather(arrays.bodies);
  const V zero = all(0), friction = load(pair.friction, at),
          fastest = all(static_cast<float>(constants::push_out_speed));
  V normal = zero, tangent = zero, force = zero;
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    const PointBatch& p = arrays.points[k];
    const V3 u = pairs.velocity(load(p.arm, at)), l = load(p.impulse, at);
    const V next =
        law::normal_step(l.x, u.x, load(p.sigma, at), load(p.target, at), load(p.inverse_nn, at), fastest);
    normal = normal + abs(l.x - next);
    force = force + max(l.x, next);
    tangent = tangent + law::tangent_residual(l.y, l.z, u.y, u.z, load(p.inverse_rho, at), friction * l.x);
  }
  store(normal, pair.normal_miss, at);
  store(tangent, pair.tangent_miss, at);
  store(force, pair.load, at);
}

HWY_NOINLINE void repeat_lanes(const BatchArrays& arrays, int batch, int at, V substeps) {
  PairBatch& pair = arrays.pairs[batch];
  for (int k = pair.first; k < pair.first + pair.points; ++k) {
    PointBatch& p = arrays.points[k];
    store(load(p.total, at) + substeps * load(p.impulse, at), p.total, at);
  }
  store(load(pair.moment_total, at) + substeps * load(pair.moment, at), pair.moment_total, at);
}

template <class Kernel>
HWY_INLINE void over(BatchRange range, const Kernel& kernel) {
  for (int k = range.begin; k < range.end; ++k) kernel(k);
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
void repeat(const BatchArrays& arrays, BatchRange range, int substeps) {
  const float times = static_cast<float>(substeps);
  over_lanes(range, [&](int batch, int at) { repeat_lanes(arrays, batch, at, all(times)); });
}
void evaluate(const BatchArrays& arrays, BatchRange range) {
  over_lanes(range, [&](int batch, int at) { evaluate_lanes(arrays, batch, at); });
}
void iteration(const BatchArrays& arrays, BatchRange range, const Iteration& this_iteration) {
  LaneSums sums;
  over(range, [&](int batch) {
    for (int at = 0; at < batch_lanes; at += width) {
      if (this_iteration.first) bias_lanes(arrays, batch, at, this_iteration);
      sweep_lanes(arrays, batch, at, this_iteration, sums);
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
HWY_EXPORT(repeat);
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
void repeat_batches(const BatchArrays& arrays, BatchRange range, int substeps) {
  HWY_DYNAMIC_DISPATCH(repeat)(arrays, range, substeps);
}
void evaluate_batches(const BatchArrays& arrays, BatchRange range) {
  HWY_DYNAMIC_DISPATCH(evaluate)(arrays, range);
}

}  // namespace drawpoint::engine::detail
#endif
