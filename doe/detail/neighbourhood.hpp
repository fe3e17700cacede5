// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Neighbourhoods for gradients: for each site the m = 2d others that lie close and all around it.
///
/// With p_i the positions of the neighbours relative to the site:
///   cohesion  C = (1/m) Σ_i |p_i|                       small: close
///   adhesion  A = (1/m) Σ_i min_{j≠i} |p_i − p_j|       large: apart from each other
///   ratio     R = A / (√2 C),                           1 for the cross-polytope {±r e_k}
///             d = 1: R = 1 − |p₁ + p₂| / (|p₁| + |p₂| + |p₁ − p₂|)
///   score     S = R / C, to be maximised
/// Lengths are those of the coordinates given: scale them to a common box. Sites come one by one: a newcomer
/// is tried in place of each member of each set and stays where the score rises most, and every earlier site
/// is tried for the newcomer's own set, which starts from the m nearest. A candidate farther off than 3.5
/// times the farthest member is skipped, as in the SUMO toolbox. Cost of a newcomer O(n (d + m²)), memory
/// O(n m²). The sets depend on the order of the sites.
/// Source: Crombecq, Gorissen, Deschrijver, Dhaene 2011, SIAM J. Sci. Comput. 33(4), 1948-1974.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::doe {

/// P: m x d, positions relative to the site. 0 without neighbours.
inline double cohesion(const Eigen::MatrixXd& P) { return P.rows() ? P.rowwise().norm().mean() : 0.0; }

/// P: m x d. 0 with fewer than two neighbours.
inline double adhesion(const Eigen::MatrixXd& P) {
  if (P.rows() < 2) return 0.0;
  double sum = 0;
  for (Eigen::Index i = 0; i < P.rows(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < P.rows(); ++j)
      if (j != i) nearest = std::min(nearest, (P.row(i) - P.row(j)).norm());
    sum += nearest;
  }
  return sum / static_cast<double>(P.rows());
}

/// P: m x d with m = 2d. In [0, 1]; 0 when all neighbours coincide with the site.
inline double cross_polytope_ratio(const Eigen::MatrixXd& P) {
  if (P.cols() == 1 && P.rows() == 2) {
    const double extent = std::abs(P(0)) + std::abs(P(1)) + std::abs(P(0) - P(1));
    return extent > 0.0 ? 1.0 - std::abs(P(0) + P(1)) / extent : 0.0;
  }
  const double c = cohesion(P);
  return c > 0.0 ? adhesion(P) / (std::numbers::sqrt2 * c) : 0.0;
}

/// P: m x d with m = 2d. S = R / C.
inline double neighbourhood_score(const Eigen::MatrixXd& P) {
  const double c = cohesion(P);
  return c > 0.0 ? cross_polytope_ratio(P) / c : 0.0;
}

namespace detail {

/// The members of one set with what is needed to judge a replacement in O(m²).
struct NeighbourSet {
  std::vector<int> members = {};
  std::vector<double> distance = {};  ///< of each member to the centre
  Eigen::MatrixXd apart = {};         ///< m x m between members, ∞ on the diagonal
  double score = 0, farthest = 0;
};

}  // namespace detail

/// The neighbourhoods of a growing set of sites.
class Neighbourhoods {
 public:
  /// Throws std::invalid_argument when d < 1.
  explicit Neighbourhoods(Eigen::Index d) : d_(d), m_(2 * static_cast<std::size_t>(d)) {
    if (d < 1)
      throw std::invalid_argument("doe::Neighbourhoods: d is " + std::to_string(d) +
                                  "; allowed is 1 or more; give the number of variables");
  }

  int size() const { return static_cast<int>(sets_.size()); }

  /// Up to 2d sites, fewer only while there are no more; neither sorted nor with the site itself.
  const std::vector<int>& of(int site) const { return sets_[static_cast<std::size_t>(site)].members; }
  double score(int site) const { return sets_[static_cast<std::size_t>(site)].score; }
  const Eigen::VectorXd& position(int site) const { return sites_[static_cast<std::size_t>(site)]; }

  /// A new site; u has d entries, all in the same scale. It must differ from the earlier ones.
  void add(const Eigen::VectorXd& u) {
    const int fresh = size();
    std::vector<double> distance(sites_.size());
    for (std::size_t i = 0; i < sites_.size(); ++i) distance[i] = (sites_[i] - u).norm();
    sites_.push_back(u);
    sets_.emplace_back();
    for (int old = 0; old < fresh; ++old) consider(old, fresh, distance[old]);
    std::vector<int> order(distance.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return distance[a] < distance[b]; });
    for (const int old : order)
      if (!consider(fresh, old, distance[old])) break;
  }

 private:
  static constexpr double too_far = 3.5;  // times the farthest member

  /// Tries `candidate` for the set of `centre`; false when it is too far off to be tried.
  bool consider(int centre, int candidate, double distance) {
    detail::NeighbourSet& set = sets_[static_cast<std::size_t>(centre)];
    if (set.members.size() < m_) {
      insert(set, candidate, distance);
      return true;
    }
    if (distance > too_far * set.farthest) return false;
    replace_if_better(set, candidate, distance);
    return true;
  }

  double between(int a, int b) const { return (sites_[a] - sites_[b]).norm(); }

  void insert(detail::NeighbourSet& set, int candidate, double distance) {
    if (set.members.empty())
      set.apart.setConstant(static_cast<Eigen::Index>(m_), static_cast<Eigen::Index>(m_),
                            std::numeric_limits<double>::infinity());
    const std::size_t place = set.members.size();
    set.members.push_back(candidate);
    set.distance.push_back(distance);
    put(set, place, candidate, distance);
  }

  /// Member `place` becomes `candidate`, and everything that hangs on it is brought up to date.
  void put(detail::NeighbourSet& set, std::size_t place, int candidate, double distance) {
    set.members[place] = candidate;
    set.distance[place] = distance;
    const auto at = static_cast<Eigen::Index>(place);
    for (std::size_t k = 0; k < set.members.size(); ++k)
      if (k != place) {
        const auto other = static_cast<Eigen::Index>(k);
        set.apart(at, other) = set.apart(other, at) = between(candidate, set.members[k]);
      }
    set.farthest = *std::max_element(set.distance.begin(), set.distance.end());
    if (set.members.size() == m_) set.score = full_score(set);
  }

  double full_score(const detail::NeighbourSet& set) const {
    const double c = std::accumulate(set.distance.begin(), set.distance.end(), 0.0) / static_cast<double>(m_);
    return scored(c, set.apart.rowwise().minCoeff().mean(), set.distance[0], set.distance[1],
                  set.apart(0, 1));
  }

  /// S from cohesion and adhesion; the last three are used for d = 1 alone, where |p₁ + p₂| is the difference
  /// of the distances when the two lie on opposite sides, else their sum.
  double scored(double c, double a, double one, double two, double apart) const {
    if (!(c > 0.0)) return 0.0;
    if (d_ > 1) return a / (std::numbers::sqrt2 * c * c);
    const bool opposite = apart > std::max(one, two);
    const double sum = opposite ? std::abs(one - two) : one + two;
    return (1.0 - sum / (one + two + apart)) / c;
  }

  void replace_if_better(detail::NeighbourSet& set, int candidate, double distance) {
    const auto m = static_cast<Eigen::Index>(m_);
    Eigen::VectorXd to(m);
    for (Eigen::Index k = 0; k < m; ++k) to[k] = between(candidate, set.members[k]);
    const double c = std::accumulate(set.distance.begin(), set.distance.end(), 0.0);
    double best = set.score;
    Eigen::Index place = -1;
    for (Eigen::Index i = 0; i < m; ++i) {
      const double cohesion = (c + distance - set.distance[i]) / static_cast<double>(m);
      if (cohesion * best >= 1.0) continue;  // R <= 1, so S cannot exceed 1/C
      const Eigen::Index other = i == 0 ? 1 : 0;
      const double s = scored(cohesion, adhesion_with(set, to, i), distance, set.distance[other], to[other]);
      if (s > best) best = s, place = i;
    }
    if (place >= 0) put(set, static_cast<std::size_t>(place), candidate, distance);
  }

  /// A of the set with member i replaced by a candidate at the distances `to` from the members.
  static double adhesion_with(const detail::NeighbourSet& set, const Eigen::VectorXd& to, Eigen::Index i) {
    const Eigen::Index m = to.size();
    double sum = 0, own = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < m; ++j) {
      if (j == i) continue;
      own = std::min(own, to[j]);
      double nearest = to[j];
      for (Eigen::Index k = 0; k < m; ++k)
        if (k != i) nearest = std::min(nearest, set.apart(k, j));
      sum += nearest;
    }
    return (sum + own) / static_cast<double>(m);
  }

  Eigen::Index d_;
  std::size_t m_;
  std::vector<Eigen::VectorXd> sites_;
  std::vector<detail::NeighbourSet> sets_;
};

}  // namespace drawpoint::doe
