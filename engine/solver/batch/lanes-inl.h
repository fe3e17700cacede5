// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Arithmetic on the lanes of a batch, for the kernels (batch_kernels.cpp), compiled once per instruction set.
///
/// A `V` holds `width` pairs, as many as a register of the target holds. (Two registers side by side are slower: GCC
/// keeps them in memory.) Products and sums are separate operations on every target (no fused multiply-add), so the
/// bits do not depend on the target. Highway includes this file once a target; hence the toggle instead of a guard.
#if defined(DRAWPOINT_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DRAWPOINT_LANES_INL
#undef DRAWPOINT_LANES_INL
#else
#define DRAWPOINT_LANES_INL
#endif

#include <hwy/highway.h>

#include <drawpoint/engine/solver/batch/pair_batch.h>

HWY_BEFORE_NAMESPACE();
namespace drawpoint::engine::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, batch_lanes>;
using Register = hn::Vec<D>;
constexpr D d;
constexpr int width = static_cast<int>(hn::MaxLanes(D()));

// One-member structs: the operators of a register are the compiler's.
struct V {
  Register v;
};
struct Mask {
  hn::Mask<D> m;
};

HWY_INLINE V all(float x) { return {hn::Set(d, x)}; }
HWY_INLINE V load(const Lanes& lanes, int at) { return {hn::Load(d, lanes + at)}; }
HWY_INLINE void store(const V& x, Lanes& lanes, int at) { hn::Store(x.v, d, lanes + at); }
HWY_INLINE V operator+(const V& x, const V& y) { return {hn::Add(x.v, y.v)}; }
HWY_INLINE V operator-(const V& x, const V& y) { return {hn::Sub(x.v, y.v)}; }
HWY_INLINE V operator*(const V& x, const V& y) { return {hn::Mul(x.v, y.v)}; }
HWY_INLINE V operator/(const V& x, const V& y) { return {hn::Div(x.v, y.v)}; }
HWY_INLINE V min(const V& x, const V& y) { return {hn::Min(x.v, y.v)}; }
HWY_INLINE V max(const V& x, const V& y) { return {hn::Max(x.v, y.v)}; }
HWY_INLINE V operator-(const V& x) { return {hn::Neg(x.v)}; }
HWY_INLINE V abs(const V& x) { return {hn::Abs(x.v)}; }
HWY_INLINE V sqrt(const V& x) { return {hn::Sqrt(x.v)}; }
HWY_INLINE Mask operator>(const V& x, const V& y) { return {hn::Gt(x.v, y.v)}; }
HWY_INLINE Mask operator<(const V& x, const V& y) { return y > x; }
HWY_INLINE V select(const Mask& m, const V& yes, const V& no) { return {hn::IfThenElse(m.m, yes.v, no.v)}; }
HWY_INLINE V select_or_zero(const Mask& m, const V& yes) { return {hn::IfThenElseZero(m.m, yes.v)}; }
HWY_INLINE bool all_zero(const V& x) { return hn::AllTrue(d, hn::Eq(x.v, hn::Zero(d))); }

/// All lanes of a batch, halves folded upon halves: in the same order whatever the target.
HWY_INLINE float sum_of(const Lanes& lanes) {
  float folded[batch_lanes / 2];
  for (int k = 0; k < batch_lanes / 2; ++k) folded[k] = lanes[k] + lanes[k + batch_lanes / 2];
  for (int left = batch_lanes / 4; left > 0; left /= 2)
    for (int k = 0; k < left; ++k) folded[k] += folded[k + left];
  return folded[0];
}

struct V3 {
  V x, y, z;
};

HWY_INLINE V3 load(const Lanes (&lanes)[3], int at) {
  return {load(lanes[0], at), load(lanes[1], at), load(lanes[2], at)};
}
HWY_INLINE void store(const V3& v, Lanes (&lanes)[3], int at) {
  store(v.x, lanes[0], at);
  store(v.y, lanes[1], at);
  store(v.z, lanes[2], at);
}
HWY_INLINE V3 operator+(const V3& a, const V3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE V3 operator-(const V3& a, const V3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE V3 operator*(const V& s, const V3& a) { return {s * a.x, s * a.y, s * a.z}; }
HWY_INLINE V dot(const V3& a, const V3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Symmetric {  // xx, xy, xz, yy, yz, zz
  V m[6];
};
HWY_INLINE V3 operator*(const Symmetric& A, const V3& b) {
  return {A.m[0] * b.x + A.m[1] * b.y + A.m[2] * b.z, A.m[1] * b.x + A.m[3] * b.y + A.m[4] * b.z,
          A.m[2] * b.x + A.m[4] * b.y + A.m[5] * b.z};
}
HWY_INLINE Symmetric load(const Lanes (&lanes)[6], int at) {
  return {{load(lanes[0], at), load(lanes[1], at), load(lanes[2], at), load(lanes[3], at), load(lanes[4], at),
           load(lanes[5], at)}};
}

/// Four numbers of the row of each lane: row(k) is where row k starts, aligned to 16 bytes.
struct V4 {
  V c[4];
};

#if HWY_TARGET == HWY_SCALAR

template <class Row>
HWY_INLINE V4 gather(const Row& row, const std::int32_t* index) {
  const float* r = row(*index);
  return {{all(r[0]), all(r[1]), all(r[2]), all(r[3])}};
}

// Writes three numbers and a zero or nothing; no two lanes may have the same row.
template <class Row>
HWY_INLINE void scatter(const V3& a, const Row& row, const std::int32_t* index) {
  float* r = row(*index);
  r[0] = hn::GetLane(a.x.v);
  r[1] = hn::GetLane(a.y.v);
  r[2] = hn::GetLane(a.z.v);
}

#else

// Rows k, k + 4, k + 8 ... below `N`, one per block of four lanes.
template <int N, class Row>
HWY_INLINE auto rows(const Row& row, const std::int32_t* index, int k) {
  if constexpr (N == 4)
    return hn::Load(hn::FixedTag<float, 4>(), row(index[k]));
  else
    return hn::Combine(hn::FixedTag<float, N>(), rows<N / 2>(row, index + N / 2, k),
                       rows<N / 2>(row, index, k));
}

template <class Row>
HWY_INLINE V4 gather(const Row& row, const std::int32_t* index) {
  const Register r0 = rows<width>(row, index, 0), r1 = rows<width>(row, index, 1),
                 r2 = rows<width>(row, index, 2), r3 = rows<width>(row, index, 3);
  const Register t0 = hn::InterleaveLower(d, r0, r2), t1 = hn::InterleaveLower(d, r1, r3);
  const Register t2 = hn::InterleaveUpper(d, r0, r2), t3 = hn::InterleaveUpper(d, r1, r3);
  return {{{hn::InterleaveLower(d, t0, t1)},
           {hn::InterleaveUpper(d, t0, t1)},
           {hn::InterleaveLower(d, t2, t3)},
           {hn::InterleaveUpper(d, t2, t3)}}};
}

template <int N, class Vector, class Row>
HWY_INLINE void put_rows(Vector v, const Row& row, const std::int32_t* index, int k) {
  if constexpr (N == 4) {
    hn::Store(v, hn::FixedTag<float, 4>(), row(index[k]));
  } else {
    const hn::FixedTag<float, N / 2> half;
    put_rows<N / 2>(hn::LowerHalf(half, v), row, index, k);
    put_rows<N / 2>(hn::UpperHalf(half, v), row, index + N / 2, k);
  }
}

template <class Row>
HWY_INLINE void scatter(const V3& a, const Row& row, const std::int32_t* index) {
  const Register zero = hn::Zero(d);
  const Register a0 = hn::InterleaveLower(d, a.x.v, a.z.v), a1 = hn::InterleaveLower(d, a.y.v, zero);
  const Register a2 = hn::InterleaveUpper(d, a.x.v, a.z.v), a3 = hn::InterleaveUpper(d, a.y.v, zero);
  put_rows<width>(hn::InterleaveLower(d, a0, a1), row, index, 0);
  put_rows<width>(hn::InterleaveUpper(d, a0, a1), row, index, 1);
  put_rows<width>(hn::InterleaveLower(d, a2, a3), row, index, 2);
  put_rows<width>(hn::InterleaveUpper(d, a2, a3), row, index, 3);
}

#endif

}  // namespace drawpoint::engine::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
