// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// LOLA-Voronoi: run more where the response bends and where there are holes.
///
/// Each site has the relative volume V of its Voronoi cell (voronoi.hpp, Σ V = 1) and the non-linearity E of
/// its neighbourhood (neighbourhood.hpp, nonlinearity.hpp), here as a share of Σ E. A candidate has the score
/// of the cell it lies in:
///   sum       H = V + E/ΣE                 the paper
///   weighted  H = w V + (1 − w) E/ΣE       OpenTURNS with w = ½; w = 1 is Voronoi sampling
/// With several responses E is their largest or their average, each divided by its range. Where ΣE = 0, as
/// for a plane, holes alone count. Failed sites have E = 0 and still take up space. Inputs are scaled to the
/// unit box. Cost O(n² (d + 4d²)) for n sites once, O(n) a new site after that, plus 100 test points a site.
/// Equal runs and seed give equal bits, whether the table grew at once or batch by batch.
/// Source: Crombecq, Gorissen, Deschrijver, Dhaene 2011, SIAM J. Sci. Comput. 33(4), 1948-1974.

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/criterion.hpp>
#include <drawpoint/doe/detail/neighbourhood.hpp>
#include <drawpoint/doe/detail/nonlinearity.hpp>
#include <drawpoint/doe/detail/sites.hpp>
#include <drawpoint/doe/detail/voronoi.hpp>

namespace drawpoint::doe {

enum class Hybrid { sum, weighted };
enum class Combine { largest, average };

struct LolaVoronoiOptions {
  Seed seed = 1;  ///< of the test points
  Hybrid hybrid = Hybrid::sum;
  double voronoi_weight = 0.5;           ///< w, 0 to 1, of Hybrid::weighted; large: fill space
  std::vector<std::string> responses{};  ///< names; empty: objectives and constraints, or all if none
  Combine combine = Combine::largest;    ///< of several responses; average when no one may dominate
  int points_per_site = 100;             ///< >= 1: volumes to a tenth; the cost is proportional
  Allowed allowed{};                     ///< empty: the whole box; else cells are counted inside alone
};

/// What the score is made of, one entry a site.
struct LolaVoronoiScores {
  Eigen::MatrixXd U;          ///< sites in the unit box, in order of first appearance in the table
  std::vector<char> ok;       ///< whether a run succeeded there
  Eigen::VectorXd volume;     ///< V, sum 1
  Eigen::VectorXd nonlinear;  ///< E/ΣE, sum 1, or all 0
  Eigen::VectorXd hybrid;     ///< H
};

/// A sampler: lola(runs) is the criterion. It remembers the sites, so that a batch costs what is new in it;
/// runs of another problem or in another order start it anew.
class LolaVoronoi {
 public:
  /// Throws std::invalid_argument for an option out of its range.
  explicit LolaVoronoi(LolaVoronoiOptions options = {}) : options_(std::move(options)) {
    if (!(options_.voronoi_weight >= 0.0 && options_.voronoi_weight <= 1.0))
      throw std::invalid_argument("doe::LolaVoronoi: voronoi_weight is " +
                                  detail::number_text(options_.voronoi_weight) +
                                  "; allowed is 0 to 1; 1 fills space and 0 follows the non-linearity");
    if (options_.points_per_site < 1)
      throw std::invalid_argument("doe::LolaVoronoi: points_per_site is " +
                                  std::to_string(options_.points_per_site) +
                                  "; allowed is 1 or more; 100 gives volumes to a tenth");
  }

  /// Throws std::invalid_argument on an unknown response and without runs.
  LolaVoronoiScores scores(const Evaluations& runs) {
    const detail::Sites sites =
        detail::distinct_sites(runs, detail::chosen_responses(runs.problem, options_.responses));
    if (sites.U.rows() == 0)
      throw std::invalid_argument(
          "doe::LolaVoronoi: the table has 0 runs; allowed is 1 or more; evaluate an initial design first");
    follow(runs.problem, sites.U);
    LolaVoronoiScores scores{sites.U, sites.ok, cells_->volumes(), Eigen::VectorXd::Zero(sites.U.rows()), {}};
    if (!fills_space_only()) scores.nonlinear = shares_of_nonlinearity(sites);
    scores.hybrid = hybrid(scores.volume, scores.nonlinear);
    return scores;
  }

  Criterion operator()(const Evaluations& runs) {
    return [problem = runs.problem, found = scores(runs)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
      const auto cell = detail::nearest_sites(detail::to_unit_box(X, problem), found.U).site;
      Eigen::VectorXd score(X.rows());
      for (Eigen::Index i = 0; i < X.rows(); ++i) score[i] = found.hybrid[cell[static_cast<std::size_t>(i)]];
      return score;
    };
  }

 private:
  bool fills_space_only() const {
    return options_.hybrid == Hybrid::weighted && options_.voronoi_weight == 1.0;
  }

  static bool continues(const Eigen::MatrixXd& known, const Eigen::MatrixXd& now) {
    return known.cols() == now.cols() && known.rows() <= now.rows() && known == now.topRows(known.rows());
  }

  /// Takes up the sites that are new.
  void follow(const Problem& problem, const Eigen::MatrixXd& U) {
    if (!cells_ || !continues(known_, U)) {
      cells_.emplace(problem, options_.allowed, options_.seed);
      known_.resize(0, U.cols());
      neighbourhoods_.reset();
    }
    const Eigen::Index fresh = U.rows() - known_.rows();
    cells_->add_sites(U.bottomRows(fresh));
    cells_->ensure_points(std::max<Eigen::Index>(least_points, options_.points_per_site * U.rows()));
    known_ = U;
  }

  /// Neighbourhoods are of the sites that have a response: brought up to date, or built anew when a site that
  /// had failed has succeeded since.
  void follow_neighbours(const Eigen::MatrixXd& U, const std::vector<int>& good) {
    const bool goes_on = neighbourhoods_ && good_.size() <= good.size() &&
                         std::equal(good_.begin(), good_.end(), good.begin());
    if (!goes_on) {
      neighbourhoods_.emplace(U.cols());
      good_.clear();
    }
    for (std::size_t k = good_.size(); k < good.size(); ++k) neighbourhoods_->add(U.row(good[k]).transpose());
    good_ = good;
  }

  Eigen::VectorXd shares_of_nonlinearity(const detail::Sites& sites) {
    std::vector<int> good;
    for (std::size_t i = 0; i < sites.ok.size(); ++i)
      if (sites.ok[i]) good.push_back(static_cast<int>(i));
    Eigen::VectorXd share = Eigen::VectorXd::Zero(sites.U.rows());
    if (good.empty()) return share;
    follow_neighbours(sites.U, good);
    for (std::size_t k = 0; k < good.size(); ++k) {
      const Eigen::VectorXd e = nonlinearity_of(sites, good, static_cast<int>(k));
      share[good[k]] = options_.combine == Combine::largest ? e.maxCoeff() : e.mean();
    }
    return share.sum() > round_off ? Eigen::VectorXd(share / share.sum()) : Eigen::VectorXd(0.0 * share);
  }

  Eigen::VectorXd nonlinearity_of(const detail::Sites& sites, const std::vector<int>& good, int k) const {
    const std::vector<int>& members = neighbourhoods_->of(k);
    const auto m = static_cast<Eigen::Index>(members.size());
    Eigen::MatrixXd P(m, sites.U.cols()), dY(m, sites.Y.cols());
    for (Eigen::Index i = 0; i < m; ++i) {
      const int other = good[static_cast<std::size_t>(members[static_cast<std::size_t>(i)])];
      P.row(i) = sites.U.row(other) - sites.U.row(good[static_cast<std::size_t>(k)]);
      dY.row(i) = sites.Y.row(other) - sites.Y.row(good[static_cast<std::size_t>(k)]);
    }
    return nonlinearity(P, dY);
  }

  Eigen::VectorXd hybrid(const Eigen::VectorXd& V, const Eigen::VectorXd& E) const {
    if (options_.hybrid == Hybrid::sum) return V + E;
    return options_.voronoi_weight * V + (1.0 - options_.voronoi_weight) * E;
  }

  static constexpr Eigen::Index least_points = 1000;
  /// The ΣE, with responses of range 1, up to which E is only round-off, as of a plane.
  static constexpr double round_off = 1e-10;

  LolaVoronoiOptions options_;
  std::optional<VoronoiCells> cells_;
  std::optional<Neighbourhoods> neighbourhoods_;
  Eigen::MatrixXd known_;
  std::vector<int> good_;
};

struct VoronoiOptions {
  Seed seed = 1;              ///< of the test points
  int points_per_site = 100;  ///< >= 1, as in LolaVoronoiOptions
  Allowed allowed{};          ///< likewise
};

/// Voronoi sampling: the largest cell, whatever the response. Throws std::invalid_argument for an option out
/// of its range.
inline LolaVoronoi voronoi_sampler(VoronoiOptions options = {}) {
  return LolaVoronoi({.seed = options.seed,
                      .hybrid = Hybrid::weighted,
                      .voronoi_weight = 1.0,
                      .points_per_site = options.points_per_site,
                      .allowed = std::move(options.allowed)});
}

}  // namespace drawpoint::doe
