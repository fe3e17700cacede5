// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The points of a batch, one by one, from random candidates that climb: the rules stand in propose.hpp.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/criterion.hpp>
#include <drawpoint/doe/detail/climb_score.hpp>
#include <drawpoint/doe/detail/nearest.hpp>
#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/detail/unit_box.hpp>
#include <drawpoint/doe/detail/voronoi.hpp>
#include <drawpoint/doe/propose_options.hpp>

namespace drawpoint::doe::detail {

/// Chooses points one by one from a fixed set of candidates.
class Chooser {
 public:
  Chooser(const Evaluations& runs, const ProposeOptions& options)
      : runs_(runs), options_(options), X_(candidates()), U_(to_unit_box(X_, runs.problem)) {
    Eigen::MatrixXd sites(static_cast<Eigen::Index>(runs.rows.size()), U_.cols());
    for (std::size_t i = 0; i < runs.rows.size(); ++i)
      sites.row(static_cast<Eigen::Index>(i)) = runs.rows[i].x;
    sites_ = to_unit_box(std::move(sites), runs.problem);
    nearest_ = nearest_sites(U_, sites_);
    cell_ = nearest_.site;
    penalty_ = Eigen::VectorXd::Ones(U_.rows());
    used_.assign(runs.rows.size() + 1, 0);
    for (Eigen::Index i = 0; i < options.pending.rows(); ++i) accept(i);
  }

  /// `count` more points by the sampler, fewer when the candidates run out.
  void choose(const Sampler& sampler, int count) {
    choose_by([&] { return sampler(runs_); }, options_.rule == BatchRule::believer, count);
  }

  /// The same by a criterion that knows the points chosen before.
  void choose_jointly(const JointCriterion& joint, int count) {
    choose_by([&] { return joint(rows_of(0)); }, true, count);
  }

  /// Natural units, one per row, without those that were pending.
  Eigen::MatrixXd chosen() const { return rows_of(static_cast<std::size_t>(options_.pending.rows())); }

 private:
  /// The points chosen from place `first` on; the pending ones come first.
  Eigen::MatrixXd rows_of(std::size_t first) const {
    Eigen::MatrixXd X(static_cast<Eigen::Index>(chosen_.size() - first), X_.cols());
    for (std::size_t k = first; k < chosen_.size(); ++k)
      X.row(static_cast<Eigen::Index>(k - first)) = X_.row(chosen_[k]);
    return X;
  }

  /// By the criterion that `next` gives, asked for before each choice or once.
  template <class Next>
  void choose_by(const Next& next, bool each_time, int count) {
    Criterion criterion = next();
    Eigen::VectorXd score = scores(criterion, X_);
    for (int k = 0; k < count; ++k) {
      const Eigen::Index best = best_candidate(score);
      if (best < 0) return;
      if (options_.climb) climb(best, criterion, score);
      accept(best);
      if (!each_time || k + 1 == count) continue;
      criterion = next();
      score = scores(criterion, X_);
    }
  }

  static constexpr double closest = 1e-4;   // to a run, in the unit box
  static constexpr std::size_t climbs = 5;  // per chosen point

  Eigen::MatrixXd candidates() const {
    const int automatic = std::clamp(100 * static_cast<int>(runs_.rows.size()), 1000, 20000);
    std::uint64_t counter = 0;
    const Eigen::MatrixXd random =
        allowed_points(runs_.problem, options_.allowed, run_seed(options_.seed, runs_.rows.size(), 1),
                       options_.candidates.value_or(automatic), counter);
    return with_those_given(random);
  }

  /// The pending points, the random ones, and those beside them that are allowed.
  Eigen::MatrixXd with_those_given(const Eigen::MatrixXd& random) const {
    const Eigen::MatrixXd &pending = options_.pending, &beside = options_.beside;
    if (pending.rows() > 0) check_inside(pending, runs_.problem, "doe::propose: pending");
    if (beside.rows() > 0) check_inside(beside, runs_.problem, "doe::propose: beside");
    Eigen::MatrixXd all(pending.rows() + random.rows() + beside.rows(), random.cols());
    if (pending.rows() > 0) all.topRows(pending.rows()) = pending;
    all.middleRows(pending.rows(), random.rows()) = random;
    Eigen::Index kept = pending.rows() + random.rows();
    for (const auto& x : beside.rowwise())
      if (!options_.allowed || options_.allowed(x.transpose())) all.row(kept++) = x;
    all.conservativeResize(kept, Eigen::NoChange);
    return all;
  }

  static Eigen::VectorXd scores(const Criterion& criterion, const Eigen::MatrixXd& X) {
    Eigen::VectorXd score = criterion(X);
    if (score.size() != X.rows())
      throw std::invalid_argument("doe::propose: the criterion gave " + std::to_string(score.size()) +
                                  " scores for " + std::to_string(X.rows()) +
                                  " points; give one score a row of X");
    return score;
  }

  /// What counts at any points of the unit box, by the rule; NaN where none may be.
  Eigen::VectorXd standing(const Criterion& criterion, double lowest, const Eigen::MatrixXd& U) const {
    const Eigen::MatrixXd X = to_natural(U, runs_.problem);
    Eigen::VectorXd score = scores(criterion, X);
    const Nearest run = nearest_sites(U, sites_), taken = nearest_sites(U, places());
    for (Eigen::Index i = 0; i < score.size(); ++i) {
      const bool closed = options_.rule == BatchRule::cells && used_[cell_of(run, i)];
      const double room = std::min(run.squared_distance[i], taken.squared_distance[i]);
      if (closed || room < closest * closest || (options_.allowed && !options_.allowed(X.row(i).transpose())))
        score[i] = std::numeric_limits<double>::quiet_NaN();
      else if (options_.rule == BatchRule::penalty)
        score[i] = (score[i] - lowest) * penalty_at(U.row(i));
    }
    return score;
  }

  /// Moves candidate `best` to the highest maximum that climbs reach from it and from the best of other
  /// cells.
  void climb(Eigen::Index best, const Criterion& criterion, const Eigen::VectorXd& score) {
    const double lowest = lowest_finite(score);
    const UnitScore at = [&](const Eigen::MatrixXd& U) { return standing(criterion, lowest, U); };
    std::vector<Eigen::Index> real;
    for (std::size_t k = 0; k < runs_.problem.variables.size(); ++k)
      if (runs_.problem.variables[k].kind == VariableKind::real) real.push_back(static_cast<Eigen::Index>(k));
    ScoredPoint top{U_.row(best).transpose(), standing_of(best, score, lowest)};
    for (const Eigen::Index i : starts(score, lowest)) {
      const ScoredPoint reached =
          ScoreClimb(at, {U_.row(i).transpose(), standing_of(i, score, lowest)}, real).top();
      if (reached.score > top.score) top = reached;
    }
    if (top.u != U_.row(best).transpose()) place(best, top.u);
  }

  /// The best candidate of each of the best cells.
  std::vector<Eigen::Index> starts(const Eigen::VectorXd& score, double lowest) const {
    std::vector<Eigen::Index> of_cell(used_.size(), -1), found;
    for (Eigen::Index i = 0; i < score.size(); ++i) {
      Eigen::Index& held = of_cell[cell_of(i)];
      if (eligible(i, score) &&
          (held < 0 || standing_of(i, score, lowest) > standing_of(held, score, lowest)))
        held = i;
    }
    std::copy_if(of_cell.begin(), of_cell.end(), std::back_inserter(found), [](auto i) { return i >= 0; });
    std::sort(found.begin(), found.end(), [&](Eigen::Index a, Eigen::Index b) {
      const double sa = standing_of(a, score, lowest), sb = standing_of(b, score, lowest);
      return sa > sb || (sa == sb && a < b);
    });
    found.resize(std::min<std::size_t>(found.size(), climbs));
    return found;
  }

  /// Moves a candidate.
  void place(Eigen::Index i, const Eigen::VectorXd& u) {
    U_.row(i) = u.transpose();
    X_.row(i) = to_natural(Eigen::MatrixXd(u.transpose()), runs_.problem);
    const Nearest run = nearest_sites(U_.row(i), sites_), taken = nearest_sites(U_.row(i), places());
    cell_[static_cast<std::size_t>(i)] = run.site.front();
    nearest_.squared_distance[i] = std::min(run.squared_distance[0], taken.squared_distance[0]);
  }

  /// Chosen points in the unit box.
  Eigen::MatrixXd places() const { return U_(chosen_, Eigen::all); }

  double penalty_at(const Eigen::RowVectorXd& u) const {
    double factor = 1;
    for (std::size_t k = 0; k < chosen_.size(); ++k)
      if (std::isfinite(room_[k]) && room_[k] > 0.0)
        factor *= std::min((U_.row(chosen_[k]) - u).squaredNorm() / room_[k], 1.0);
    return factor;
  }

  std::size_t cell_of(Eigen::Index i) const { return static_cast<std::size_t>(cell_[i] + 1); }
  static std::size_t cell_of(const Nearest& run, Eigen::Index i) {
    return static_cast<std::size_t>(run.site[static_cast<std::size_t>(i)] + 1);
  }

  bool eligible(Eigen::Index i, const Eigen::VectorXd& score) const {
    const bool closed = options_.rule == BatchRule::cells && used_[cell_of(i)];
    return !closed && nearest_.squared_distance[i] > 0.0 && !std::isnan(score[i]);
  }

  /// -1 when no candidate is left.
  Eigen::Index best_candidate(const Eigen::VectorXd& score) {
    Eigen::Index best = best_eligible(score);
    if (best >= 0 || options_.rule != BatchRule::cells) return best;
    std::fill(used_.begin(), used_.end(), 0);
    return best_eligible(score);
  }

  /// What counts of a candidate's score, by the rule.
  double standing_of(Eigen::Index i, const Eigen::VectorXd& score, double lowest) const {
    return options_.rule == BatchRule::penalty ? (score[i] - lowest) * penalty_[i] : score[i];
  }

  Eigen::Index best_eligible(const Eigen::VectorXd& score) const {
    const double lowest = lowest_finite(score);
    Eigen::Index best = -1;
    double highest = 0;
    for (Eigen::Index i = 0; i < score.size(); ++i) {
      if (!eligible(i, score)) continue;
      const double s = standing_of(i, score, lowest);
      if (best < 0 || s > highest ||
          (s == highest && nearest_.squared_distance[i] > nearest_.squared_distance[best]))
        best = i, highest = s;
    }
    return best;
  }

  static double lowest_finite(const Eigen::VectorXd& score) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const double s : score)
      if (std::isfinite(s)) lowest = std::min(lowest, s);
    return std::isfinite(lowest) ? lowest : 0.0;
  }

  void accept(Eigen::Index i) {
    chosen_.push_back(i);
    used_[cell_of(i)] = 1;
    const Eigen::VectorXd squared = (U_.rowwise() - U_.row(i)).rowwise().squaredNorm();
    const double r2 = nearest_.squared_distance[i];
    room_.push_back(r2);
    if (std::isfinite(r2) && r2 > 0.0) penalty_.array() *= (squared.array() / r2).min(1.0);
    nearest_.squared_distance = nearest_.squared_distance.cwiseMin(squared);
    if (options_.rule != BatchRule::believer) return;
    const Eigen::VectorXd x = X_.row(i).transpose();
    Outcome expected = checked(options_.believe(x), runs_.problem);
    runs_.rows.push_back({next_run(), 0, 0, x, std::move(expected), 0.0});
  }

  std::int64_t next_run() const {
    std::int64_t next = 0;
    for (const Evaluation& row : runs_.rows) next = std::max(next, row.run + 1);
    return next;
  }

  Evaluations runs_;
  const ProposeOptions& options_;
  Eigen::MatrixXd X_, U_, sites_;  // candidates in both units; runs in the unit box
  Nearest nearest_;
  std::vector<int> cell_;
  Eigen::VectorXd penalty_;
  std::vector<char> used_;
  std::vector<Eigen::Index> chosen_;
  std::vector<double> room_;  // squared distance of each chosen point to its nearest run, when chosen
};

}  // namespace drawpoint::doe::detail
