// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Exact hypervolume and what each point contributes to it alone.
///
/// The forms with a problem take points and reference in natural signs, the others minimise every column
/// (minimised.hpp). H(P, r) = volume of ∪_p [p_1, r_1]×...×[p_m, r_m], bounded by the reference point r. The
/// exclusive contribution of p is H(P) - H(P without p). Points that are not better than r in every objective
/// add nothing; dominated and repeated points are allowed. H: a sweep over the last objective with the union
/// of the others (box_union.hpp), O(n log n) for m = 2, near it for m = 3, O(n²) for m = 4, a factor n for
/// each objective more at worst; meant for m <= 6. Contributions: O(n log n) for m = 2, near it for m = 3
/// (volume_contributions.hpp), n unions beyond. Relative rounding error of H below about n·1e-16, of a
/// contribution about n·1e-16 of p's own box.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <drawpoint/pareto/detail/box_union.hpp>
#include <drawpoint/pareto/detail/ordered_points.hpp>
#include <drawpoint/pareto/detail/volume_contributions.hpp>
#include <drawpoint/pareto/minimised.hpp>

namespace drawpoint::pareto {

inline constexpr int most_volume_objectives = 8;

namespace detail {

/// Points as boxes below the reference, every side positive, the last side falling; `rows` are their rows,
/// `sides` has as many at least.
struct Boxes {
  RowMajor sides;
  std::vector<int> rows;

  Eigen::Index size() const { return static_cast<Eigen::Index>(rows.size()); }
  const double* side(Eigen::Index i) const { return sides.data() + i * sides.cols(); }

  /// Nothing where that row has no box.
  void remove(int row) {
    const auto place = std::find(rows.begin(), rows.end(), row);
    if (place == rows.end()) return;
    double* box = sides.data() + (place - rows.begin()) * sides.cols();
    std::copy(box + sides.cols(), sides.data() + size() * sides.cols(), box);
    rows.erase(place);
  }
};

inline Boxes boxes(const Eigen::MatrixXd& points, const Eigen::VectorXd& reference) {
  const Eigen::Index m = points.cols();
  std::vector<KeyedRow> rows;
  rows.reserve(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if ((points.row(i).transpose().array() < reference.array()).all())
      rows.push_back({rising_bits(points(i, m - 1)), static_cast<int>(i)});
  sort_by_key(rows);
  Boxes result{RowMajor(rows.size(), m), {}};
  result.rows.reserve(rows.size());
  for (const KeyedRow& r : rows) result.rows.push_back(r.row);
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index i = 0; i < result.size(); ++i)
      result.sides(i, j) = reference[j] - points(rows[static_cast<std::size_t>(i)].row, j);
  return result;
}

/// Calls body with the number of objectives as a compile-time constant.
template <class Body>
auto with_dimension(Eigen::Index m, const Body& body) {
  using std::integral_constant;
  switch (m) {
    case 1:
      return body(integral_constant<int, 1>());
    case 2:
      return body(integral_constant<int, 2>());
    case 3:
      return body(integral_constant<int, 3>());
    case 4:
      return body(integral_constant<int, 4>());
    case 5:
      return body(integral_constant<int, 5>());
    case 6:
      return body(integral_constant<int, 6>());
    case 7:
      return body(integral_constant<int, 7>());
    default:
      return body(integral_constant<int, 8>());
  }
}

inline void check_volume_input(const std::string& place, const Eigen::MatrixXd& points,
                               const Eigen::VectorXd& reference) {
  if (points.cols() != reference.size() || reference.size() == 0)
    throw std::invalid_argument(place + "points has " + std::to_string(points.cols()) +
                                " columns, reference has " + std::to_string(reference.size()) +
                                " entries; both need one per objective");
  if (points.cols() > most_volume_objectives)
    throw std::invalid_argument(
        place + "points has " + std::to_string(points.cols()) + " objectives; allowed are up to " +
        std::to_string(most_volume_objectives) +
        ", for the cost grows exponentially; compare such fronts by pareto::igd_plus");
  if (!points.allFinite())
    throw std::invalid_argument(place + "points holds NaN or infinity; leave out failed runs");
  if (!reference.allFinite())
    throw std::invalid_argument(place + "reference holds NaN or infinity; give finite numbers");
}

/// Σ (what the first m-1 sides of each box add to those of the deeper ones)·(its last side).
template <int M>
double swept_volume(const Boxes& boxes) {
  if constexpr (M == 1) {
    return boxes.size() == 0 ? 0.0 : boxes.sides(0, 0);
  } else {
    BoxUnion<M - 1> covered;
    double total = 0.0;
    for (Eigen::Index i = 0; i < boxes.size(); ++i)
      total += covered.add(boxes.side(i)) * boxes.sides(i, M - 1);
    return total;
  }
}

/// One after the other is left out: `others` holds the boxes but the i-th, in order.
template <int M>
void contributions_by_unions(const Boxes& boxes, Eigen::VectorXd& result) {
  BoxUnion<M> others;
  for (Eigen::Index i = 0; i < boxes.size(); ++i) {
    others.clear();
    for (Eigen::Index k = 0; k < boxes.size(); ++k)
      if (k != i) others.append(boxes.side(k));
    result[boxes.rows[i]] = others.growth(boxes.side(i));
  }
}

inline void contributions_of_lengths(const Boxes& boxes, Eigen::VectorXd& result) {
  if (boxes.size() == 0) return;
  result[boxes.rows[0]] = boxes.sides(0, 0) - (boxes.size() > 1 ? boxes.sides(1, 0) : 0.0);
}

/// In falling order of the second side, a box adds to those before it [left, x]×[0, y]. The boxes after it
/// take from that what they cover: the first that reaches beyond x takes all below its height; until then
/// each raises a staircase. A dominated box meets one that covers it, before or after.
inline void contributions_of_areas(const Boxes& boxes, Eigen::VectorXd& result) {
  double left = 0.0;
  BoxUnion<2> covered;
  for (Eigen::Index i = 0; i < boxes.size(); ++i) {
    const double x = boxes.sides(i, 0), y = boxes.sides(i, 1);
    if (x <= left) continue;
    covered.clear();
    double area = (x - left) * y;
    for (Eigen::Index k = i + 1; k < boxes.size(); ++k) {
      const double reach = std::min(boxes.sides(k, 0), x);
      if (reach > left) area -= covered.add(reach - left, boxes.sides(k, 1));
      if (reach == x) break;
    }
    result[boxes.rows[i]] = area;
    left = x;
  }
}

inline void contributions_of_volumes(const Boxes& boxes, Eigen::VectorXd& result) {
  VolumeContributions sweep(boxes.rows.size());
  for (Eigen::Index i = 0; i < boxes.size(); ++i)
    sweep.add(boxes.sides(i, 0), boxes.sides(i, 1), boxes.sides(i, 2));
  const std::vector<double> volumes = sweep.volumes();
  for (std::size_t i = 0; i < volumes.size(); ++i) result[boxes.rows[i]] = volumes[i];
}

template <int M>
void contributions(const Boxes& boxes, Eigen::VectorXd& result) {
  if constexpr (M == 1) {
    contributions_of_lengths(boxes, result);
  } else if constexpr (M == 2) {
    contributions_of_areas(boxes, result);
  } else if constexpr (M == 3) {
    contributions_of_volumes(boxes, result);
  } else {
    contributions_by_unions<M>(boxes, result);
  }
}

/// n numbers; 0 for rows without a box.
inline Eigen::VectorXd contributions(const Boxes& boxes, Eigen::Index n) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(n);
  with_dimension(boxes.sides.cols(), [&](auto m) { contributions<decltype(m)::value>(boxes, result); });
  return result;
}

}  // namespace detail

/// points: n x m, minimised; reference: m. Returns the volume in the product of the objectives' units. Throws
/// std::invalid_argument when the sizes differ, a number is not finite, or m is above most_volume_objectives.
inline double hypervolume(const Eigen::MatrixXd& points, const Eigen::VectorXd& reference) {
  detail::check_volume_input("pareto::hypervolume: ", points, reference);
  const detail::Boxes boxes = detail::boxes(points, reference);
  return detail::with_dimension(points.cols(),
                                [&](auto m) { return detail::swept_volume<decltype(m)::value>(boxes); });
}

/// What the hypervolume loses with each point: n numbers, 0 for a point that is dominated, repeated or beyond
/// the reference. Throws as hypervolume does.
inline Eigen::VectorXd hypervolume_contributions(const Eigen::MatrixXd& points,
                                                 const Eigen::VectorXd& reference) {
  detail::check_volume_input("pareto::hypervolume_contributions: ", points, reference);
  return detail::contributions(detail::boxes(points, reference), points.rows());
}

/// The same in natural signs; reference: m, worse than what counts in every objective.
inline double hypervolume(const doe::Problem& problem, const Eigen::MatrixXd& Y,
                          const Eigen::VectorXd& reference) {
  return hypervolume(minimised(problem, Y), minimised(problem, reference.transpose()).transpose());
}

inline Eigen::VectorXd hypervolume_contributions(const doe::Problem& problem, const Eigen::MatrixXd& Y,
                                                 const Eigen::VectorXd& reference) {
  return hypervolume_contributions(minimised(problem, Y),
                                   minimised(problem, reference.transpose()).transpose());
}

}  // namespace drawpoint::pareto
