// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Where the front might be: confidence bands from the draws of uncertain responses (draws.hpp).
///
/// α(z) = P(some point that meets all limits is at least as good as z in every objective), the attainment
/// function of the random front (Grunert da Fonseca, Fonseca, Hall 2001, "Inferential performance assessment
/// of stochastic optimisers and the attainment function"). Its level α = p read along objective j at the
/// place z_{-j} of the others is the p-quantile over the draws of
///   v_s = the best y_j among the points of draw s at least as good as z_{-j} in the others,
/// so a band of confidence 1 - 2p around the front is a pair of quantiles, objective by objective: pointwise,
/// not for the whole front at once. Quantiles are order statistics, number ⌈p N⌉ from the best. The draws
/// know only the given points: more candidates near the front make the band better, never worse. Cost O(N f m
/// k) for N draws with f points on their fronts and k places.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <drawpoint/pareto/non_domination.hpp>

namespace drawpoint::pareto {

/// k x m each, natural units and signs: entry (q, j) is the value of objective j attained with the
/// probability in question where the others are as at place q; infinitely bad where that is never reached.
struct FrontBand {
  Eigen::MatrixXd optimistic, median, pessimistic;
};

namespace detail {

inline void check_places(const std::string& place, const Eigen::MatrixXd& at, std::size_t m) {
  if (at.cols() != static_cast<Eigen::Index>(m) || at.hasNaN())
    throw std::invalid_argument(place + "at has " + std::to_string(at.cols()) +
                                " columns; give one number per objective (" + std::to_string(m) +
                                ") at each place");
}

/// Whether the point y is at least as good as z in every objective but `skipped` (-1: in all).
inline bool reaches(const double* y, const Eigen::RowVectorXd& z, Eigen::Index skipped) {
  for (Eigen::Index j = 0; j < z.size(); ++j)
    if (j != skipped && y[j] > z[j]) return false;
  return true;
}

/// v_s, minimised; infinity when no point of the draw reaches the place.
inline double best_beyond(const DrawnFront& front, const Eigen::RowVectorXd& z, Eigen::Index j) {
  double best = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < front.Y.rows(); ++i)
    if (const double* y = front.Y.data() + i * front.Y.cols(); y[j] < best && reaches(y, z, j)) best = y[j];
  return best;
}

/// Order statistic ⌈p n⌉ of rising values.
inline double quantile(const std::vector<double>& rising, double p) {
  const double place = std::ceil(p * static_cast<double>(rising.size()) - 1e-9);
  return rising[static_cast<std::size_t>(std::clamp(place, 1.0, static_cast<double>(rising.size()))) - 1];
}

/// One k x m matrix per probability, natural units.
inline std::vector<Eigen::MatrixXd> attainment_levels(const std::string& place, const doe::Problem& problem,
                                                      const Draws& draws, const Eigen::MatrixXd& at,
                                                      const std::vector<double>& probabilities) {
  const std::vector<DrawnFront> fronts = fronts_of_draws(place, problem, draws);
  const Eigen::RowVectorXd sign = signs_of(roles(problem));
  check_places(place, at, static_cast<std::size_t>(sign.size()));
  for (const double p : probabilities)
    check_range(place, "a probability", p, p > 0.0 && p < 1.0, "above 0 and below 1");
  std::vector<Eigen::MatrixXd> levels(probabilities.size(), Eigen::MatrixXd(at.rows(), at.cols()));
  std::vector<double> values(fronts.size());
  for (Eigen::Index q = 0; q < at.rows(); ++q) {
    const Eigen::RowVectorXd z = at.row(q).cwiseProduct(sign);
    for (Eigen::Index j = 0; j < at.cols(); ++j) {
      std::transform(fronts.begin(), fronts.end(), values.begin(),
                     [&](const DrawnFront& front) { return best_beyond(front, z, j); });
      std::sort(values.begin(), values.end());
      for (std::size_t k = 0; k < levels.size(); ++k)
        levels[k](q, j) = sign[j] * quantile(values, probabilities[k]);
    }
  }
  return levels;
}

}  // namespace detail

/// α at the rows of at: k x m, natural units. This and the next two throw std::invalid_argument for draws or
/// places that do not fit the problem.
inline Eigen::VectorXd attainment_probability(const doe::Problem& problem, const Draws& draws,
                                              const Eigen::MatrixXd& at) {
  const std::string place = "pareto::attainment_probability: ";
  const std::vector<detail::DrawnFront> fronts = detail::fronts_of_draws(place, problem, draws);
  const Eigen::RowVectorXd sign = detail::signs_of(detail::roles(problem));
  detail::check_places(place, at, static_cast<std::size_t>(sign.size()));
  Eigen::VectorXd alpha(at.rows());
  for (Eigen::Index q = 0; q < at.rows(); ++q) {
    const Eigen::RowVectorXd z = at.row(q).cwiseProduct(sign);
    const auto attains = [&](const detail::DrawnFront& front) {
      for (Eigen::Index i = 0; i < front.Y.rows(); ++i)
        if (detail::reaches(front.Y.data() + i * front.Y.cols(), z, -1)) return true;
      return false;
    };
    alpha[q] = static_cast<double>(std::count_if(fronts.begin(), fronts.end(), attains)) /
               static_cast<double>(fronts.size());
  }
  return alpha;
}

/// The front that is attained with the probability p, along each objective at each place: k x m.
inline Eigen::MatrixXd attained_front(const doe::Problem& problem, const Draws& draws,
                                      const Eigen::MatrixXd& at, double p) {
  return detail::attainment_levels("pareto::attained_front: ", problem, draws, at, {p}).front();
}

/// at: k x m places, usually the front's Y; confidence: share of draws inside the band along each objective.
inline FrontBand front_band(const doe::Problem& problem, const Draws& draws, const Eigen::MatrixXd& at,
                            double confidence = 0.9) {
  const std::string place = "pareto::front_band: ";
  detail::check_range(place, "confidence", confidence, confidence > 0.0 && confidence < 1.0,
                      "above 0 and below 1");
  const double tail = 0.5 * (1.0 - confidence);
  auto levels = detail::attainment_levels(place, problem, draws, at, {tail, 0.5, 1.0 - tail});
  return {std::move(levels[0]), std::move(levels[1]), std::move(levels[2])};
}

}  // namespace drawpoint::pareto
