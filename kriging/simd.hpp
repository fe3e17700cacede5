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
/// The exponential reduces x = n ln 2 + r with |r| <= ln 2/2 and sums Taylor's series to r¹³: the first term
/// left out is below 4e-18, so the error is round-off, below 2 units in the last place.

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
  Vector sum = r * (1.0 / 6227020800.0) + 1.0 / 479001600.0;
  sum = sum * r + 1.0 / 39916800.0;
  sum = sum * r + 1.0 / 3628800.0;
  sum = sum * r + 1.0 / 362880.0;
  sum = sum * r + 1.0 / 40320.0;
  sum = sum * r + 1.0 / 5040.0;
  sum = sum * r + 1.0 / 720.0;
  sum = sum * r + 1.0 / 120.0;
  sum = sum * r + 1.0 / 24.0;
  sum = sum * r + 1.0 / 6.0;
  sum = sum * r + 0.5;
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

/// Σⱼ wⱼ exp(−Σₖ θₖ (zₖ − xⱼₖ)²) for `width` points z at once; row j of the runs stands at x + j·variables.
template <class Isa>
[[gnu::always_inline]] inline void gaussian_sum_kernel(const GaussianColumn& c, const double* weights,
                                                       std::ptrdiff_t runs, double* out) {
  using Vector = typename Isa::Vector;
  using Unaligned = typename Isa::Unaligned;
  Vector total{};
  const double* x = c.x;
  for (std::ptrdiff_t j = 0; j < runs; ++j, x += c.variables) {
    Vector sum{};
    for (std::ptrdiff_t k = 0; k < c.variables; ++k) {
      const Vector step = *reinterpret_cast<const Unaligned*>(c.Z + k * c.stride) - x[k];
      sum -= step * step * c.theta[k];
    }
    exp_of_nonpositive<Isa>(sum);
    total += sum * weights[j];
  }
  *reinterpret_cast<Unaligned*>(out) = total;
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] inline void gaussian_quad(const GaussianColumn& c, std::ptrdiff_t count,
                                                  double* out) {
  gaussian_kernel<Quad>(c, count, out);
}
[[gnu::target("avx2")]] inline void gaussian_sum_quad(const GaussianColumn& c, const double* weights,
                                                      std::ptrdiff_t runs, double* out) {
  gaussian_sum_kernel<Quad>(c, weights, runs, out);
}
#endif

inline void gaussian_column(const GaussianColumn& c, std::ptrdiff_t count, double* out) {
#if defined(__x86_64__)
  if (has_quad()) return gaussian_quad(c, count, out);
#endif
  gaussian_kernel<Pair>(c, count, out);
}

/// Four points at once: c.Z has room for four rows, out for four numbers.
inline void gaussian_sum_of_four(const GaussianColumn& c, const double* weights, std::ptrdiff_t runs,
                                 double* out) {
#if defined(__x86_64__)
  if (has_quad()) return gaussian_sum_quad(c, weights, runs, out);
#endif
  GaussianColumn second = c;
  second.Z += 2;
  gaussian_sum_kernel<Pair>(c, weights, runs, out);
  gaussian_sum_kernel<Pair>(second, weights, runs, out + 2);
}

}  // namespace drawpoint::kriging::detail
