// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Where squared errors of runs are larger than elsewhere: along an input, and between neighbours.
///
/// Along input k that is a number, of every m runs in a row by x_k, for three lengths m; runs with one x_k
/// stay together, so that a window may be longer: the likelihood ratio of normal errors
/// with one variance inside of the window, w, and another outside, v, against one variance u for all,
///   −½ [m ln(w/u) + (n − m) ln(v/u)],   counted only where w > v;
/// the largest counts (Kulldorff 1997, Commun. Stat. Theory Methods 26(6), with normal errors). A square
/// counts as four times their mean at most: one run that does not belong makes no window. Between
/// neighbours: Moran's I (1950, Biometrika 37) of g = ln(e²/u + 0.3) over the 2d nearest runs of each: errors
/// along a jump that follows no input are neighbours too. 0.3: about the median of a squared normal error
/// over its mean is 0.45; a run that is met by chance must not outweigh all others. Cost O(n d).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/levels.hpp>
#include <numeric>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// Places `from` to `to`, both included, of the runs in the order of input `input`.
struct ErrorWindow {
  int input = -1;
  Index from = 0, to = 0;
  double ratio = 0;  ///< the likelihood ratio; 0: no window stands out
};

class ErrorScan {
 public:
  /// X: n x d, n of 8 or more; `levels` of the correlation.
  explicit ErrorScan(const Eigen::MatrixXd& X, const std::vector<int>& levels = {})
      : neighbours_(nearest_runs(X, levels)) {
    for (Index k = 0; k < X.cols(); ++k) {
      if (is_category(levels, k)) {
        orders_.emplace_back();
        begins_.emplace_back();
        continue;
      }
      auto& order = orders_.emplace_back(static_cast<std::size_t>(X.rows()));
      std::iota(order.begin(), order.end(), Index{0});
      std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return X(a, k) < X(b, k); });
      auto& begins = begins_.emplace_back();
      for (std::size_t i = 0; i < order.size(); ++i)
        if (i == 0 || X(order[i], k) > X(order[i - 1], k)) begins.push_back(static_cast<Index>(i));
      begins.push_back(X.rows());
    }
    for (const double share : {0.1, 0.2, 0.35})
      lengths_.push_back(
          std::max<Index>(4, static_cast<Index>(std::lround(share * static_cast<double>(X.rows())))));
  }

  /// The runs by input; empty where it is a category.
  const std::vector<Index>& order(int input) const { return orders_[static_cast<std::size_t>(input)]; }

  ErrorWindow widest_errors(Eigen::VectorXd squares) const {
    const double most = 4.0 * mean_of(squares);
    for (double& entry : squares) entry = std::min(entry, most);
    ErrorWindow found;
    for (std::size_t k = 0; k < orders_.size(); ++k)
      for (const Index m : lengths_) scan(squares, static_cast<int>(k), m, found);
    return found;
  }

  double neighbours_alike(const Eigen::VectorXd& squares) const {
    const double mean = mean_of(squares);
    Eigen::VectorXd g = squares;
    for (double& entry : g) entry = std::log(entry / mean + 0.3);
    g = affine(g, 1.0, -mean_of(g));
    double alike = 0;
    for (std::size_t i = 0; i < neighbours_.size(); ++i)
      for (const Index j : neighbours_[i])
        alike += g[static_cast<Index>(i)] * g[j] / static_cast<double>(neighbours_[i].size());
    return alike / square(g);
  }

 private:
  static std::vector<std::vector<Index>> nearest_runs(const Eigen::MatrixXd& X,
                                                      const std::vector<int>& levels) {
    const Index n = X.rows(), count = std::min(n - 1, 2 * X.cols());
    std::vector<std::vector<Index>> nearest;
    std::vector<std::pair<double, Index>> others;
    for (Index i = 0; i < n; ++i) {
      others.clear();
      for (Index j = 0; j < n; ++j) {
        double distance = 0;
        for (Index k = 0; k < X.cols(); ++k) {
          const double step = distance_between(levels, k, X(i, k), X(j, k));
          distance += step * step;
        }
        if (j != i) others.emplace_back(distance, j);
      }
      std::partial_sort(others.begin(), others.begin() + count, others.end());
      auto& of = nearest.emplace_back();
      for (Index m = 0; m < count; ++m) of.push_back(others[static_cast<std::size_t>(m)].second);
    }
    return nearest;
  }

  void scan(const Eigen::VectorXd& squares, int input, Index m, ErrorWindow& found) const {
    const auto& order = orders_[static_cast<std::size_t>(input)];
    const auto& begins = begins_[static_cast<std::size_t>(input)];
    const Index n = squares.size();
    std::vector<double> sums{0};
    for (const Index run : order) sums.push_back(sums.back() + squares[run]);
    const double all = sums.back(), u = all / static_cast<double>(n);
    std::size_t last = 0;
    for (std::size_t first = 0; first + 1 < begins.size(); ++first) {
      const Index from = begins[first];
      while (last < begins.size() && begins[last] < from + m) ++last;
      if (last == begins.size()) return;
      const Index to = begins[last];
      if (n - (to - from) < 4) continue;
      const double inside = static_cast<double>(to - from), outside = static_cast<double>(n - (to - from));
      const double sum = sums[static_cast<std::size_t>(to)] - sums[static_cast<std::size_t>(from)];
      const double w = sum / inside, v = (all - sum) / outside;
      if (!(w > v)) continue;
      const double ratio = -0.5 * (inside * std::log(w / u) + outside * std::log(std::max(v / u, 1e-12)));
      if (ratio > found.ratio) found = {input, from, to - 1, ratio};
    }
  }

  std::vector<std::vector<Index>> orders_, neighbours_;
  std::vector<std::vector<Index>> begins_;  // of runs with one value, in the order, and n
  std::vector<Index> lengths_;
};

}  // namespace drawpoint::kriging::detail
