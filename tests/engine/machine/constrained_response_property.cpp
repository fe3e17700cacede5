// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/machine/constrained_response.h>
#include <random>

using drawpoint::engine::machine::constrained_response;

namespace {

Eigen::MatrixXd random_matrix(std::mt19937& rng, Eigen::Index rows, Eigen::Index cols) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(rng); });
}

// M = B Bᵀ + 1 has condition numbers of about 1e2 here; results may differ by that times n·eps: 1e2·20·2e-16
// ≈ 5e-13.
constexpr double tolerance = 1e-11;

}  // namespace

TEST(ConstrainedResponse, NormalisesTheMassMatrixAndKeepsTheConstraints) {
  std::mt19937 rng(7);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Index n = 3 + trial % 18, m = trial % 3;
    const Eigen::MatrixXd B = random_matrix(rng, n, n),
                          M = B * B.transpose() + Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd G = random_matrix(rng, m, n), N = constrained_response(M, G);
    ASSERT_EQ(N.cols(), n - m);
    EXPECT_LT((N.transpose() * M * N - Eigen::MatrixXd::Identity(n - m, n - m)).cwiseAbs().maxCoeff(),
              tolerance);
    const Eigen::MatrixXd W = M.inverse();
    Eigen::MatrixXd A = W;
    if (m > 0) {
      A -= W * G.transpose() * (G * W * G.transpose()).inverse() * G * W;
      EXPECT_LT((G * N).cwiseAbs().maxCoeff(), tolerance);
    }
    EXPECT_LT((N * N.transpose() - A).cwiseAbs().maxCoeff(), 10 * tolerance);
  }
}

TEST(ConstrainedResponse, RedundantRowsChangeNothing) {
  std::mt19937 rng(11);
  const Eigen::MatrixXd B = random_matrix(rng, 9, 9), M = B * B.transpose() + Eigen::MatrixXd::Identity(9, 9);
  const Eigen::MatrixXd G = random_matrix(rng, 3, 9);
  Eigen::MatrixXd G_twice(6, 9);
  G_twice << G, 2 * G;
  const Eigen::MatrixXd N = constrained_response(M, G), N_twice = constrained_response(M, G_twice);
  ASSERT_EQ(N_twice.cols(), N.cols());
  EXPECT_LT((N * N.transpose() - N_twice * N_twice.transpose()).cwiseAbs().maxCoeff(), 10 * tolerance);
}
