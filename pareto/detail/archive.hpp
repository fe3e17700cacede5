// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The best points that a search has met: feasible, mutually non-dominated, at most `capacity` of them.
///
/// Controlled elitism gives up part of the best front for the sake of the search; the archive keeps that from
/// costing result. When it is over full the most crowded points go, half the excess at a time with the
/// distances computed anew in between, so that a cluster is thinned and not wiped out.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <drawpoint/pareto/crowding.hpp>
#include <drawpoint/pareto/detail/population.hpp>

namespace drawpoint::pareto::detail {

/// The `count` rows of largest distance, in rising order; the earlier row wins a tie.
inline std::vector<int> least_crowded(const Eigen::VectorXd& distance, int count) {
  const auto before = [&](int a, int b) {
    return distance[a] != distance[b] ? distance[a] > distance[b] : a < b;
  };
  std::vector<int> rows(static_cast<std::size_t>(distance.size()));
  std::iota(rows.begin(), rows.end(), 0);
  if (count == static_cast<int>(rows.size())) return rows;
  std::vector<int> ordered = rows;
  std::nth_element(ordered.begin(), ordered.begin() + count, ordered.end(), before);
  std::erase_if(rows, [&, first_left_out = ordered[count]](int i) { return !before(i, first_left_out); });
  return rows;
}

class Archive {
 public:
  explicit Archive(int capacity) : capacity_(capacity) {}

  const Population& members() const { return members_; }

  /// candidates: feasible rows of `from`.
  void add(const Population& from, const std::vector<int>& candidates) {
    const bool first = members_.U.cols() == 0;
    const Population added = selected(from, candidates), all = first ? added : joined(members_, added);
    members_ = selected(all, thinned(all.Y));
  }

  template <class Self, class Stream>
  static void fields(Self& self, Stream& stream) {
    stream.item("archive", self.members_);
  }

 private:
  /// Rows to keep of the n x m objectives.
  std::vector<int> thinned(const Eigen::MatrixXd& Y) const {
    const std::vector<int> best = non_dominated(Y);
    const auto capacity = static_cast<std::size_t>(capacity_);
    if (best.size() <= capacity) return best;
    CrowdingLines lines(Y(best, Eigen::all));
    std::vector<int> left(best.size());  // places in `best`
    std::iota(left.begin(), left.end(), 0);
    while (left.size() > capacity) {
      const std::size_t excess = left.size() - capacity;
      const Eigen::VectorXd distance = lines.distances()(left);
      std::vector<int> kept = least_crowded(distance, static_cast<int>(left.size() - (excess + 1) / 2));
      for (int& i : kept) i = left[static_cast<std::size_t>(i)];
      left = std::move(kept);
      lines.keep(left);
    }
    for (int& i : left) i = best[static_cast<std::size_t>(i)];
    return left;
  }

  int capacity_;
  Population members_;
};

}  // namespace drawpoint::pareto::detail
