// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Expected hypervolume improvement, exactly, for any number of objectives m >= 1.
///
/// With the objectives turned to minimise, a front and a reference point r, a run at y improves the
/// hypervolume by the part of {z : y <= z <= r} that no point of the front dominates. That region
/// (non_dominated_boxes) is cut into disjoint boxes [l, u], l down to −∞, and for independent normal Yⱼ
///   E[improvement] = Σ_boxes Πⱼ [ψⱼ(uⱼ) − ψⱼ(lⱼ)],   ψⱼ(a) = E[(a − Yⱼ)⁺] = σⱼ h((a − μⱼ)/σⱼ), ψⱼ(−∞) = 0.
/// For m = 1 this is the expected improvement over the better of front and reference point. The boxes come
/// from a sweep along the last objective: each point closes the boxes that it cuts and opens what is left of
/// them. n points give n + 1 boxes for m = 2, some n to n² for m = 3. Cost a candidate: m n values of h and
/// m products a box. Differences of ψ lose digits: the error is about 1e-16 of the largest ψ product, so
/// that improvements below 1e-15 of the front's box are noise. Source: Yang, Emmerich, Deutz, Bäck 2019, J.
/// Global Optimization 75, "Efficient computation of expected hypervolume improvement".

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/kriging/acquisition_constraints.hpp>
#include <drawpoint/kriging/detail/front_view.hpp>

namespace drawpoint::kriging {

/// Points to improve on and how far their volume reaches, in natural units, a column an objective in the
/// order of the problem. Dominated points, and points beyond the reference, change nothing.
struct FrontView {
  Eigen::MatrixXd Y;          ///< k x m; k = 0 is allowed
  Eigen::VectorXd reference;  ///< m, worse than what is wanted in every objective
};

namespace detail {

/// The view of these rows of Y (n x m, all objectives minimised) has a reference point beyond them. sign: of the
/// objectives.
inline FrontView front_view(const Eigen::MatrixXd& Y, const Eigen::VectorXd& sign,
                            const std::vector<Eigen::Index>& front) {
  FrontView view{rows_of(Y, front), entry_products(sign, reference_beyond(Y, front))};
  for (Eigen::Index k = 0; k < sign.size(); ++k) view.Y.col(k) *= sign[k];
  return view;
}

/// Disjoint boxes [lower, upper], columns: what `front` (k x m) leaves undominated of {z <= reference}, every
/// objective minimised. lower may be −∞.
struct Boxes {
  Eigen::MatrixXd lower, upper;  ///< m x boxes
};

/// One box of the first m − 1 objectives that is open from `start` on in the last.
struct OpenBox {
  Eigen::VectorXd lower, upper;
  double start;
};

/// The parts of `box` that {z >= p} leaves: in part j the objectives before j are above p, j is below.
inline void append_rest(const OpenBox& box, const Eigen::VectorXd& p, double start,
                        std::vector<OpenBox>& out) {
  OpenBox rest{box.lower, box.upper, start};
  for (Eigen::Index j = 0; j < rest.lower.size(); ++j) {
    if (rest.lower[j] < p[j]) {
      out.push_back(rest);
      out.back().upper[j] = p[j];
      rest.lower[j] = p[j];
    }
  }
}

inline Boxes packed(const std::vector<std::pair<OpenBox, double>>& closed, Eigen::Index m) {
  Boxes boxes{Eigen::MatrixXd(m, closed.size()), Eigen::MatrixXd(m, closed.size())};
  for (std::size_t b = 0; b < closed.size(); ++b) {
    const auto column = static_cast<Eigen::Index>(b);
    const auto& [box, end] = closed[b];
    std::copy(box.lower.begin(), box.lower.end(), &boxes.lower(0, column));
    std::copy(box.upper.begin(), box.upper.end(), &boxes.upper(0, column));
    boxes.lower(m - 1, column) = box.start;
    boxes.upper(m - 1, column) = end;
  }
  return boxes;
}

/// Every entry of a below that of b.
inline bool below(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::equal(a.begin(), a.end(), b.begin(), std::less<>());
}

inline Boxes non_dominated_boxes(const Eigen::MatrixXd& front, const Eigen::VectorXd& reference) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Eigen::Index m = reference.size(), first = m - 1;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(front.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return front(a, first) < front(b, first); });
  std::vector<OpenBox> open{{Eigen::VectorXd::Constant(first, -infinity), reference.head(first), -infinity}};
  std::vector<std::pair<OpenBox, double>> closed;
  for (const Eigen::Index i : order) {
    const Eigen::VectorXd point = front.row(i), p = point.head(first);
    if (!below(point, reference)) continue;
    const double height = front(i, first);
    std::vector<OpenBox> next;
    for (const OpenBox& box : open) {
      if (!below(p, box.upper)) {
        next.push_back(box);
        continue;
      }
      if (height > box.start) closed.emplace_back(box, height);
      append_rest(box, p, height, next);
    }
    open = std::move(next);
  }
  for (const OpenBox& box : open) closed.emplace_back(box, reference[first]);
  return packed(closed, m);
}

/// Boxes by the places of their bounds among the distinct values of each objective, of which the first is −∞.
class ExpectedVolume {
 public:
  explicit ExpectedVolume(const Boxes& boxes)
      : levels_(static_cast<std::size_t>(boxes.lower.rows())),
        low_(boxes.lower.rows(), boxes.lower.cols()),
        high_(low_) {
    for (Eigen::Index j = 0; j < low_.rows(); ++j) {
      std::vector<double>& level = levels_[static_cast<std::size_t>(j)];
      level.assign(1, -std::numeric_limits<double>::infinity());
      for (const Eigen::MatrixXd* side : {&boxes.lower, &boxes.upper})
        for (Eigen::Index b = 0; b < side->cols(); ++b) level.push_back((*side)(j, b));
      std::sort(level.begin(), level.end());
      level.erase(std::unique(level.begin(), level.end()), level.end());
      for (Eigen::Index b = 0; b < low_.cols(); ++b) {
        low_(j, b) = place(level, boxes.lower(j, b));
        high_(j, b) = place(level, boxes.upper(j, b));
      }
    }
  }

  /// For normal objectives of these means and deviations, m entries each.
  double operator()(const Eigen::VectorXd& mean, const Eigen::VectorXd& deviation) const {
    std::vector<std::vector<double>> psi(levels_.size());
    for (std::size_t j = 0; j < psi.size(); ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      psi[j].assign(1, 0.0);
      for (std::size_t a = 1; a < levels_[j].size(); ++a)
        psi[j].push_back(expected_shortfall(levels_[j][a], mean[k], deviation[k]));
    }
    double sum = 0;
    for (Eigen::Index b = 0; b < low_.cols(); ++b) {
      double volume = 1;
      for (std::size_t j = 0; j < psi.size(); ++j) {
        const auto k = static_cast<Eigen::Index>(j);
        volume *= psi[j][high_(k, b)] - psi[j][low_(k, b)];
      }
      sum += volume;
    }
    return sum;
  }

 private:
  static int place(const std::vector<double>& level, double value) {
    return static_cast<int>(std::lower_bound(level.begin(), level.end(), value) - level.begin());
  }

  std::vector<std::vector<double>> levels_;
  Eigen::MatrixXi low_, high_;  // m x boxes
};

struct Objectives {
  std::vector<std::size_t> index;  ///< among the responses
  Eigen::VectorXd sign;            ///< +1 to minimise, −1 to maximise
};

inline Objectives objectives_of(const doe::Problem& problem) {
  Objectives o;
  for (std::size_t j = 0; j < problem.responses.size(); ++j)
    if (doe::is_objective(problem.responses[j].goal)) o.index.push_back(j);
  o.sign.resize(static_cast<Eigen::Index>(o.index.size()));
  for (std::size_t k = 0; k < o.index.size(); ++k)
    o.sign[static_cast<Eigen::Index>(k)] = doe::sign_of(problem.responses[o.index[k]].goal);
  return o;
}

inline void check_front(const FrontView& front, Eigen::Index m) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("kriging::expected_hypervolume_improvement: " + what);
  };
  if (m < 1)
    reject(
        "the problem has 0 objectives; allowed is 1 or more; give a response the goal minimize or maximize");
  if (front.reference.size() != m)
    reject("the reference point has " + std::to_string(front.reference.size()) +
           " entries; the problem has " + std::to_string(m) + " objectives; give one entry an objective");
  if (front.Y.rows() > 0 && front.Y.cols() != m)
    reject("the front has " + std::to_string(front.Y.cols()) + " columns; the problem has " +
           std::to_string(m) + " objectives; give one column an objective");
  if (!all_finite(front.Y) || !all_finite(front.reference))
    reject(
        "the front or the reference point holds a number that is not finite; allowed are finite numbers; "
        "leave failed runs out");
}

}  // namespace detail

/// models: one per response of the problem; those of objectives are used, re-interpolated when they are
/// Kriging models. Multiply by probability_of_feasibility(problem, models) for limits. Throws
/// std::invalid_argument when sizes do not fit or a number is not finite.
template <class S>
doe::Criterion expected_hypervolume_improvement(const doe::Problem& problem, const std::vector<S>& models,
                                                const FrontView& front) {
  detail::check_models("kriging::expected_hypervolume_improvement", problem, models);
  const detail::Objectives objectives = detail::objectives_of(problem);
  const Eigen::Index m = objectives.sign.size();
  detail::check_front(front, m);
  std::vector<detail::SearchModel<S>> searched;
  for (const std::size_t j : objectives.index) searched.emplace_back(models[j]);
  Eigen::MatrixXd Y(front.Y.rows(), m);
  for (Eigen::Index k = 0; k < m; ++k)
    for (Eigen::Index i = 0; i < Y.rows(); ++i) Y(i, k) = objectives.sign[k] * front.Y(i, k);
  const Eigen::VectorXd reference = detail::entry_products(objectives.sign, front.reference);
  return [searched = std::move(searched), sign = objectives.sign,
          volume = detail::ExpectedVolume(detail::non_dominated_boxes(Y, reference))](
             const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    Eigen::MatrixXd mean(sign.size(), X.rows()), deviation(sign.size(), X.rows());
    for (Eigen::Index j = 0; j < sign.size(); ++j) {
      const Prediction p = searched[static_cast<std::size_t>(j)].predict(X);
      for (Eigen::Index i = 0; i < X.rows(); ++i) {
        mean(j, i) = sign[j] * p.mean[i];
        deviation(j, i) = std::sqrt(p.variance[i]);
      }
    }
    Eigen::VectorXd score(X.rows());
    for (Eigen::Index i = 0; i < score.size(); ++i) score[i] = volume(mean.col(i), deviation.col(i));
    return score;
  };
}

/// Improvement on the fitted values of the runs themselves that keep all limits, times the probability of
/// feasibility. The reference point lies as far beyond their front as that is long, or at the worst run. While no run
/// is feasible the score is that probability alone. Throws as above, and when the models were fitted to different
/// numbers of runs.
template <Regression S>
doe::Criterion constrained_hypervolume_improvement(const doe::Problem& problem,
                                                   const std::vector<S>& models) {
  constexpr const char* place = "kriging::constrained_hypervolume_improvement";
  detail::check_models(place, problem, models);
  const doe::Criterion feasible = probability_of_feasibility(problem, models);
  const std::vector<Eigen::Index> runs = detail::feasible_runs(place, problem, models);
  if (runs.empty()) return feasible;
  const detail::Objectives objectives = detail::objectives_of(problem);
  const Eigen::Index m = objectives.sign.size();
  Eigen::MatrixXd Y(models.front().runs(), m);
  for (Eigen::Index k = 0; k < m; ++k)
    Y.col(k) = detail::affine(fitted_values(models[objectives.index[static_cast<std::size_t>(k)]]),
                              objectives.sign[k]);
  const FrontView front = detail::front_view(Y, objectives.sign, detail::front_rows(Y, runs));
  return product_of_criteria({expected_hypervolume_improvement(problem, models, front), feasible});
}

}  // namespace drawpoint::kriging
