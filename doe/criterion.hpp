// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Where to run next, as a score: a criterion gives each candidate point a number, higher is better, and a
/// sampler makes a criterion of the runs so far.
///
///   criterion:  Eigen::VectorXd c(const Eigen::MatrixXd& X)        X: n x d natural units; n scores
///   sampler:    criterion s(const doe::Evaluations& runs)
/// That is all that a surrogate has to offer to steer the sampling:
///   auto widest = [](const doe::Evaluations& runs) {
///     return [model = kriging::fit(runs.X(), runs.y("f"))](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
///       return model.predict(X).variance; }; };
/// Scores of one criterion are compared with each other only, so their scale is free; NaN is never chosen.
/// Samplers may keep what they learn between calls. This header has those that need no surrogate of ours.
/// Where points of a batch bear on each other, a joint sampler makes a joint criterion of the runs, which
/// makes a criterion of the points chosen so far; its rule is BatchRule::joint:
///   joint criterion:  criterion j(const Eigen::MatrixXd& chosen)   chosen: k x d natural units, k >= 0

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/nearest.hpp>
#include <drawpoint/doe/detail/sites.hpp>
#include <drawpoint/doe/detail/unit_box.hpp>
#include <drawpoint/doe/evaluations.hpp>

namespace drawpoint::doe {

using Criterion = std::function<Eigen::VectorXd(const Eigen::MatrixXd& X)>;
using Sampler = std::function<Criterion(const Evaluations& runs)>;
using JointCriterion = std::function<Criterion(const Eigen::MatrixXd& chosen)>;
using JointSampler = std::function<JointCriterion(const Evaluations& runs)>;

namespace detail {

// Eigen's matrices can be called too, with indices: they are scores, not a criterion.
template <class C>
concept EigenObject = requires {
  typename C::PlainObject;
};

}  // namespace detail

template <class C>
concept CriterionFunction = !detail::EigenObject<C> && requires(C & c, const Eigen::MatrixXd& X) {
  { c(X) } -> std::convertible_to<Eigen::VectorXd>;
};

template <class S>
concept SamplerFunction = requires(S& s, const Evaluations& runs) {
  { s(runs) } -> CriterionFunction;
};

template <class S>
concept JointSamplerFunction = requires(S& s, const Evaluations& runs, const Eigen::MatrixXd& chosen) {
  requires !detail::EigenObject<std::remove_cvref_t<decltype(s(runs))>>;
  { s(runs)(chosen) } -> CriterionFunction;
};

/// First line of every entry point that takes a sampler.
template <class S>
constexpr void require_sampler() {
  static_assert(
      requires(S & s, const Evaluations& runs) { s(runs); },
      "drawpoint: not a sampler. It cannot be called with the runs so far. Expected "
      "doe::Criterion s(const doe::Evaluations& runs), where a criterion is "
      "Eigen::VectorXd c(const Eigen::MatrixXd& X): one score a row of X, higher is better.");
  static_assert(
      SamplerFunction<S> || JointSamplerFunction<S> || !requires(S & s, const Evaluations& runs) { s(runs); },
      "drawpoint: not a sampler. What it makes of the runs so far is not a criterion. Expected "
      "Eigen::VectorXd c(const Eigen::MatrixXd& X): one score a row of X, higher is better.");
}

/// Space filling: the distance to the nearest run so far, failed ones included, in the unit box.
inline Criterion distance_to_runs(const Evaluations& runs) {
  const auto d = static_cast<Eigen::Index>(runs.problem.variables.size());
  Eigen::MatrixXd X(static_cast<Eigen::Index>(runs.rows.size()), d);
  for (std::size_t i = 0; i < runs.rows.size(); ++i) X.row(static_cast<Eigen::Index>(i)) = runs.rows[i].x;
  return [problem = runs.problem, U = detail::to_unit_box(std::move(X), runs.problem)](
             const Eigen::MatrixXd& points) -> Eigen::VectorXd {
    return detail::nearest_sites(detail::to_unit_box(points, problem), U).squared_distance.cwiseSqrt();
  };
}

/// The error as SUMO estimates it: the largest difference between models of the same runs, such as a Matérn
/// and a Gaussian Kriging, or the last few of a sequence. Each model is Eigen::VectorXd(const
/// Eigen::MatrixXd&). Throws std::invalid_argument for fewer than two.
inline Criterion disagreement(std::vector<Criterion> models) {
  if (models.size() < 2)
    throw std::invalid_argument("doe::disagreement: " + std::to_string(models.size()) +
                                " models; allowed is 2 or more; add a model of another kind");
  return [models = std::move(models)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    Eigen::VectorXd low = models[0](X), high = low;
    for (std::size_t k = 1; k < models.size(); ++k) {
      const Eigen::VectorXd y = models[k](X);
      low = low.cwiseMin(y);
      high = high.cwiseMax(y);
    }
    return high - low;
  };
}

/// How many of the turns `first`, ..., `first` + count - 1 each of these weights gets, finite numbers above 0:
/// of the first t turns its share of t to within one.
inline std::vector<int> turns_by_weight(const std::vector<double>& weights, int first, int count) {
  double total = 0;
  for (const double weight : weights) total += weight;
  std::vector<double> credit(weights.size(), 0.0);
  std::vector<int> turns(weights.size(), 0);
  for (int t = 0; t < first + count; ++t) {
    std::size_t next = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      credit[k] += weights[k] / total;
      if (credit[k] > credit[next]) next = k;
    }
    credit[next] -= 1.0;
    turns[next] += t >= first;
  }
  return turns;
}

/// A sampler and how much of the sampling it gets.
struct Share {
  double weight;  ///< > 0; only the ratios matter
  Sampler sampler;
};

namespace detail {

inline void check_shares(const char* place, const std::vector<Share>& parts) {
  if (parts.empty())
    throw std::invalid_argument(std::string(place) +
                                ": 0 parts; allowed is 1 or more; name at least one sampler");
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const std::string part = std::string(place) + ": part " + std::to_string(k);
    if (!(parts[k].weight > 0.0) || !std::isfinite(parts[k].weight))
      throw std::invalid_argument(part + " has weight " + number_text(parts[k].weight) +
                                  "; allowed is a finite number above 0; leave out what gets no share");
    if (!parts[k].sampler)
      throw std::invalid_argument(part + " has no sampler; give a doe::Sampler or leave the part out");
  }
}

/// Scores moved to [0, 1]; all 0 when they do not differ. NaN stays NaN.
inline Eigen::VectorXd to_unit_range(Eigen::VectorXd scores) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double s : scores)
    if (std::isfinite(s)) low = std::min(low, s), high = std::max(high, s);
  if (!(high > low)) return scores * 0.0;
  return (scores.array() - low) / (high - low);
}

}  // namespace detail

/// One score of several: Σ w_k s_k, each s_k moved to [0, 1] over the candidates. A point is then chosen
/// because it is good on the whole; for points each chosen by one sampler, as SUMO does it, use `Mix`.
inline Sampler weighted_sum(std::vector<Share> parts) {
  detail::check_shares("doe::weighted_sum", parts);
  return [parts = std::move(parts)](const Evaluations& runs) -> Criterion {
    std::vector<std::pair<double, Criterion>> criteria;
    for (const Share& part : parts) criteria.emplace_back(part.weight, part.sampler(runs));
    return [criteria = std::move(criteria)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(X.rows());
      for (const auto& part : criteria) sum += part.first * detail::to_unit_range(part.second(X));
      return sum;
    };
  };
}

/// Samplers that take turns, each for its share of the points: 0.7 LOLA-Voronoi and 0.3 error is
/// Mix{{{0.7, LolaVoronoi()}, {0.3, error}}}. The turns depend on the number of sites so far alone, and of
/// the first t points each sampler gets its share of t to within one. A Mix is a sampler itself, that of the
/// next turn, so that it may stand as a doe::Sampler and be a part of another; propose shares a batch out
/// among its parts.
class Mix {
 public:
  /// Throws std::invalid_argument without parts and for a weight that is not above 0.
  explicit Mix(std::vector<Share> parts) : parts_(std::move(parts)) {
    detail::check_shares("doe::Mix", parts_);
    for (const Share& part : parts_) weights_.push_back(part.weight);
  }

  /// How many of the points `first`, ..., `first + count` - 1 each part has to choose.
  std::vector<int> turns(int first, int count) const { return turns_by_weight(weights_, first, count); }

  const std::vector<Share>& parts() const { return parts_; }

  /// The criterion of the part whose turn the next point is.
  Criterion operator()(const Evaluations& runs) const {
    int sites = 0;
    detail::site_of_rows(runs, sites);
    const std::vector<int> next = turns(sites, 1);
    std::size_t k = 0;
    while (next[k] == 0) ++k;
    return parts_[k].sampler(runs);
  }

 private:
  std::vector<Share> parts_;
  std::vector<double> weights_;
};

}  // namespace drawpoint::doe
