// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The next simulations: where the front is uncertain, and a run would settle it.
///
/// Score of candidate i: p_i √(Σ_j (σ_ij/range_j)²), p_i its probability of being on the front
/// (non_domination.hpp), σ_ij the deviation of the draws of response j (objectives and limits), range_j that
/// of its mean over the candidates. Points that are surely dominated or known already score 0. It is ε-PAL's
/// choice, the largest uncertainty among points that may be optimal (Zuluaga, Krause, Püschel 2016, JMLR 17),
/// with the probability in the place of a verdict. A batch is chosen one by one, each time with the
/// deviations that would remain if the chosen ones had been run without noise: draws are projected off the
/// chosen columns, which is conditioning by their sample covariance. So runs whose results would repeat each
/// other are not chosen together, provided the draws are joint paths. p stays that of the start. It looks one
/// batch ahead and does not weigh how much volume a run would win. Cost O(N n r) per choice beside the
/// fronts.

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <drawpoint/pareto/choice.hpp>
#include <drawpoint/pareto/non_domination.hpp>

namespace drawpoint::pareto {

enum class NextStatus {
  completed,
  fewer  ///< than asked for: the rest would tell nothing more of the front
};

inline std::string_view to_string(NextStatus status) {
  switch (status) {
    case NextStatus::completed:
      return "completed";
    case NextStatus::fewer:
      return "fewer";
  }
  return "unknown";
}

struct NextSimulations {
  std::vector<int> rows;        ///< of the candidates, in the order of choice; none with score 0
  Eigen::VectorXd score;        ///< of the chosen when they were chosen
  Eigen::VectorXd probability;  ///< n: of being on the front
  Eigen::VectorXd uncertainty;  ///< n: √(Σ_j (σ_ij/range_j)²) before any is run
  NextStatus status = NextStatus::completed;
  std::string message;  ///< empty when completed
};

namespace detail {

/// Draws of one response about their mean, draws x n, in ranges of the mean.
inline Eigen::MatrixXd centred_draws(const Draws& draws, int response) {
  Eigen::MatrixXd D(static_cast<Eigen::Index>(draws.size()), draws.front().rows());
  for (std::size_t s = 0; s < draws.size(); ++s)
    D.row(static_cast<Eigen::Index>(s)) = draws[s].col(response).transpose();
  const Eigen::RowVectorXd mean = D.colwise().mean();
  D.rowwise() -= mean;
  const double range = mean.maxCoeff() - mean.minCoeff();
  return range > 0.0 ? Eigen::MatrixXd(D / range) : D;
}

inline Eigen::VectorXd remaining_uncertainty(const std::vector<Eigen::MatrixXd>& responses) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(responses.front().cols());
  for (const Eigen::MatrixXd& D : responses)
    squares += D.colwise().squaredNorm().transpose() / static_cast<double>(D.rows() - 1);
  return squares.cwiseSqrt();
}

/// What is known once candidate i is: its draws explain their share of all others.
inline void learn(std::vector<Eigen::MatrixXd>& responses, int i) {
  for (Eigen::MatrixXd& D : responses) {
    const double length = D.col(i).norm();
    if (!(length > 0.0)) continue;
    const Eigen::VectorXd direction = D.col(i) / length;
    const Eigen::RowVectorXd shares = direction.transpose() * D;
    D -= direction * shares;
    D.col(i).setZero();
  }
}

}  // namespace detail

/// Up to `count` rows, fewer when the rest score below 1e-9 of the first. Throws std::invalid_argument for
/// count < 1 and for draws that do not fit the problem.
inline NextSimulations next_simulations(const doe::Problem& problem, const Draws& draws, int count = 1) {
  constexpr double rounding = 1e-9;  // of the first score: what projections leave of a draw that is known
  detail::check_range("pareto::next_simulations: ", "count", count, count >= 1, "1 or more");
  NextSimulations next;
  next.probability = probability_non_dominated(problem, draws).probability;
  std::vector<Eigen::MatrixXd> responses;
  for (std::size_t j = 0; j < problem.responses.size(); ++j)
    if (problem.responses[j].goal != doe::Goal::record)
      responses.push_back(detail::centred_draws(draws, static_cast<int>(j)));
  next.uncertainty = detail::remaining_uncertainty(responses);
  std::vector<double> scores;
  while (static_cast<int>(next.rows.size()) < count) {
    const Eigen::VectorXd score = next.probability.cwiseProduct(detail::remaining_uncertainty(responses));
    int row = 0;
    const double best = score.maxCoeff(&row);
    if (!(best > (scores.empty() ? 0.0 : rounding * scores.front()))) break;
    next.rows.push_back(row);
    scores.push_back(best);
    detail::learn(responses, row);
  }
  if (static_cast<int>(next.rows.size()) < count) {
    next.status = NextStatus::fewer;
    next.message = std::to_string(next.rows.size()) + " of " + std::to_string(count) +
                   " simulations: all other candidates are known or not on the front";
  }
  next.score = Eigen::Map<const Eigen::VectorXd>(scores.data(), static_cast<Eigen::Index>(scores.size()));
  return next;
}

}  // namespace drawpoint::pareto
