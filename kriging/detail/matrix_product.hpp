// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// C += A Bᵀ or C −= A Bᵀ for column-major blocks, the one product that all n³ work of Kriging is made of.
///
/// C is cut into tiles, and each tile sums over the columns of A and B in stretches of `depth`: both are
/// packed to strips so that the innermost kernel holds a small block of C in registers and reads memory in
/// order (Goto, van de Geijn 2008, "Anatomy of high-performance matrix multiplication"). The order of the
/// sums does not depend on the processor or the number of threads. Cost 2mnk operations, O(tile · depth)
/// memory a thread.

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/parallel.hpp>
#include <drawpoint/kriging/detail/simd.hpp>

namespace drawpoint::kriging::detail {

/// A column-major block inside a larger matrix.
struct Block {
  double* data;
  Index rows, columns, stride;

  Block part(Index i, Index j, Index height, Index width) const {
    return {data + i + j * stride, height, width, stride};
  }
  double* column(Index j) const { return data + j * stride; }
};

inline Block block_of(Eigen::MatrixXd& A) { return {A.data(), A.rows(), A.cols(), A.rows()}; }

/// The block of a whole matrix that is only read.
inline Block block_of(const Eigen::MatrixXd& A) {
  return {const_cast<double*>(A.data()), A.rows(), A.cols(), A.rows()};
}

/// Which entries of C are wanted; those above its diagonal are then not defined afterwards.
enum class Part { all, lower };

inline constexpr Index strip_columns = 6, tile = 192, depth = 256;

/// Rows of A side by side in strips of `height`, zeros below the last row.
inline void pack(const Block& A, Index height, double* out) {
  for (Index i = 0; i < A.rows; i += height) {
    const Index rows = std::min(height, A.rows - i);
    for (Index k = 0; k < A.columns; ++k, out += height) {
      const double* from = A.column(k) + i;
      for (Index r = 0; r < rows; ++r) out[r] = from[r];
      for (Index r = rows; r < height; ++r) out[r] = 0.0;
    }
  }
}

/// sums (2 width x 6, column-major) = strip a times strip b transposed over `count` columns.
template <class Isa>
[[gnu::always_inline]] inline void strip_product(const double* a, const double* b, Index count,
                                                 double* sums) {
  using Vector = typename Isa::Vector;
  using Unaligned = typename Isa::Unaligned;
  constexpr int width = Isa::width;
  Vector u0{}, u1{}, u2{}, u3{}, u4{}, u5{}, v0{}, v1{}, v2{}, v3{}, v4{}, v5{};
  for (Index k = 0; k < count; ++k, a += 2 * width, b += strip_columns) {
    const Vector u = *reinterpret_cast<const Unaligned*>(a),
                 v = *reinterpret_cast<const Unaligned*>(a + width);
    u0 += u * b[0], v0 += v * b[0];
    u1 += u * b[1], v1 += v * b[1];
    u2 += u * b[2], v2 += v * b[2];
    u3 += u * b[3], v3 += v * b[3];
    u4 += u * b[4], v4 += v * b[4];
    u5 += u * b[5], v5 += v * b[5];
  }
  auto* out = reinterpret_cast<Unaligned*>(sums);
  out[0] = u0, out[1] = v0, out[2] = u1, out[3] = v1, out[4] = u2, out[5] = v2;
  out[6] = u3, out[7] = v3, out[8] = u4, out[9] = v4, out[10] = u5, out[11] = v5;
}

inline void add_sums(const double* sums, Index height, double sign, const Block& C) {
  for (Index j = 0; j < C.columns; ++j)
    for (Index i = 0; i < C.rows; ++i) C.column(j)[i] += sign * sums[i + j * height];
}

/// C += sign A Bᵀ from packed strips; `below` is how far the tile's first row lies below its first column.
template <class Isa>
[[gnu::always_inline]] inline void tile_kernel(const double* a, const double* b, Index count, double sign,
                                               const Block& C, Index below) {
  constexpr Index height = 2 * Isa::width;
  alignas(32) double sums[height * strip_columns];
  for (Index j = 0; j < C.columns; j += strip_columns) {
    for (Index i = 0; i < C.rows; i += height) {
      if (below + i + height <= j) continue;  // all above the diagonal
      strip_product<Isa>(a + i * count, b + j * count, count, sums);
      add_sums(sums, height, sign,
               C.part(i, j, std::min(height, C.rows - i), std::min(strip_columns, C.columns - j)));
    }
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] inline void tile_quad(const double* a, const double* b, Index count, double sign,
                                              const Block& C, Index below) {
  tile_kernel<Quad>(a, b, count, sign, C, below);
}
#endif

inline void tile_product(const double* a, const double* b, Index count, double sign, const Block& C,
                         Index below) {
#if defined(__x86_64__)
  if (has_quad()) return tile_quad(a, b, count, sign, C, below);
#endif
  tile_kernel<Pair>(a, b, count, sign, C, below);
}

inline Index strip_rows() {
#if defined(__x86_64__)
  if (has_quad()) return 2 * Quad::width;
#endif
  return 2 * Pair::width;
}

inline Index rounded_up(Index count, Index step) { return (count + step - 1) / step * step; }

/// One tile of C, from the rows of A and B that belong to it.
inline void multiply_tile(const Block& A, const Block& B, double sign, const Block& C, Index below) {
  static thread_local std::vector<double> packed;
  const Index height = strip_rows(), deepest = std::min(depth, A.columns);
  const Index size_a = rounded_up(A.rows, height) * deepest;
  const Index wanted = size_a + rounded_up(B.rows, strip_columns) * deepest;
  if (static_cast<Index>(packed.size()) < wanted) packed.resize(static_cast<std::size_t>(wanted));
  double *a = packed.data(), *b = a + size_a;
  for (Index k = 0; k < A.columns; k += depth) {
    const Index count = std::min(depth, A.columns - k);
    pack(A.part(0, k, A.rows, count), height, a);
    pack(B.part(0, k, B.rows, count), strip_columns, b);
    tile_product(a, b, count, sign, C, below);
  }
}

/// C: m x n += sign · A Bᵀ with A: m x k, B: n x k. C overlaps neither.
inline void add_product(const Block& A, const Block& B, double sign, const Block& C, Part part = Part::all,
                        int threads = 1) {
  constexpr double worth_a_thread = 2e7;  // operations; some milliseconds, where starting a thread takes 0.03
  if (2.0 * static_cast<double>(C.rows) * static_cast<double>(C.columns) * static_cast<double>(A.columns) <
      worth_a_thread)
    threads = 1;
  const int down = static_cast<int>((C.rows + tile - 1) / tile);
  const int across = static_cast<int>((C.columns + tile - 1) / tile);
  for_each_task(down * across, threads, [&](int t) {
    const Index i = tile * (t % down), j = tile * (t / down);
    if (part == Part::lower && i < j) return;
    const Index height = std::min(tile, C.rows - i), width = std::min(tile, C.columns - j);
    const Index below = part == Part::lower ? i - j : C.columns;
    multiply_tile(A.part(i, 0, height, A.columns), B.part(j, 0, width, B.columns), sign,
                  C.part(i, j, height, width), below);
  });
}

}  // namespace drawpoint::kriging::detail
