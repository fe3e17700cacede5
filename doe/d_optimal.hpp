// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// D-optimal designs: the runs that fix the coefficients of a given polynomial best, for any number of runs,
/// any kinds of variables, part of the box, and runs that there are already.
///
/// With F the n x p model matrix (model_terms.hpp) of all runs, present ones included, det(FᵀF) is maximised:
/// the volume of the confidence region of the coefficients is least. By coordinate exchange: from random
/// points, entry after entry of row after row takes the level that raises the determinant most, until a pass
/// changes nothing; the best of several starts. One exchange of row f for g changes the determinant by the
/// factor (1 + gᵀDg)(1 − fᵀDf) + (gᵀDf)², D = (FᵀF)⁻¹. Cost O(n d levels p²) per pass.
///
/// `efficiency` is a bound from below on how close the design comes to the best for any number of runs: with
/// M = FᵀF/n and M* of that best, (det M/det M*)^(1/p) >= p / max_x f(x)ᵀM⁻¹f(x) by the inequality of the
/// means and tr(M⁻¹M*) <= max f(x)ᵀM⁻¹f(x); the maximum is over the grid of levels, some 20 000 points of it
/// at most. A design for a polynomial has its runs at bounds and middles, several at one point: good for
/// screening and response surfaces, poor for a Kriging model. Sources: Meyer, Nachtsheim 1995, Technometrics
/// 37(1) (coordinate exchange); Fedorov 1972 (the factor); Atkinson, Donev, Tobias 2007 (efficiency).

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/model_terms.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe {

struct DOptimalOptions {
  Seed seed = 1;  ///< of the starts
  ModelTerms terms = ModelTerms::quadratic;
  /// Runs that there are already, k x d inside the box; they count and are not returned.
  Eigen::MatrixXd present = {};
  /// Where runs are allowed, natural units; empty: everywhere. With one, take more levels.
  std::function<bool(const Eigen::VectorXd&)> allowed = {};
  int levels = 3;  ///< of a variable with an order, evenly from bound to bound, 2 to 101; 2 do for no squares
  int starts = 20;  ///< 1 or more; each ends in an optimum of its own
};

enum class DOptimalStatus {
  found,
  singular,   ///< no design was found that fixes all coefficients: too few allowed points
  no_points,  ///< random levels were not allowed, 10 000 times: nothing is returned
};

inline std::string_view to_string(DOptimalStatus status) {
  switch (status) {
    case DOptimalStatus::found:
      return "found";
    case DOptimalStatus::singular:
      return "singular";
    case DOptimalStatus::no_points:
      return "no_points";
  }
  return "unknown";
}

struct DOptimalDesign {
  Eigen::MatrixXd X;  ///< n x d, natural units
  DOptimalStatus status = DOptimalStatus::found;
  std::string message = {};  ///< empty when found
  double determinant = 0;    ///< det(FᵀF/n)^(1/p) of all runs
  double efficiency = 0;  ///< at least this share of the best determinant for any number of runs; see above
};

namespace detail {

inline void check_d_optimal(const Problem& problem, int runs, const DOptimalOptions& options) {
  const auto reject = [](const std::string& what) { throw std::invalid_argument("doe::d_optimal: " + what); };
  check_design("doe::d_optimal", problem, runs);
  if (options.present.size() > 0) check_inside(options.present, problem, "doe::d_optimal, present");
  const Eigen::Index p = term_count(problem, options.terms), n = runs + options.present.rows();
  if (n < p)
    reject(std::to_string(n) + " runs for the " + std::to_string(p) + " coefficients of " +
           std::string(to_string(options.terms)) + " terms; allowed is " + std::to_string(p) +
           " or more, present ones included; add runs or take fewer terms");
  const int least = options.terms == ModelTerms::quadratic ? 3 : 2;
  if (options.levels < least || options.levels > 101)
    reject("levels is " + std::to_string(options.levels) + "; allowed is " + std::to_string(least) +
           " to 101 with " + std::string(to_string(options.terms)) + " terms; 3 are usual");
  if (options.starts < 1)
    reject("starts is " + std::to_string(options.starts) + "; allowed is 1 or more; 20 are usual");
}

/// The values that each variable may take.
inline std::vector<std::vector<double>> levels_of(const Problem& problem, int levels) {
  std::vector<std::vector<double>> values;
  for (const Variable& v : problem.variables) {
    const int count = is_discrete(v) && (v.kind == VariableKind::categorical || value_count(v) < levels)
                          ? static_cast<int>(value_count(v))
                          : levels;
    auto& of = values.emplace_back();
    for (int k = 0; k < count; ++k) {
      const double x = v.lower + (v.upper - v.lower) * k / (count - 1);
      of.push_back(is_discrete(v) ? std::round(x) : x);
    }
  }
  return values;
}

/// One start of the search.
class CoordinateExchange {
 public:
  CoordinateExchange(const Problem& problem, const DOptimalOptions& options,
                     const std::vector<std::vector<double>>& levels)
      : problem_(problem), options_(options), levels_(levels) {}

  /// False when no allowed point was found.
  bool start(int runs, RandomStream& random) {
    X_.resize(runs, static_cast<Eigen::Index>(levels_.size()));
    Eigen::VectorXd x(X_.cols());
    for (Eigen::Index i = 0; i < runs; ++i) {
      int tries = 0;
      do {
        if (++tries > 10'000) return false;
        for (std::size_t j = 0; j < levels_.size(); ++j)
          x[static_cast<Eigen::Index>(j)] =
              levels_[j][static_cast<std::size_t>(random.below(static_cast<int>(levels_[j].size())))];
      } while (!allowed(x));
      X_.row(i) = x.transpose();
    }
    F_ = model_matrix(problem_, X_, options_.terms);
    present_ = Eigen::MatrixXd::Zero(F_.cols(), F_.cols());
    if (options_.present.size() > 0) {
      const Eigen::MatrixXd F = model_matrix(problem_, options_.present, options_.terms);
      present_ = F.transpose() * F;
    }
    return true;
  }

  /// Until a pass changes nothing. A random start may be singular: the first passes are made with a little
  /// added to the diagonal, which is taken off in steps, so that terms that hardly vary where runs are allowed
  /// count too.
  void climb() {
    for (const double ridge : {1e-3, 1e-6, 1e-9, 0.0}) {
      ridge_ = ridge;
      if (!invert()) return;
      while (pass()) {
      }
    }
  }

  const Eigen::MatrixXd& X() const { return X_; }
  Eigen::MatrixXd information() const { return present_ + F_.transpose() * F_; }

 private:
  bool allowed(const Eigen::VectorXd& x) const { return !options_.allowed || options_.allowed(x); }

  bool invert() {
    const Eigen::Index p = F_.cols();
    const Eigen::LDLT<Eigen::MatrixXd> factors(information() + ridge_ * Eigen::MatrixXd::Identity(p, p));
    // Below this the reciprocal condition is round-off of some tens of terms.
    if (factors.info() != Eigen::Success || !(factors.rcond() > 1e-12)) return false;
    inverse_ = factors.solve(Eigen::MatrixXd::Identity(p, p));
    return true;
  }

  bool pass() {
    bool changed = false;
    for (Eigen::Index i = 0; i < X_.rows(); ++i)
      for (Eigen::Index j = 0; j < X_.cols(); ++j) changed = exchange(i, j) || changed;
    return changed;
  }

  /// Entry j of row i takes its best level. A gain below 1e-9 is round-off, and would go round for ever.
  bool exchange(Eigen::Index i, Eigen::Index j) {
    const Eigen::VectorXd f = F_.row(i).transpose(), Df = inverse_ * f;
    const double fDf = f.dot(Df);
    Eigen::VectorXd x = X_.row(i).transpose(), best_terms;
    double best = 1.0 + 1e-9, best_level = 0.0;
    for (const double level : levels_[static_cast<std::size_t>(j)]) {
      x[j] = level;
      if (level == X_(i, j) || !allowed(x)) continue;
      const Eigen::VectorXd g = terms_at(x, problem_, options_.terms);
      const double gDf = g.dot(Df), factor = (1.0 + g.dot(inverse_ * g)) * (1.0 - fDf) + gDf * gDf;
      if (factor > best) best = factor, best_level = level, best_terms = g;
    }
    if (best_terms.size() == 0) return false;
    X_(i, j) = best_level;
    F_.row(i) = best_terms.transpose();
    return invert();
  }

  const Problem& problem_;
  const DOptimalOptions& options_;
  const std::vector<std::vector<double>>& levels_;
  double ridge_ = 0;
  Eigen::MatrixXd X_, F_, present_, inverse_;
};

/// ln det of a positive definite matrix; -inf when it is not, to round-off.
inline double log_determinant(const Eigen::MatrixXd& M) {
  const Eigen::LDLT<Eigen::MatrixXd> factors(M);
  if (factors.info() != Eigen::Success || !(factors.rcond() > 1e-12))
    return -std::numeric_limits<double>::infinity();
  return factors.vectorD().array().log().sum();
}

/// fᵀM⁻¹f, the variance of a prediction, over the points where runs are allowed.
class PredictionVariance {
 public:
  PredictionVariance(const Problem& problem, const DOptimalOptions& options,
                     const std::vector<std::vector<double>>& levels, const Eigen::MatrixXd& M)
      : problem_(problem), options_(options), levels_(levels), factors_(M) {}

  /// Over the grid of levels where it has 20 000 points or fewer; else what climbs, level by level, from the
  /// runs and from 200 random points reach.
  double largest(const Eigen::MatrixXd& runs) const {
    double grid = 1, largest = 0;
    for (const auto& of : levels_) grid *= static_cast<double>(of.size());
    Eigen::VectorXd x(runs.cols());
    if (grid <= 20'000) {
      for (int point = 0; point < grid; ++point) {
        int rest = point;
        for (std::size_t j = 0; j < levels_.size(); ++j) {
          const int count = static_cast<int>(levels_[j].size());
          x[static_cast<Eigen::Index>(j)] = levels_[j][static_cast<std::size_t>(rest % count)];
          rest /= count;
        }
        largest = std::max(largest, at(x));
      }
      return largest;
    }
    for (Eigen::Index i = 0; i < runs.rows(); ++i)
      largest = std::max(largest, climb(runs.row(i).transpose()));
    RandomStream random(run_seed(options_.seed, 0, 1));
    for (int k = 0; k < 200; ++k) {
      for (std::size_t j = 0; j < levels_.size(); ++j)
        x[static_cast<Eigen::Index>(j)] =
            levels_[j][static_cast<std::size_t>(random.below(static_cast<int>(levels_[j].size())))];
      largest = std::max(largest, climb(x));
    }
    return largest;
  }

 private:
  /// 0 where no run is allowed.
  double at(const Eigen::VectorXd& x) const {
    if (options_.allowed && !options_.allowed(x)) return 0;
    const Eigen::VectorXd f = terms_at(x, problem_, options_.terms);
    return f.dot(factors_.solve(f));
  }

  double climb(Eigen::VectorXd x) const {
    double highest = at(x);
    for (bool rises = true; rises;) {
      rises = false;
      for (std::size_t j = 0; j < levels_.size(); ++j) {
        const auto k = static_cast<Eigen::Index>(j);
        double best = x[k];
        for (const double level : levels_[j]) {
          x[k] = level;
          const double value = at(x);
          if (value <= highest * (1 + 1e-9)) continue;
          highest = value;
          best = level;
          rises = true;
        }
        x[k] = best;
      }
    }
    return highest;
  }

  const Problem& problem_;
  const DOptimalOptions& options_;
  const std::vector<std::vector<double>>& levels_;
  Eigen::LDLT<Eigen::MatrixXd> factors_;
};

}  // namespace detail

/// `runs` new runs. Throws std::invalid_argument for fewer runs than coefficients and options out of range.
/// Equal arguments give equal bits.
inline DOptimalDesign d_optimal(const Problem& problem, int runs, const DOptimalOptions& options = {}) {
  detail::check_d_optimal(problem, runs, options);
  const auto levels = detail::levels_of(problem, options.levels);
  DOptimalDesign design;
  double best = -std::numeric_limits<double>::infinity();
  Eigen::MatrixXd information;
  for (int k = 0; k < options.starts; ++k) {
    RandomStream random(run_seed(options.seed, static_cast<std::uint64_t>(k), 0));
    detail::CoordinateExchange search(problem, options, levels);
    if (!search.start(runs, random))
      return {Eigen::MatrixXd(0, static_cast<Eigen::Index>(levels.size())), DOptimalStatus::no_points,
              "10 000 random combinations of levels were not allowed; take more levels or a wider region"};
    search.climb();
    const double value = detail::log_determinant(search.information());
    if (k > 0 && !(value > best)) continue;
    best = value;
    design.X = search.X();
    information = search.information();
  }
  if (std::isinf(best)) {
    design.status = DOptimalStatus::singular;
    design.message = "no design of " + std::to_string(runs) +
                     " runs on these levels fixes all coefficients; take more levels, fewer terms or a wider "
                     "region";
    return design;
  }
  const auto n = static_cast<double>(runs + options.present.rows());
  const auto p = static_cast<double>(information.rows());
  design.determinant = std::exp(best / p) / n;
  const detail::PredictionVariance variance(problem, options, levels, information / n);
  design.efficiency = std::min(1.0, p / variance.largest(design.X));
  return design;
}

}  // namespace drawpoint::doe
