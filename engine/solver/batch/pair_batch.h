// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

/// Sixteen pairs that share no moving body, side by side: what a SIMD lane works on.
///
/// Single precision; an array of sixteen holds one number of sixteen pairs. Row k of a body array holds a
/// body's velocity and angular velocity, padded to 32 bytes. Fixed bodies have rows of their own, one a lane,
/// which stay zero, so that no two lanes ever write the same row. Lanes without a pair answer nothing; lanes
/// without a point have a gap of `no_gap`: either changes nothing.
namespace drawpoint::engine::detail {

constexpr int batch_lanes = 16;
constexpr float no_gap = 1e10f;  // [m]
using Lanes = float[batch_lanes];

struct alignas(32) BodyRow {
  float velocity[4] = {}, angular_velocity[4] = {};
};

/// Inverse inertia (xx, xy, xz, yy), (yz, zz), inverse mass.
struct alignas(32) BodyResponse {
  float inertia[4] = {}, rest[4] = {};
};

struct alignas(64) PointBatch {
  Lanes arm[3];  // from A's centre
  Lanes gap, upsilon, sigma, target;
  Lanes inverse_nn, inverse_tt[3], inverse_rho, w10, w20;
  Lanes impulse[3], total[3];  // in the frame; of the substep, of the step
  Lanes previous[3];           // what momentum goes on from
  Lanes initial_impulse;       // the normal impulse that the substep began with
};

struct alignas(64) PairBatch {
  std::int32_t a[batch_lanes], b[batch_lanes];       // body rows
  Lanes normal[3], tangent[3];                       // the second tangent is their cross product
  Lanes offset[3];                                   // arm from B's centre − arm from A's centre
  Lanes mass_a, mass_b, inertia_a[6], inertia_b[6];  // inverses
  Lanes friction;
  Lanes rolling_arm, spinning_arm;
  Lanes moment_inverse_nn, moment_inverse_tt[3], moment_inverse_rho, moment_w10, moment_w20;
  Lanes moment[3], moment_total[3], moment_previous[3];  // in the frame
  Lanes normal_miss, tangent_miss, load;  // after evaluate: residuals, and their load (residual.hpp)
  std::int32_t first, points;             // point batches
  bool resists;                           // any rolling or spinning
};

/// Sums over a batch in the last iteration: Σ|Δλ|, Σ λ_n [N s].
struct BatchSums {
  float change = 0, normal_load = 0;
};

/// The arrays that a kernel works on.
struct BatchArrays {
  PairBatch* pairs;
  PointBatch* points;
  BodyRow* bodies;       // velocities
  const BodyRow* begin;  // at the end of the last substep, before push and extrapolation
  BodyRow* corrections;  // of the velocities that the next substep starts from
  const BodyResponse* responses;
  BatchSums* sums;
};

/// What an iteration is in its substep. The first one finds gaps and targets before a pair is solved, the
/// last one hands its impulses over to the next substep after: a pair's data pass through the cache once.
struct Iteration {
  float h;                // of the substep [s]
  bool first, last;       // iteration of the substep
  bool first_substep;     // of the step: gaps are those of its start
  float momentum = 0;     // starts from impulse + momentum (impulse - previous), as the velocities do
  bool remember = false;  // makes its impulses `previous`, as they are without momentum
};

struct BatchRange {
  int begin, end;
};

// The kernels, run with the best instruction set of this machine; all sets give the same bits. The batches of
// a range are taken one after another.

/// Responses and their inverses, from arms, normals and bodies.
void prepare_batches(const BatchArrays& arrays, BatchRange range);
/// Start impulses on the bodies.
void start_batches(const BatchArrays& arrays, BatchRange range);
void iterate_batches(const BatchArrays& arrays, BatchRange range, const Iteration& iteration);
/// What the last iteration of a substep does at its end, where it was not known to be the last: adds the
/// impulses to the totals and leaves start impulses without impacts; what extrapolation would repeat of these
/// goes into the corrections.
void end_substep_batches(const BatchArrays& arrays, BatchRange range);
/// So many substeps more with the impulses of the last: adds them to the totals.
void repeat_batches(const BatchArrays& arrays, BatchRange range, int substeps);
/// The natural map of the law in the substep that has just ended (residual.hpp), summed over a pair's points.
void evaluate_batches(const BatchArrays& arrays, BatchRange range);

}  // namespace drawpoint::engine::detail
