// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Products of Legendre polynomials on a box, orthonormal for points spread evenly over it.
///
/// A term has a degree d_v in each variable, and is ∏ √(2 d_v + 1) P_{d_v}(u_v), u_v the variable on [−1, 1]. Taken
/// are the terms with ∏ (1 + d_v) ≤ 6 (a hyperbolic cross): degree 5 alone, 1 and 2 in a pair; 39 terms of four
/// variables. The variance over the box of Σ c_t φ_t is Σ c_t², the constant's left out, so that
/// a term's share of it belongs to its variables. Source: Blatman, Sudret 2011, Journal of Computational Physics
/// 230, "Adaptive sparse polynomial chaos expansion based on least angle regression".

#include <drawpoint/doe/problem.hpp>

#include <Eigen/Core>

namespace drawpoint::studies {

constexpr int largest_term = 6;  ///< ∏ (1 + d_v)

/// Terms x d, the constant first.
Eigen::MatrixXi term_degrees(Eigen::Index variables);

/// X: n x d, natural units. Gives n x terms.
Eigen::MatrixXd term_values(const doe::Problem& problem, const Eigen::MatrixXi& degrees,
                            const Eigen::MatrixXd& X);

}  // namespace drawpoint::studies
