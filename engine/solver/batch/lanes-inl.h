// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Arithmetic on the lanes of a batch, for the kernels (batch_kernels.cpp), compiled once per instruction set.
///
/// A `V` holds `width` pairs: one vector of sixteen where there is one, else two parts side by side, so that
/// two chains of dependent operations run at a time. Products and sums are separate operations on every
/// target (no fused multiply-add), so the bits do not depend on the target. Highway includes this file once a
/// target; hence the toggle instead of a guard.
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

using D = hn::CappedTag<float, HWY_MAX_BYTES == 64 ? batch_lanes : batch_lanes / 2>;
using Part = hn::Vec<D>;
constexpr D d;
constexpr int parts = HWY_MAX_BYTES == 64 ? 1 : 2;
constexpr int part_width = static_cast<int>(hn::MaxLanes(D()));
constexpr int width = parts * part_width;

struct V {
  Part v[parts];
};
struct Mask {
  hn::Mask<D> m[parts];
};

// operation(k) for each part k.
template <class Operation>
HWY_INLINE V each(const Operation& operation) {
  V result;
  for (int k = 0; k < parts; ++k) result.v[k] = operation(k);
  return result;
}

HWY_INLINE V all(float x) {
  return each([x](int) HWY_ATTR { return hn::Set(d, x); });
}
HWY_INLINE V load(const Lanes& lanes, int at) {
  return each([&](int k) HWY_ATTR { return hn::Load(d, lanes + at + k * part_width); });
}
HWY_INLINE void store(const V& x, Lanes& lanes, int at) {
  for (int k = 0; k < parts; ++k) hn::Store(x.v[k], d, lanes + at + k * part_width);
}
HWY_INLINE V operator+(const V& x, const V& y) {
  return each([&](int k) HWY_ATTR { return hn::Add(x.v[k], y.v[k]); });
}
HWY_INLINE V operator-(const V& x, const V& y) {
  return each([&](int k) HWY_ATTR { return hn::Sub(x.v[k], y.v[k]); });
}
HWY_INLINE V operator*(const V& x, const V& y) {
  return each([&](int k) HWY_ATTR { return hn::Mul(x.v[k], y.v[k]); });
}
HWY_INLINE V operator/(const V& x, const V& y) {
  return each([&](int k) HWY_ATTR { return hn::Div(x.v[k], y.v[k]); });
}
HWY_INLINE V min(const V& x, const V& y) {
  return each([&](int k) HWY_ATTR { return hn::Min(x.v[k], y.v[k]); });
}
HWY_INLINE V max(const V& x, const V& y) {
  return each([&](int k) HWY_ATTR { return hn::Max(x.v[k], y.v[k]); });
}
HWY_INLINE V operator-(const V& x) {
  return each([&](int k) HWY_ATTR { return hn::Neg(x.v[k]); });
}
HWY_INLINE V abs(const V& x) {
  return each([&](int k) HWY_ATTR { return hn::Abs(x.v[k]); });
}
HWY_INLINE V sqrt(const V& x) {
  return each([&](int k) HWY_ATTR { return hn::Sqrt(x.v[k]); });
}
HWY_INLINE Mask operator>(const V& x, const V& y) {
  Mask result;
  for (int k = 0; k < parts; ++k) result.m[k] = hn::Gt(x.v[k], y.v[k]);
  return result;
}
HWY_INLINE Mask operator<(const V& x, const V& y) { return y > x; }
HWY_INLINE V select(const Mask& m, const V& yes, const V& no) {
  return each([&](int k) HWY_ATTR { return hn::IfThenElse(m.m[k], yes.v[k], no.v[k]); });
}
HWY_INLINE V select_or_zero(const Mask& m, const V& yes) {
  return each([&](int k) HWY_ATTR { return hn::IfThenElseZero(m.m[k], yes.v[k]); });
}
HWY_INLINE bool all_zero(const V& x) {
  bool zero = true;
  for (int k = 0; k < parts; ++k) zero = zero && hn::AllTrue(d, hn::Eq(x.v[k], hn::Zero(d)));
  return zero;
}

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

// Four floats of as many rows as a part has lanes, as four parts, one a column.
struct Columns {
  Part c[4];
};

#if HWY_TARGET == HWY_SCALAR

template <class Row>
HWY_INLINE Columns gather_part(const Row& row, const std::int32_t* index) {
  const float* r = row(*index);
  return {{hn::Set(d, r[0]), hn::Set(d, r[1]), hn::Set(d, r[2]), hn::Set(d, r[3])}};
}

template <class Row>
HWY_INLINE void scatter_part(Part x, Part y, Part z, const Row& row, const std::int32_t* index) {
  float* r = row(*index);
  r[0] = hn::GetLane(x);
  r[1] = hn::GetLane(y);
  r[2] = hn::GetLane(z);
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
HWY_INLINE Columns gather_part(const Row& row, const std::int32_t* index) {
  const Part r0 = rows<part_width>(row, index, 0), r1 = rows<part_width>(row, index, 1),
             r2 = rows<part_width>(row, index, 2), r3 = rows<part_width>(row, index, 3);
  const Part t0 = hn::InterleaveLower(d, r0, r2), t1 = hn::InterleaveLower(d, r1, r3);
  const Part t2 = hn::InterleaveUpper(d, r0, r2), t3 = hn::InterleaveUpper(d, r1, r3);
  return {{hn::InterleaveLower(d, t0, t1), hn::InterleaveUpper(d, t0, t1), hn::InterleaveLower(d, t2, t3),
           hn::InterleaveUpper(d, t2, t3)}};
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
HWY_INLINE void scatter_part(Part x, Part y, Part z, const Row& row, const std::int32_t* index) {
  const Part zero = hn::Zero(d);
  const Part a0 = hn::InterleaveLower(d, x, z), a1 = hn::InterleaveLower(d, y, zero);
  const Part a2 = hn::InterleaveUpper(d, x, z), a3 = hn::InterleaveUpper(d, y, zero);
  put_rows<part_width>(hn::InterleaveLower(d, a0, a1), row, index, 0);
  put_rows<part_width>(hn::InterleaveUpper(d, a0, a1), row, index, 1);
  put_rows<part_width>(hn::InterleaveLower(d, a2, a3), row, index, 2);
  put_rows<part_width>(hn::InterleaveUpper(d, a2, a3), row, index, 3);
}

#endif

/// Four numbers of each lane's row; row(k) is where row k starts, aligned to 16 bytes.
struct V4 {
  V c[4];
};

template <class Row>
HWY_INLINE V4 gather(const Row& row, const std::int32_t* index) {
  V4 result;
  for (int k = 0; k < parts; ++k) {
    const Columns columns = gather_part(row, index + k * part_width);
    for (int i = 0; i < 4; ++i) result.c[i].v[k] = columns.c[i];
  }
  return result;
}

/// Writes three numbers and a zero or nothing; no two lanes may have the same row.
template <class Row>
HWY_INLINE void scatter(const V3& a, const Row& row, const std::int32_t* index) {
  for (int k = 0; k < parts; ++k) scatter_part(a.x.v[k], a.y.v[k], a.z.v[k], row, index + k * part_width);
}

}  // namespace drawpoint::engine::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
