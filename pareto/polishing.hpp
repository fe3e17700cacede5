// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How sure the points of a front are, and what finishing it with gradients has brought.
///
/// The residual of a point is that of the first-order conditions of a Pareto optimum
/// (pareto/stationarity.hpp), 0 to 1, without unit. It is about the function that was
/// searched: of surrogates, not of the simulation behind them; and local.

#include <Eigen/Core>
#include <limits>

namespace drawpoint::pareto {

/// A point is certified when its residual is at most this: the gradients of the objectives, weighted, cancel
/// to a millionth of the largest. Polishing ends near 1e-9, what a search leaves is near 0.1.
inline constexpr double certified_residual = 1e-6;

struct Polishing {
  /// One per point of the front, NaN where unknown. Empty when the front was not polished, and for one
  /// objective, whose only gradient vanishes at the optimum and leaves nothing to measure it by.
  Eigen::VectorXd residual = {};
  /// What polishing added to the hypervolume [%], 0 or more to 1e-5; NaN when not polished, for one
  /// objective, and when the front spans none.
  double gain = std::numeric_limits<double>::quiet_NaN();

  int certified() const { return static_cast<int>((residual.array() <= certified_residual).count()); }
};

}  // namespace drawpoint::pareto
