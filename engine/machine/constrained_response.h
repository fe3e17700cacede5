// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

/// The factor N of a constrained machine's response A = N Nᵀ to impulses.
///
/// With Z an orthonormal basis of the null space of G (rank-revealing QR of Gᵀ, so redundant rows do no harm)
/// and ZᵀMZ = LLᵀ, N = Z L⁻ᵀ satisfies G N = 0 and NᵀMN = 1, and N Nᵀ = M⁻¹ − M⁻¹Gᵀ(G M⁻¹Gᵀ)⁺G M⁻¹. Cost
/// O(n³).
namespace drawpoint::engine::machine {

/// M: n x n symmetric positive definite; G: m x n (m may be 0). Returns N: n x r, r = n - rank(G).
Eigen::MatrixXd constrained_response(const Eigen::MatrixXd& M, const Eigen::MatrixXd& G);

/// Speeds of all n joints when G u = 0 holds, the speeds `still` are zero and one of the speeds `driving` is
/// one, the others zero: n x driving, least squares. The drivers must be as many as the freedoms that are
/// left.
Eigen::MatrixXd driven_speeds(const Eigen::MatrixXd& G, const std::vector<Eigen::Index>& still,
                              const std::vector<Eigen::Index>& driving);

}  // namespace drawpoint::engine::machine
