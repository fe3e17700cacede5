// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Survival of NSGA-III: the objectives scaled, the last front by the emptiest niches.

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <drawpoint/pareto/detail/compiled.hpp>
#include <drawpoint/pareto/detail/directed.hpp>
#include <drawpoint/pareto/detail/evolution.hpp>
#include <drawpoint/pareto/detail/roles.hpp>
#include <drawpoint/pareto/nsga3.hpp>

namespace drawpoint::pareto {
namespace detail {

/// Ideal point and intercepts, kept from generation to generation.
class Normalisation {
 public:
  /// Y: n x m, the points under selection; first: rows of the first front. Returns Y scaled.
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& Y, const std::vector<int>& first) {
    const Eigen::RowVectorXd best = Y.colwise().minCoeff();
    ideal_ = ideal_.size() == 0 ? best : ideal_.cwiseMin(best);
    extremes_ = extremes_.rows() == 0 ? Y : stacked(extremes_, Y);
    unit_ = extremes_.colwise().maxCoeff() - ideal_;
    for (double& u : unit_)
      if (!(u > 0.0)) u = 1.0;  // an objective that does not vary
    keep_extremes();
    const Eigen::MatrixXd front = Y(first, Eigen::all);
    const Eigen::RowVectorXd worst = front.colwise().maxCoeff() - ideal_;
    Eigen::RowVectorXd scale = intercepts();
    for (Eigen::Index j = 0; j < scale.size(); ++j)
      if (!(scale[j] > 1e-6 * worst[j]) || scale[j] > 1e6 * worst[j]) scale = worst;
    for (double& s : scale)
      if (!(s > 0.0)) s = 1.0;  // an objective that does not vary
    return over(Y.rowwise() - ideal_, scale);
  }

  template <class Self, class Stream>
  static void fields(Self& self, Stream& stream) {
    stream.item("ideal", self.ideal_);
    stream.item("extremes", self.extremes_);
  }

 private:
  /// In units of the objectives' ranges, so that no unit of theirs counts.
  Eigen::MatrixXd offsets() const { return over(extremes_.rowwise() - ideal_, unit_); }

  /// By objective the point that lies nearest to its axis, among the old extremes and the new points.
  void keep_extremes() {
    const Eigen::Index m = extremes_.cols();
    const Eigen::MatrixXd offset = offsets();
    Eigen::MatrixXd next(m, m);
    for (Eigen::Index j = 0; j < m; ++j) {
      Eigen::RowVectorXd weight = Eigen::RowVectorXd::Constant(m, 1e6);
      weight[j] = 1.0;
      Eigen::Index row;
      (offset * weight.asDiagonal()).rowwise().maxCoeff().minCoeff(&row);
      next.row(j) = extremes_.row(row);
    }
    extremes_ = next;
  }

  /// Where the plane through the extremes meets the axes; not positive where there is no plane.
  Eigen::RowVectorXd intercepts() const {
    const Eigen::Index m = ideal_.size();
    const Eigen::FullPivLU<Eigen::MatrixXd> plane(offsets());
    if (plane.rank() < m) return Eigen::RowVectorXd::Zero(m);
    return plane.solve(Eigen::VectorXd::Ones(m)).cwiseInverse().transpose().cwiseProduct(unit_);
  }

  Eigen::RowVectorXd ideal_, unit_;
  Eigen::MatrixXd extremes_;
};

/// For each row of Y (n x m, scaled) the direction that it lies nearest to, and its distance from that line.
struct Niches {
  std::vector<int> direction;
  std::vector<double> distance;
};

inline Niches niches(const Eigen::MatrixXd& Y, const Eigen::MatrixXd& unit_directions) {
  Niches result{std::vector<int>(static_cast<std::size_t>(Y.rows())),
                std::vector<double>(static_cast<std::size_t>(Y.rows()))};
  const Eigen::MatrixXd along = Y * unit_directions.transpose();
  for (Eigen::Index i = 0; i < Y.rows(); ++i) {
    Eigen::Index nearest;
    const double most = along.row(i).maxCoeff(&nearest);
    result.direction[i] = static_cast<int>(nearest);
    result.distance[i] = std::sqrt(std::max(Y.row(i).squaredNorm() - most * most, 0.0));
  }
  return result;
}

/// Chooses `places` of the candidates (places in `niches`) by the emptiest niche; `count` counts the chosen.
inline std::vector<int> fill_niches(std::vector<int> candidates, std::size_t places, const Niches& niches,
                                    std::vector<int> count, doe::RandomStream& random) {
  std::vector<std::vector<int>> of(count.size());
  for (const int i : candidates) of[niches.direction[i]].push_back(i);
  std::vector<int> chosen;
  while (chosen.size() < places) {
    int least = std::numeric_limits<int>::max();
    std::vector<int> emptiest;
    for (int k = 0; k < static_cast<int>(of.size()); ++k) {
      if (of[k].empty() || count[k] > least) continue;
      if (count[k] < least) emptiest.clear();
      least = count[k];
      emptiest.push_back(k);
    }
    const int k = emptiest[random.below(static_cast<int>(emptiest.size()))];
    auto pick = of[k].begin() + random.below(static_cast<int>(of[k].size()));
    if (count[k] == 0)
      pick = std::min_element(of[k].begin(), of[k].end(),
                              [&](int a, int b) { return niches.distance[a] < niches.distance[b]; });
    chosen.push_back(*pick);
    of[k].erase(pick);
    ++count[k];
  }
  return chosen;
}

class NicheSurvival {
 public:
  NicheSurvival(int population, const Eigen::MatrixXd& directions)
      : places_(static_cast<std::size_t>(population)), unit_(directions.rowwise().normalized()) {}

  /// Feasible survivors have rank 0, so that the tournament picks among them at random.
  Survivors operator()(const Population& pool, const Ranking& ranking, doe::RandomStream& random) {
    std::vector<int> rows = feasible_survivors(pool, ranking, random);
    std::vector<int> ranks(rows.size(), 0);
    for (std::size_t k = ranking.feasible; k < ranking.fronts.size(); ++k)
      for (const int i : ranking.fronts[k]) {
        if (rows.size() == places_) break;
        rows.push_back(i);
        ranks.push_back(static_cast<int>(k) + 1);
      }
    std::vector<double> distance(rows.size(), 0.0);
    return {std::move(rows), std::move(ranks), std::move(distance)};
  }

  template <class Self, class Stream>
  static void fields(Self& self, Stream& stream) {
    Normalisation::fields(self.normalise_, stream);
  }

 private:
  std::vector<int> feasible_survivors(const Population& pool, const Ranking& ranking,
                                      doe::RandomStream& random) {
    std::vector<int> rows;  // whole fronts, then the one that does not fit
    std::size_t whole = 0;
    for (std::size_t k = 0; k < ranking.feasible && rows.size() < places_; ++k) {
      whole = rows.size();
      rows.insert(rows.end(), ranking.fronts[k].begin(), ranking.fronts[k].end());
    }
    if (rows.size() <= places_) return rows;
    std::vector<int> first(ranking.fronts.front().size()), last;
    for (std::size_t i = 0; i < first.size(); ++i) first[i] = static_cast<int>(i);
    for (std::size_t i = whole; i < rows.size(); ++i) last.push_back(static_cast<int>(i));
    const Niches found = niches(normalise_(pool.Y(rows, Eigen::all), first), unit_);
    std::vector<int> count(static_cast<std::size_t>(unit_.rows()), 0);
    for (std::size_t i = 0; i < whole; ++i) ++count[found.direction[i]];
    std::vector<int> survivors(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(whole));
    for (const int i : fill_niches(last, places_ - whole, found, count, random)) survivors.push_back(rows[i]);
    return survivors;
  }

  std::size_t places_;
  Eigen::MatrixXd unit_;
  Normalisation normalise_;
};

inline Directed directed(const doe::Problem& problem, const Nsga3Options& o) {
  return directed(setting_for("pareto::nsga3: ", problem, o.search,
                              {.crossover_probability = 1.0, .crossover_index = 30.0}),
                  o.directions, problem);
}

inline std::unique_ptr<SearchProcess> process_of(const doe::Problem& problem, const Nsga3Options& options) {
  const Directed given = directed(problem, options);
  return std::make_unique<Evolution<NicheSurvival>>(
      problem, given.setting, NicheSurvival(given.setting.population, given.directions));
}

}  // namespace detail

DRAWPOINT_PARETO_INLINE Nsga3::Nsga3(const doe::Problem& problem, const Nsga3Options& options)
    : Search(detail::process_of(problem, options)) {}

}  // namespace drawpoint::pareto
