// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The box cut into cells of few runs each, so that the points of a cell share one neighbourhood of runs.
///
/// A cell with more runs than allowed is halved between two of its runs, across the input in which it is
/// widest in the present length scales. Its neighbourhood is its own runs and those most correlated with
/// their middle. Cost n log²n, and n d a cell for the neighbourhoods.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/nearest/largest_of.hpp>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

class Cells {
 public:
  Cells() = default;
  /// X: n x d, scaled; at most `most` runs a cell, unless they stand at one point.
  Cells(const Eigen::MatrixXd& X, const CorrelationFunction& f, Index most) {
    std::vector<int> all(static_cast<std::size_t>(X.rows()));
    std::iota(all.begin(), all.end(), 0);
    divide(X, f, most, std::move(all));
  }

  int count() const { return static_cast<int>(runs_.size()); }
  /// Indices of the runs of a cell, ascending.
  const std::vector<int>& runs(int cell) const { return runs_[static_cast<std::size_t>(cell)]; }

  /// The cell of the row of X, scaled, that a point is.
  int at(const Eigen::MatrixXd& X, Index row) const {
    int node = 0;
    while (nodes_[static_cast<std::size_t>(node)].cell < 0) {
      const Node& n = nodes_[static_cast<std::size_t>(node)];
      node = X(row, n.input) < n.cut ? n.below : n.above;
    }
    return nodes_[static_cast<std::size_t>(node)].cell;
  }

 private:
  struct Node {
    Index input = 0;
    double cut = 0;
    int below = -1, above = -1, cell = -1;
  };

  // The widest input, or -1 where all runs stand at one point.
  static Index widest(const Eigen::MatrixXd& X, const CorrelationFunction& f, const std::vector<int>& runs) {
    Index input = -1;
    double most = 0;
    for (Index k = 0; k < X.cols(); ++k) {
      const auto [low, high] =
          std::minmax_element(runs.begin(), runs.end(), [&](int a, int b) { return X(a, k) < X(b, k); });
      const double width = std::sqrt(f.theta[k]) * distance_between(f.levels, k, X(*low, k), X(*high, k));
      if (!(width > most)) continue;
      most = width;
      input = k;
    }
    return input;
  }

  // Between the two different values that are nearest to the median.
  static double cut_of(const Eigen::MatrixXd& X, const std::vector<int>& runs, Index k) {
    std::vector<double> values;
    for (const int i : runs) values.push_back(X(i, k));
    std::sort(values.begin(), values.end());
    const std::size_t size = values.size(), half = size / 2;
    std::size_t at = 0;
    for (std::size_t i = 1; i < size; ++i)
      if (values[i - 1] < values[i] &&
          (at == 0 || std::max(i, half) - std::min(i, half) < std::max(at, half) - std::min(at, half)))
        at = i;
    const double middle = std::midpoint(values[at - 1], values[at]);
    return middle > values[at - 1] ? middle : values[at];
  }

  int divide(const Eigen::MatrixXd& X, const CorrelationFunction& f, Index most, std::vector<int> runs) {
    const auto place = static_cast<std::size_t>(nodes_.size());
    nodes_.emplace_back();
    const Index k = static_cast<Index>(runs.size()) > most ? widest(X, f, runs) : -1;
    if (k < 0) {
      nodes_[place].cell = count();
      runs_.push_back(std::move(runs));
      return static_cast<int>(place);
    }
    const double cut = cut_of(X, runs, k);
    const auto second = std::stable_partition(runs.begin(), runs.end(), [&](int i) { return X(i, k) < cut; });
    const int below = divide(X, f, most, {runs.begin(), second});
    const int above = divide(X, f, most, {second, runs.end()});
    nodes_[place] = {k, cut, below, above, -1};
    return static_cast<int>(place);
  }

  std::vector<Node> nodes_;
  std::vector<std::vector<int>> runs_;
};

/// The median of each input among these rows of X, a level where that is a category.
inline Eigen::VectorXd middle_of(const Eigen::MatrixXd& X, const std::vector<int>& runs) {
  Eigen::VectorXd middle(X.cols());
  for (Index k = 0; k < X.cols(); ++k) {
    std::vector<double> values;
    for (const int i : runs) values.push_back(X(i, k));
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    middle[k] = *half;
  }
  return middle;
}

/// `size` runs, ascending, or all: those of a cell and the most correlated with their middle.
inline std::vector<int> neighbourhood_of(const Eigen::MatrixXd& X, const CorrelationFunction& f,
                                         const std::vector<int>& own, Index size) {
  const Eigen::VectorXd middle = middle_of(X, own);
  std::vector<double> c(static_cast<std::size_t>(X.rows()));
  correlate(f, {X, 0, X.rows(), middle.data()}, c.data());
  for (const int i : own) c[static_cast<std::size_t>(i)] = std::numeric_limits<double>::infinity();
  return largest_of(c, X.rows(), std::max(size, static_cast<Index>(own.size())));
}

}  // namespace drawpoint::kriging::detail
