// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How uncertain a front is, as one number: the Vorob'ev deviation of the region that it dominates.
///
/// A is the random region dominated by the front of a draw within a reference point, α its coverage function
/// (attainment.hpp). The Vorob'ev expectation is the set Q = {α >= β*} whose volume is that of A in the mean:
/// vol{α >= β} <= E vol A <= vol Q for all β > β*. The deviation E vol(A Δ Q) is the volume in which draw and
/// expectation differ: 0 for a certain front, and it falls as simulations sharpen it (Binois, Ginsbourger,
/// Roustant 2015, "Quantifying uncertainty on Pareto fronts with Gaussian process conditional simulations",
/// EJOR 243; Molchanov 2005). Volumes are means over scrambled Sobol points of the box between the best drawn
/// values and the reference point: error about 1/√samples of the box at worst. attained_front(..., β*) is the
/// front of Q. Cost O(samples · draws · points on a drawn front · m).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/pareto/attainment.hpp>

namespace drawpoint::pareto {

struct VorobevOptions {
  int samples = 2048;  ///< places in the box, 1 or more, best a power of 2
  /// m, natural units; none: worst of the front of the mean draw + a tenth.
  std::optional<Eigen::VectorXd> reference{};
  doe::Seed seed = 1;
};

enum class VorobevStatus {
  completed,
  no_volume  ///< no draw has a point better than the reference in all objectives: volumes are 0
};

inline std::string_view to_string(VorobevStatus status) {
  switch (status) {
    case VorobevStatus::completed:
      return "completed";
    case VorobevStatus::no_volume:
      return "no_volume";
  }
  return "unknown";
}

struct Vorobev {
  double threshold = 0.0;        ///< β*
  double expected_volume = 0.0;  ///< E vol A, product of the objectives' units
  double deviation = 0.0;        ///< E vol(A Δ Q), the same unit
  Eigen::VectorXd reference;     ///< that was taken, natural units
  VorobevStatus status = VorobevStatus::completed;
  std::string message;  ///< empty when completed
};

namespace detail {

/// Minimised. Without a point that meets the limits in the mean: the worst of all.
inline Eigen::RowVectorXd usual_reference(const doe::Problem& problem, const Draws& draws) {
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(draws.front().rows(), draws.front().cols());
  for (const Eigen::MatrixXd& draw : draws) mean += draw / static_cast<double>(draws.size());
  const Roles role = roles(problem);
  Eigen::MatrixXd Y = front_of_draw(problem, role, mean).Y;
  if (Y.rows() == 0) Y = mean(Eigen::all, role.objectives) * signs_of(role).asDiagonal();
  const Eigen::RowVectorXd worst = Y.colwise().maxCoeff();
  return worst + 0.1 * (worst - Y.colwise().minCoeff());
}

/// k places between low and high, one per row.
inline Eigen::MatrixXd places_in_box(const Eigen::RowVectorXd& low, const Eigen::RowVectorXd& high, int k,
                                     doe::Seed seed) {
  doe::Problem unit{{}, {{"none", "1"}}};
  for (Eigen::Index j = 0; j < low.size(); ++j) unit.variables.push_back({std::to_string(j), "1", 0.0, 1.0});
  const Eigen::MatrixXd U = doe::scrambled_sobol(unit, k, {.seed = seed});
  return (U * (high - low).asDiagonal()).rowwise() + low;
}

/// From α at places of equal weight; volumes as shares of the box.
inline Vorobev vorobev_of(const Eigen::VectorXd& alpha) {
  Vorobev result;
  result.expected_volume = alpha.mean();
  std::vector<double> falling(alpha.begin(), alpha.end());
  std::sort(falling.begin(), falling.end(), std::greater<>());
  const double needed = std::ceil(alpha.sum() - 1e-9);  // places that Q has at least
  result.threshold = falling[static_cast<std::size_t>(std::max(needed, 1.0)) - 1];
  for (const double a : alpha) result.deviation += a >= result.threshold ? 1.0 - a : a;
  result.deviation /= static_cast<double>(alpha.size());
  return result;
}

}  // namespace detail

/// Throws std::invalid_argument for draws that do not fit the problem and for faulty options.
inline Vorobev vorobev(const doe::Problem& problem, const Draws& draws, const VorobevOptions& options = {}) {
  const std::string place = "pareto::vorobev: ";
  const auto fronts = detail::fronts_of_draws(place, problem, draws);
  const Eigen::RowVectorXd sign = detail::signs_of(detail::roles(problem));
  detail::check_range(place, "samples", options.samples, options.samples >= 1, "1 or more");
  if (options.reference && options.reference->size() != sign.size())
    throw std::invalid_argument(place + "reference has " + std::to_string(options.reference->size()) +
                                " entries; give one per objective or leave it out");
  Eigen::RowVectorXd high = detail::usual_reference(problem, draws);
  if (options.reference) high = options.reference->transpose().cwiseProduct(sign);
  Eigen::RowVectorXd low = high;
  for (const detail::DrawnFront& front : fronts)
    if (front.Y.rows() > 0) low = low.cwiseMin(front.Y.colwise().minCoeff());
  Vorobev result;
  const double box = (high - low).prod();
  if (box > 0.0) {
    const Eigen::MatrixXd at = detail::places_in_box(low, high, options.samples, options.seed);
    result = detail::vorobev_of(attainment_probability(problem, draws, at * sign.asDiagonal()));
    result.expected_volume *= box;
    result.deviation *= box;
  } else {
    result.status = VorobevStatus::no_volume;
    result.message = "no draw dominates the reference point; give one that is worse in every objective";
  }
  result.reference = high.cwiseProduct(sign).transpose();
  return result;
}

}  // namespace drawpoint::pareto
