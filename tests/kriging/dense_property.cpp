// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// The matrix kernels: they compute what they say, on any processor and any number of threads the same bits.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint::kriging;
using namespace drawpoint::kriging::detail;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double eps = 2.3e-16;

// Below 16, at it, one above, with rests of strips, with several tiles.
constexpr Eigen::Index sizes[] = {1, 2, 15, 16, 17, 33, 100, 193, 400};

MatrixXd spread_matrix(Eigen::Index rows, Eigen::Index columns, drawpoint::doe::Seed seed) {
  return 2.0 * reference::design(static_cast<int>(rows), static_cast<int>(columns), seed).array() - 1.0;
}

MatrixXd positive_definite(Eigen::Index n) {
  const MatrixXd X = spread_matrix(n, n, 7);
  return X * X.transpose() / static_cast<double>(n) + 0.1 * MatrixXd::Identity(n, n);
}

MatrixXd lower(const MatrixXd& A) { return A.triangularView<Eigen::Lower>(); }

}  // namespace

// Sums of k products of numbers below 1 lose at most k ε each.
TEST(Product, IsThatOfItsDefinition) {
  for (const Eigen::Index m : {1, 7, 8, 50, 200})
    for (const Eigen::Index n : {1, 6, 13, 195})
      for (const Eigen::Index k : {1, 5, 256, 300}) {
        MatrixXd A = spread_matrix(m, k, 1), B = spread_matrix(n, k, 2), C = spread_matrix(m, n, 3);
        const MatrixXd expected = C - A * B.transpose();
        add_product(block_of(A), block_of(B), -1.0, block_of(C));
        EXPECT_LE((C - expected).cwiseAbs().maxCoeff(), 2.0 * static_cast<double>(k + 1) * eps);
      }
}

// Sums of n products of numbers below 1 lose at most n ε each.
TEST(Product, WithFewColumnsIsThatOfItsDefinition) {
  for (const Eigen::Index m : sizes) {
    const MatrixXd A = spread_matrix(m, 21, 1), B = spread_matrix(21, 3, 2), C = spread_matrix(m, 3, 4);
    const VectorXd x = B.col(0), y = C.col(0);
    const double bound = 2.0 * static_cast<double>(m + 21) * eps;
    EXPECT_LE((product(A, x) - A * x).cwiseAbs().maxCoeff(), bound) << m;
    EXPECT_LE((product(A, B) - A * B).cwiseAbs().maxCoeff(), bound) << m;
    EXPECT_LE((transposed_product(A, y) - A.transpose() * y).cwiseAbs().maxCoeff(), bound) << m;
    EXPECT_LE((transposed_product(A, C) - A.transpose() * C).cwiseAbs().maxCoeff(), bound) << m;
    EXPECT_LE((row_squares(A) - A.rowwise().squaredNorm()).cwiseAbs().maxCoeff(), bound) << m;
    MatrixXd outer = A;
    add_outer(outer, -2.0, y, x);
    EXPECT_LE((outer - (A - 2.0 * y * x.transpose())).cwiseAbs().maxCoeff(), bound) << m;
  }
}

// |L X − B| <= n ε |L| |X| row by row (Higham 2002, theorem 8.5); the entries of L are below 1.1, those of X
// below 15 times those of B, which are below 1, by the condition of positive_definite().
TEST(Triangle, IsSolvedFromBothSides) {
  for (const Eigen::Index n : sizes) {
    MatrixXd L = positive_definite(n);
    ASSERT_TRUE(factor(block_of(L), 1));
    clear_upper(L);
    const MatrixXd B = spread_matrix(n, 3, 9);
    const double bound = 17.0 * static_cast<double>(n * n) * eps;
    MatrixXd X = B;
    solve_lower(L, X);
    EXPECT_LE((L * X - B).cwiseAbs().maxCoeff(), bound) << n;
    X = B;
    solve_lower_transposed(L, X);
    EXPECT_LE((L.transpose() * X - B).cwiseAbs().maxCoeff(), bound) << n;
    const VectorXd x = solve_upper(L.transpose(), B.col(1));
    EXPECT_LE((L.transpose() * x - B.col(1)).cwiseAbs().maxCoeff(), bound) << n;
  }
}

// ‖L Lᵀ − A‖ <= n ε ‖A‖ for any order of the sums (Higham 2002, theorem 10.3), here per entry with ‖A‖ near
// 1; for the inverse times the condition, below 15 here, once more.
TEST(Cholesky, FactorsAndInverts) {
  for (const Eigen::Index n : sizes) {
    const MatrixXd A = positive_definite(n);
    MatrixXd L = A, X, K;
    ASSERT_TRUE(factor(block_of(L), 1));
    const double bound = 4.0 * static_cast<double>(n + 4) * eps;
    EXPECT_LE((lower(L) * lower(L).transpose() - A).cwiseAbs().maxCoeff(), bound) << n;
    inverse_transposed(L, X);
    EXPECT_LE((X.transpose() * lower(L) - MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 15 * bound) << n;
    EXPECT_TRUE(MatrixXd(X.triangularView<Eigen::StrictlyLower>()).isZero(0.0)) << n;
    product_of_upper(X, K);
    K = MatrixXd(K.selfadjointView<Eigen::Lower>());
    EXPECT_LE((K * A - MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 225 * bound) << n;
    MatrixXd B = spread_matrix(37, n, 5);
    const MatrixXd right = B;
    solve_right(block_of(L), block_of(B));
    EXPECT_LE((B * lower(L).transpose() - right).cwiseAbs().maxCoeff(), 15 * bound) << n;
  }
}

TEST(Cholesky, RefusesWhatIsNotPositiveDefinite) {
  for (const Eigen::Index n : sizes) {
    MatrixXd A = positive_definite(n);
    A(n - 1, n - 1) = -1.0;
    EXPECT_FALSE(factor(block_of(A), 1)) << n;
    A = positive_definite(n);
    A(0, 0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(factor(block_of(A), 1)) << n;
  }
}

// 600 is large enough for products to be shared out to threads.
TEST(Cholesky, GivesTheSameBitsOnAnyNumberOfThreads) {
  const MatrixXd A = positive_definite(600);
  MatrixXd L = A, X, K;
  ASSERT_TRUE(factor(block_of(L), 1));
  inverse_transposed(L, X, 1);
  product_of_upper(X, K, 1);
  for (const int threads : {2, 3, 8}) {
    MatrixXd other = A, Y, M;
    ASSERT_TRUE(factor(block_of(other), threads));
    inverse_transposed(other, Y, threads);
    product_of_upper(Y, M, threads);
    EXPECT_EQ(lower(L), lower(other));
    EXPECT_EQ(X, Y);
    EXPECT_EQ(lower(K), lower(M));
  }
}

// Two units in the last place: simd.hpp.
TEST(Exponential, IsGoodToTwoUnitsInTheLastPlace) {
  VectorXd x(20003);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = -700.0 * std::pow(static_cast<double>(i) / 20002.0, 3);
  VectorXd y = x;
  exp_in_place(y.data(), y.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) EXPECT_NEAR(y[i] / std::exp(x[i]), 1.0, 2.0 * eps) << x[i];
  EXPECT_EQ(y[0], 1.0);
}

// This test itself is compiled for any x86-64, so it can run the narrow kernels beside the wide ones.
TEST(Kernels, GiveTheSameBitsWithNarrowAndWideVectors) {
#if defined(__x86_64__)
  if (!has_quad()) GTEST_SKIP() << "this processor has no AVX2";
  VectorXd wide = -20.0 * reference::design(1001, 1, 3).col(0), narrow = wide;
  exp_quad(wide.data(), wide.size());
  exp_kernel<Pair>(narrow.data(), narrow.size());
  EXPECT_EQ(wide, narrow);

  for (const Eigen::Index n : {1, 3, 4, 7, 8, 29, 1001}) {
    EXPECT_EQ(dot_quad(wide.data(), narrow.data(), n), dot_kernel(wide.data(), narrow.data(), n));
    EXPECT_EQ(weighted_squares_quad(wide.data(), narrow.data(), 0.3, n),
              weighted_squares_kernel(wide.data(), narrow.data(), 0.3, n));
    VectorXd more = wide, same = wide;
    add_scaled_quad(more.data(), -0.7, narrow.data(), n);
    add_scaled_kernel(same.data(), -0.7, narrow.data(), n);
    EXPECT_EQ(more, same);
  }

  MatrixXd A = spread_matrix(53, 70, 1), B = spread_matrix(29, 70, 2), C = spread_matrix(53, 29, 3), D = C;
  std::vector<double> a(80 * 70), b(80 * 70);
  pack(block_of(A), 2 * Quad::width, a.data());
  pack(block_of(B), strip_columns, b.data());
  tile_quad(a.data(), b.data(), 70, -1.0, block_of(C), 29);
  pack(block_of(A), 2 * Pair::width, a.data());
  tile_kernel<Pair>(a.data(), b.data(), 70, -1.0, block_of(D), 29);
  EXPECT_EQ(C, D);

  const MatrixXd Z = spread_matrix(103, 4, 6);
  const Eigen::Vector4d theta(0.1, 1, 3, 7), x(0.1, -0.2, 0.3, 0.4);
  VectorXd u(103), v(103);
  const GaussianColumn column{Z.data(), 103, 4, theta.data(), x.data()};
  gaussian_quad(column, 103, u.data());
  gaussian_kernel<Pair>(column, 103, v.data());
  EXPECT_EQ(u, v);
#else
  GTEST_SKIP() << "one kind of vectors on this processor";
#endif
}
