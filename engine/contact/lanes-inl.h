// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Arithmetic on the lanes of a batch, for the kernels (batch_kernels.cpp), compiled once an instruction set.
///
/// A `V` holds `width` pairs: two vectors side by side, so that two chains of dependent operations run at a
/// time. Products and sums are separate operations on every target (no fused multiply-add), so the bits do
/// not depend on the target. Highway includes this file once a target; hence the toggle instead of a guard.
#if defined(DRAWPOINT_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DRAWPOINT_LANES_INL
#undef DRAWPOINT_LANES_INL
#else
#define DRAWPOINT_LANES_INL
#endif

#include <hwy/highway.h>

#include <drawpoint/engine/contact/pair_batch.hpp>

HWY_BEFORE_NAMESPACE();
namespace drawpoint::engine::contact::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, batch_lanes / 2>;
using Half = hn::Vec<D>;
constexpr D d;
constexpr int half_width = static_cast<int>(hn::MaxLanes(D()));
constexpr int width = 2 * half_width;

struct V {
  Half v[2];
};
struct Mask {
  hn::Mask<D> m[2];
};

HWY_INLINE V all(float x) { return {{hn::Set(d, x), hn::Set(d, x)}}; }
HWY_INLINE V load(const Lanes& lanes, int at) {
  return {{hn::Load(d, lanes + at), hn::Load(d, lanes + at + half_width)}};
}
HWY_INLINE void store(const V& x, Lanes& lanes, int at) {
  hn::Store(x.v[0], d, lanes + at);
  hn::Store(x.v[1], d, lanes + at + half_width);
}
HWY_INLINE V operator+(const V& x, const V& y) {
  return {{hn::Add(x.v[0], y.v[0]), hn::Add(x.v[1], y.v[1])}};
}
HWY_INLINE V operator-(const V& x, const V& y) {
  return {{hn::Sub(x.v[0], y.v[0]), hn::Sub(x.v[1], y.v[1])}};
}
HWY_INLINE V operator*(const V& x, const V& y) {
  return {{hn::Mul(x.v[0], y.v[0]), hn::Mul(x.v[1], y.v[1])}};
}
HWY_INLINE V operator/(const V& x, const V& y) {
  return {{hn::Div(x.v[0], y.v[0]), hn::Div(x.v[1], y.v[1])}};
}
HWY_INLINE V operator-(const V& x) { return {{hn::Neg(x.v[0]), hn::Neg(x.v[1])}}; }
HWY_INLINE Mask operator>(const V& x, const V& y) {
  return {{hn::Gt(x.v[0], y.v[0]), hn::Gt(x.v[1], y.v[1])}};
}
HWY_INLINE Mask operator<(const V& x, const V& y) { return y > x; }
HWY_INLINE V abs(const V& x) { return {{hn::Abs(x.v[0]), hn::Abs(x.v[1])}}; }
HWY_INLINE V sqrt(const V& x) { return {{hn::Sqrt(x.v[0]), hn::Sqrt(x.v[1])}}; }
HWY_INLINE V min(const V& x, const V& y) { return {{hn::Min(x.v[0], y.v[0]), hn::Min(x.v[1], y.v[1])}}; }
HWY_INLINE V max(const V& x, const V& y) { return {{hn::Max(x.v[0], y.v[0]), hn::Max(x.v[1], y.v[1])}}; }
HWY_INLINE V select(const Mask& m, const V& yes, const V& no) {
  return {{hn::IfThenElse(m.m[0], yes.v[0], no.v[0]), hn::IfThenElse(m.m[1], yes.v[1], no.v[1])}};
}
HWY_INLINE V select_or_zero(const Mask& m, const V& yes) {
  return {{hn::IfThenElseZero(m.m[0], yes.v[0]), hn::IfThenElseZero(m.m[1], yes.v[1])}};
}
HWY_INLINE bool all_zero(const V& x) {
  return hn::AllTrue(d, hn::Eq(hn::Max(hn::Abs(x.v[0]), hn::Abs(x.v[1])), hn::Zero(d)));
}

/// `total` and the lanes, added in their order whatever the target.
HWY_INLINE float plus_lanes(float total, const V& x) {
  alignas(32) Lanes lanes;
  store(x, lanes, 0);
  for (int k = 0; k < width; ++k) total += lanes[k];
  return total;
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

// Four floats of as many rows as a vector has lanes, as four vectors, one a column.
struct Columns {
  Half c[4];
};

#if HWY_TARGET == HWY_SCALAR

template <class Row>
HWY_INLINE Columns gather_half(const Row& row, const std::int32_t* index) {
  const float* r = row(*index);
  return {{hn::Set(d, r[0]), hn::Set(d, r[1]), hn::Set(d, r[2]), hn::Set(d, r[3])}};
}

template <class Row>
HWY_INLINE void scatter_half(Half x, Half y, Half z, const Row& row, const std::int32_t* index) {
  float* r = row(*index);
  r[0] = hn::GetLane(x);
  r[1] = hn::GetLane(y);
  r[2] = hn::GetLane(z);
}

#else

// Within blocks of four lanes; the second block holds rows 4 to 7.
template <class Row>
HWY_INLINE Half row_pair(const Row& row, const std::int32_t* index, int k) {
  const hn::FixedTag<float, 4> quarter;
  if constexpr (half_width == 8)
    return hn::Combine(d, hn::Load(quarter, row(index[k + 4])), hn::Load(quarter, row(index[k])));
  else
    return hn::Load(quarter, row(index[k]));
}

template <class Row>
HWY_INLINE Columns gather_half(const Row& row, const std::int32_t* index) {
  const Half r0 = row_pair(row, index, 0), r1 = row_pair(row, index, 1), r2 = row_pair(row, index, 2),
             r3 = row_pair(row, index, 3);
  const Half t0 = hn::InterleaveLower(d, r0, r2), t1 = hn::InterleaveLower(d, r1, r3);
  const Half t2 = hn::InterleaveUpper(d, r0, r2), t3 = hn::InterleaveUpper(d, r1, r3);
  return {{hn::InterleaveLower(d, t0, t1), hn::InterleaveUpper(d, t0, t1), hn::InterleaveLower(d, t2, t3),
           hn::InterleaveUpper(d, t2, t3)}};
}

template <class Vector, class Row>
HWY_INLINE void put_row(Vector v, const Row& row, const std::int32_t* index, int k) {
  const hn::FixedTag<float, 4> quarter;
  if constexpr (half_width == 8) {
    hn::Store(hn::LowerHalf(quarter, v), quarter, row(index[k]));
    hn::Store(hn::UpperHalf(quarter, v), quarter, row(index[k + 4]));
  } else {
    hn::Store(v, quarter, row(index[k]));
  }
}

template <class Row>
HWY_INLINE void scatter_half(Half x, Half y, Half z, const Row& row, const std::int32_t* index) {
  const Half zero = hn::Zero(d);
  const Half a0 = hn::InterleaveLower(d, x, z), a1 = hn::InterleaveLower(d, y, zero);
  const Half a2 = hn::InterleaveUpper(d, x, z), a3 = hn::InterleaveUpper(d, y, zero);
  put_row(hn::InterleaveLower(d, a0, a1), row, index, 0);
  put_row(hn::InterleaveUpper(d, a0, a1), row, index, 1);
  put_row(hn::InterleaveLower(d, a2, a3), row, index, 2);
  put_row(hn::InterleaveUpper(d, a2, a3), row, index, 3);
}

#endif

/// Four numbers of each lane's row; row(k) is where row k starts, aligned to 16 bytes.
struct V4 {
  V c[4];
};

template <class Row>
HWY_INLINE V4 gather(const Row& row, const std::int32_t* index) {
  const Columns lower = gather_half(row, index), upper = gather_half(row, index + half_width);
  return {{{{lower.c[0], upper.c[0]}},
           {{lower.c[1], upper.c[1]}},
           {{lower.c[2], upper.c[2]}},
           {{lower.c[3], upper.c[3]}}}};
}

/// Writes three numbers and a zero or nothing; no two lanes may have the same row.
template <class Row>
HWY_INLINE void scatter(const V3& a, const Row& row, const std::int32_t* index) {
  scatter_half(a.x.v[0], a.y.v[0], a.z.v[0], row, index);
  scatter_half(a.x.v[1], a.y.v[1], a.z.v[1], row, index + half_width);
}

}  // namespace drawpoint::engine::contact::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
