// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The shares of the box that lie nearest to each site: relative volumes of the Voronoi cells.
///
/// V_i = (test points nearest to site i) / (all test points), so Σ V = 1. The test points are uniform in the
/// box, or in the part of it that a predicate allows; distances are Euclidean in the unit box. With N test
/// points a volume V has the standard deviation √(V(1 − V)/N): about a tenth of its size with 100 points a
/// site. Sites and test points are only ever added: a new site costs O(N d), a new test point O(n d). Point k
/// depends on (seed, k) alone, so growing in one step or in many gives the same bits.

#include <Eigen/Core>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include <drawpoint/doe/allowed.hpp>
#include <drawpoint/doe/detail/nearest.hpp>
#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/detail/unit_box.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe {

class VoronoiCells {
 public:
  VoronoiCells(Problem problem, Allowed allowed, Seed seed)
      : problem_(std::move(problem)),
        allowed_(std::move(allowed)),
        seed_(seed),
        points_(0, static_cast<Eigen::Index>(problem_.variables.size())),
        sites_(0, points_.cols()) {}

  Eigen::Index sites() const { return sites_.rows(); }
  Eigen::Index points() const { return points_.rows(); }

  /// Unit box, one site a row.
  void add_sites(const Eigen::MatrixXd& U) {
    const Eigen::Index old = sites_.rows();
    sites_.conservativeResize(old + U.rows(), Eigen::NoChange);
    sites_.bottomRows(U.rows()) = U;
    for (Eigen::Index i = old; i < sites_.rows(); ++i)
      detail::meet(nearest_, points_, sites_.row(i), static_cast<int>(i), 0, points_.rows());
  }

  /// At least `count` test points. Throws std::invalid_argument when the predicate allows next to nothing.
  void ensure_points(Eigen::Index count) {
    const Eigen::Index old = points_.rows();
    if (count <= old) return;
    Eigen::MatrixXd fresh = detail::allowed_points(problem_, allowed_, seed_, count - old, drawn_);
    if (fresh.rows() < count - old)
      throw std::invalid_argument(
          "doe::VoronoiCells: allowed holds at fewer than 1 of 1000 points of the box; narrow the bounds of "
          "the variables to the allowed part");
    fresh = detail::to_unit_box(std::move(fresh), problem_);
    detail::Nearest more = detail::nearest_sites(fresh, sites_);
    points_.conservativeResize(count, Eigen::NoChange);
    points_.bottomRows(fresh.rows()) = fresh;
    nearest_.site.insert(nearest_.site.end(), more.site.begin(), more.site.end());
    nearest_.squared_distance.conservativeResize(count);
    nearest_.squared_distance.tail(fresh.rows()) = more.squared_distance;
  }

  /// One volume a site, sum 1; zeros without test points.
  Eigen::VectorXd volumes() const {
    Eigen::VectorXd volume = Eigen::VectorXd::Zero(sites_.rows());
    for (const int site : nearest_.site)
      if (site >= 0) volume[site] += 1.0;
    return points_.rows() ? Eigen::VectorXd(volume / static_cast<double>(points_.rows())) : volume;
  }

 private:
  Problem problem_;
  Allowed allowed_;
  Seed seed_;
  std::uint64_t drawn_ = 0;
  Eigen::MatrixXd points_, sites_;
  detail::Nearest nearest_;
};

}  // namespace drawpoint::doe
