// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The next points to run: the best of many random candidates, one after the other, kept apart.
///
/// A candidate is never where a run is already. Among candidates with equal scores, as all of one Voronoi
/// cell have, the one farthest from every run and from the points chosen before it wins (largest minimum
/// distance in the unit box), as LOLA-Voronoi places its points. How a batch is kept apart, with cells those
/// of the runs so far:
///   cells     a cell gives one point, until every cell has given one: the paper's rule
///   penalty   scores, counted from the lowest, are multiplied by min(1, |x − c|²/r²) for each chosen c; r is
///             how far c was from its nearest run. No cell limits it: for scores that vary within cells
///   believer  the sampler is asked anew after each choice, with the outcome that `believe` expects there
/// Cost O(candidates · (n + batch) · d) and the sampler's. Equal runs, options and seed give equal bits.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/criterion.hpp>
#include <drawpoint/doe/detail/nearest.hpp>
#include <drawpoint/doe/detail/sites.hpp>
#include <drawpoint/doe/detail/unit_box.hpp>
#include <drawpoint/doe/detail/voronoi.hpp>

namespace drawpoint::doe {

enum class BatchRule { cells, penalty, believer };

struct ProposeOptions {
  Seed seed = 1;  ///< of the candidates, together with the number of rows of the table
  int batch = 1;  ///< points to choose, 1 or more
  /// Random points to choose from, 1 or more; empty: 100 per run, within 1000 to 20000: enough for the best
  /// of each cell.
  std::optional<int> candidates = {};
  BatchRule rule = BatchRule::cells;
  /// What a run at x (natural units) would give, for BatchRule::believer: a surrogate's mean, say.
  std::function<Outcome(const Eigen::VectorXd& x)> believe{};
  Allowed allowed{};  ///< candidates are drawn where it holds; empty: the whole box
};

namespace detail {

inline void check_propose(const ProposeOptions& options) {
  const auto reject = [](const std::string& what) { throw std::invalid_argument("doe::propose: " + what); };
  if (options.batch < 1)
    reject("batch is " + std::to_string(options.batch) +
           "; allowed is 1 or more; ask for at least one point");
  if (options.candidates && *options.candidates < 1)
    reject("candidates is " + std::to_string(*options.candidates) +
           "; allowed is 1 or more; leave it out for 100 per run");
  if (options.rule == BatchRule::believer && !options.believe)
    reject("rule is believer, but believe is empty; give what a run at x would give");
}

/// Chooses points one by one from a fixed set of candidates.
class Chooser {
 public:
  Chooser(const Evaluations& runs, const ProposeOptions& options)
      : runs_(runs), options_(options), X_(candidates()), U_(to_unit_box(X_, runs.problem)) {
    Eigen::MatrixXd sites(static_cast<Eigen::Index>(runs.rows.size()), U_.cols());
    for (std::size_t i = 0; i < runs.rows.size(); ++i)
      sites.row(static_cast<Eigen::Index>(i)) = runs.rows[i].x;
    nearest_ = nearest_sites(U_, to_unit_box(std::move(sites), runs.problem));
    cell_ = nearest_.site;
    penalty_ = Eigen::VectorXd::Ones(U_.rows());
    used_.assign(runs.rows.size() + 1, 0);
  }

  /// `count` more points by the sampler, fewer when the candidates run out.
  void choose(const Sampler& sampler, int count) {
    Eigen::VectorXd score = scores(sampler);
    for (int k = 0; k < count; ++k) {
      const Eigen::Index best = best_candidate(score);
      if (best < 0) return;
      accept(best);
      if (options_.rule == BatchRule::believer && k + 1 < count) score = scores(sampler);
    }
  }

  /// Natural units, one per row.
  Eigen::MatrixXd chosen() const {
    Eigen::MatrixXd X(static_cast<Eigen::Index>(chosen_.size()), X_.cols());
    for (std::size_t k = 0; k < chosen_.size(); ++k) X.row(static_cast<Eigen::Index>(k)) = X_.row(chosen_[k]);
    return X;
  }

 private:
  Eigen::MatrixXd candidates() const {
    const int automatic = std::clamp(100 * static_cast<int>(runs_.rows.size()), 1000, 20000);
    std::uint64_t counter = 0;
    return allowed_points(runs_.problem, options_.allowed, run_seed(options_.seed, runs_.rows.size(), 1),
                          options_.candidates.value_or(automatic), counter);
  }

  Eigen::VectorXd scores(const Sampler& sampler) const {
    Eigen::VectorXd score = sampler(runs_)(X_);
    if (score.size() != X_.rows())
      throw std::invalid_argument("doe::propose: the criterion gave " + std::to_string(score.size()) +
                                  " scores for " + std::to_string(X_.rows()) +
                                  " points; give one score a row of X");
    return score;
  }

  std::size_t cell_of(Eigen::Index i) const { return static_cast<std::size_t>(cell_[i] + 1); }

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

  Eigen::Index best_eligible(const Eigen::VectorXd& score) const {
    const double lowest = lowest_finite(score);
    Eigen::Index best = -1;
    double highest = 0;
    for (Eigen::Index i = 0; i < score.size(); ++i) {
      if (!eligible(i, score)) continue;
      const double s = options_.rule == BatchRule::penalty ? (score[i] - lowest) * penalty_[i] : score[i];
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
    if (std::isfinite(r2)) penalty_.array() *= (squared.array() / r2).min(1.0);
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
  Eigen::MatrixXd X_, U_;
  Nearest nearest_;
  std::vector<int> cell_;
  Eigen::VectorXd penalty_;
  std::vector<char> used_;
  std::vector<Eigen::Index> chosen_;
};

inline int distinct_points(const Evaluations& runs) {
  int sites = 0;
  site_of_rows(runs, sites);
  return sites;
}

}  // namespace detail

/// Points for the next runs, natural units, batch x d; fewer rows when the candidates run out, as they do
/// where `allowed` hardly ever holds. `sampler` is a sampler (criterion.hpp) or a Mix of them. Throws
/// std::invalid_argument for options out of range and for a criterion that miscounts.
template <class S>
Eigen::MatrixXd propose(const Evaluations& runs, S&& sampler, const ProposeOptions& options = {}) {
  using Given = std::remove_reference_t<S>;
  check(runs.problem);
  detail::check_propose(options);
  detail::Chooser chooser(runs, options);
  if constexpr (std::same_as<std::remove_const_t<Given>, Mix>) {
    const std::vector<int> turns = sampler.turns(detail::distinct_points(runs), options.batch);
    for (std::size_t k = 0; k < turns.size(); ++k)
      if (turns[k] > 0) chooser.choose(sampler.parts()[k].sampler, turns[k]);
  } else {
    require_sampler<Given>();
    if constexpr (SamplerFunction<Given>)
      chooser.choose([&sampler](const Evaluations& so_far) -> Criterion { return sampler(so_far); },
                     options.batch);
  }
  return chooser.chosen();
}

}  // namespace drawpoint::doe
