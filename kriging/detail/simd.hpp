// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Vectors of double of the widest kind that this machine has, chosen when the program runs.
///
/// Kernels are templates on `Pair` (SSE2, any x86-64; elsewhere what the compiler makes of it) or `Quad`
/// (AVX2). A kernel is compiled for both and `has_quad()` picks one, so consumers need no flags. Both do the
/// same operations in the same order for each number, and neither fuses multiplication with addition, so both
/// give the same bits. Simplification: without fused operations a processor of Intel's reaches half of its
/// peak; one of AMD's loses nothing.
///
/// The exponential reduces x = n ln 2 + r with |r| <= ln 2/2 and takes eʳ = 1 + r + r² q(r), q the polynomial
/// of degree 9 nearest to the true one (Chebyshev): it is off by 2e-17, so the error is round-off, below 2
/// units in the last place.

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace drawpoint::kriging::detail {

struct Pair {
  static constexpr int width = 2;
  typedef double Vector __attribute__((vector_size(16)));
  typedef double Unaligned __attribute__((vector_size(16), aligned(8), may_alias));
  typedef std::int64_t Bits __attribute__((vector_size(16)));
};

struct Quad {
  static constexpr int width = 4;
  typedef double Vector __attribute__((vector_size(32)));
  typedef double Unaligned __attribute__((vector_size(32), aligned(8), may_alias));
  typedef std::int64_t Bits __attribute__((vector_size(32)));
};

#if defined(__x86_64__)
inline bool has_quad() {
  static const bool yes = __builtin_cpu_supports("avx2");
  return yes;
}
#endif

/// x = exp(x) for x <= 0; below −708, where doubles lose their digits, exp(−708) = 3e-308.
template <class Isa>
[[gnu::always_inline]] inline void exp_of_nonpositive(typename Isa::Vector& x) {
  using Vector = typename Isa::Vector;
  using Bits = typename Isa::Bits;
  constexpr double magic = 0x1.8p52;  // adding it rounds to a whole number, which then stands in the low bits
  const Vector floor = Vector{} - 708.0;
  x = x < floor ? floor : x;
  const Vector shifted = x * 0x1.71547652b82fep+0 + magic;
  const Vector n = shifted - magic;
  const Vector r = (x - n * 0x1.62e42fee00000p-1) - n * 0x1.a39ef35793c76p-33;
  Vector sum = r * 0x1.af38a9b0ec855p-26 + 0x1.289185613a3d6p-22;
  sum = sum * r + 0x1.71de0dae63bb3p-19;
  sum = sum * r + 0x1.a019b90d2ae7ap-16;
  sum = sum * r + 0x1.a01a01a7c41d5p-13;
  sum = sum * r + 0x1.6c16c1788bd90p-10;
  sum = sum * r + 0x1.11111111109b3p-7;
  sum = sum * r + 0x1.5555555553d63p-5;
  sum = sum * r + 0x1.5555555555556p-3;
  sum = sum * r + 0x1.0000000000001p-1;
  sum = (sum * r) * r + r + 1.0;
  const Bits scale = (reinterpret_cast<Bits>(shifted) + 1023) << 52;
  x = sum * reinterpret_cast<Vector>(scale);
}

template <class Isa>
[[gnu::always_inline]] inline void exp_kernel(double* x, std::ptrdiff_t count) {
  using Vector = typename Isa::Vector;
  constexpr int width = Isa::width;
  std::ptrdiff_t i = 0;
  for (; i + width <= count; i += width) {
    Vector v = *reinterpret_cast<const typename Isa::Unaligned*>(x + i);
    exp_of_nonpositive<Isa>(v);
    *reinterpret_cast<typename Isa::Unaligned*>(x + i) = v;
  }
  if (i == count) return;
  double rest[width] = {};
  std::memcpy(rest, x + i, static_cast<std::size_t>(count - i) * sizeof(double));
  Vector v = *reinterpret_cast<const typename Isa::Unaligned*>(rest);
  exp_of_nonpositive<Isa>(v);
  *reinterpret_cast<typename Isa::Unaligned*>(rest) = v;
  std::memcpy(x + i, rest, static_cast<std::size_t>(count - i) * sizeof(double));
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] inline void exp_quad(double* x, std::ptrdiff_t count) { exp_kernel<Quad>(x, count); }
#endif

/// x[0..count) = exp of each, all <= 0.
inline void exp_in_place(double* x, std::ptrdiff_t count) {
#if defined(__x86_64__)
  if (has_quad()) return exp_quad(x, count);
#endif
  exp_kernel<Pair>(x, count);
}

/// out[i] = exp(−Σₖ θₖ (zᵢₖ − xₖ)²) for `count` rows of Z, whose columns lie `stride` apart.
struct GaussianColumn {
  const double* Z;
  std::ptrdiff_t stride, variables;
  const double *theta, *x;
};

template <class Isa>
[[gnu::always_inline]] inline void gaussian_kernel(const GaussianColumn& c, std::ptrdiff_t count,
                                                   double* out) {
  using Unaligned = typename Isa::Unaligned;
  constexpr int width = Isa::width;
  std::ptrdiff_t i = 0;
  for (; i + width <= count; i += width) {
    typename Isa::Vector sum{};
    for (std::ptrdiff_t k = 0; k < c.variables; ++k) {
      const typename Isa::Vector step = *reinterpret_cast<const Unaligned*>(c.Z + i + k * c.stride) - c.x[k];
      sum -= step * step * c.theta[k];
    }
    exp_of_nonpositive<Isa>(sum);
    *reinterpret_cast<Unaligned*>(out + i) = sum;
  }
  if (i == count) return;
  const std::ptrdiff_t rest = i;
  for (; i < count; ++i) {
    out[i] = 0.0;
    for (std::ptrdiff_t k = 0; k < c.variables; ++k) {
      const double step = c.Z[i + k * c.stride] - c.x[k];
      out[i] -= step * step * c.theta[k];
    }
  }
  exp_kernel<Isa>(out + rest, count - rest);
}

/// Σ wᵢ (zᵢ − x)², in eight interleaved parts on any processor.
[[gnu::always_inline]] inline double weighted_squares_kernel(const double* w, const double* z, double x,
                                                             std::ptrdiff_t count) {
  using Unaligned = Quad::Unaligned;  // in halves where the processor has no such vectors
  Quad::Vector a{}, b{};
  std::ptrdiff_t i = 0;
  for (; i + 8 <= count; i += 8) {
    const Quad::Vector u = *reinterpret_cast<const Unaligned*>(z + i) - x;
    const Quad::Vector v = *reinterpret_cast<const Unaligned*>(z + i + 4) - x;
    a += *reinterpret_cast<const Unaligned*>(w + i) * u * u;
    b += *reinterpret_cast<const Unaligned*>(w + i + 4) * v * v;
  }
  a += b;
  double rest = 0.0;
  for (; i < count; ++i) rest += w[i] * (z[i] - x) * (z[i] - x);
  return ((a[0] + a[2]) + (a[1] + a[3])) + rest;
}

/// Runs against which points are summed, their coordinates multiplied by √θₖ; run j stands at x +
/// j·variables.
struct GaussianRuns {
  const double* x;
  const double* weights;
  std::ptrdiff_t count, variables;
};

inline constexpr std::ptrdiff_t points_at_once = 8;

/// Σⱼ wⱼ exp(−|z − xⱼ|²) for two vectors of points; coordinate k of all eight stands at z + 8k.
template <class Isa>
[[gnu::always_inline]] inline void gaussian_sum_kernel(const GaussianRuns& runs, const double* z,
                                                       double* out) {
  using Vector = typename Isa::Vector;
  using Unaligned = typename Isa::Unaligned;
  Vector first_total{}, second_total{};
  const double* x = runs.x;
  for (std::ptrdiff_t j = 0; j < runs.count; ++j, x += runs.variables) {
    Vector first{}, second{};
    const double* at = z;
    for (std::ptrdiff_t k = 0; k < runs.variables; ++k, at += points_at_once) {
      const Vector a = *reinterpret_cast<const Unaligned*>(at) - x[k];
      const Vector b = *reinterpret_cast<const Unaligned*>(at + Isa::width) - x[k];
      first -= a * a;
      second -= b * b;
    }
    exp_of_nonpositive<Isa>(first);
    exp_of_nonpositive<Isa>(second);
    first_total += first * runs.weights[j];
    second_total += second * runs.weights[j];
  }
  *reinterpret_cast<Unaligned*>(out) = first_total;
  *reinterpret_cast<Unaligned*>(out + Isa::width) = second_total;
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] inline void gaussian_quad(const GaussianColumn& c, std::ptrdiff_t count,
                                                  double* out) {
  gaussian_kernel<Quad>(c, count, out);
}
[[gnu::target("avx2")]] inline double weighted_squares_quad(const double* w, const double* z, double x,
                                                            std::ptrdiff_t count) {
  return weighted_squares_kernel(w, z, x, count);
}
[[gnu::target("avx2")]] inline void gaussian_sum_quad(const GaussianRuns& runs, const double* z,
                                                      double* out) {
  gaussian_sum_kernel<Quad>(runs, z, out);
}
#endif

inline void gaussian_column(const GaussianColumn& c, std::ptrdiff_t count, double* out) {
#if defined(__x86_64__)
  if (has_quad()) return gaussian_quad(c, count, out);
#endif
  gaussian_kernel<Pair>(c, count, out);
}

inline double weighted_squares(const double* w, const double* z, double x, std::ptrdiff_t count) {
#if defined(__x86_64__)
  if (has_quad()) return weighted_squares_quad(w, z, x, count);
#endif
  return weighted_squares_kernel(w, z, x, count);
}

/// Eight points, eight sums.
inline void gaussian_sums(const GaussianRuns& runs, const double* z, double* out) {
#if defined(__x86_64__)
  if (has_quad()) return gaussian_sum_quad(runs, z, out);
#endif
  for (std::ptrdiff_t i = 0; i < points_at_once; i += 2 * Pair::width)
    gaussian_sum_kernel<Pair>(runs, z + i, out + i);
}

}  // namespace drawpoint::kriging::detail
