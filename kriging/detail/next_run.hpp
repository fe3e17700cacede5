// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Where a search for the optimum runs next.
///
/// Two runs of three go where most improvement is expected, times the probability of keeping all limits and of
/// success: expected improvement of one objective, its knowledge gradient where runs are noisy and nothing is
/// limited, hypervolume improvement of several objectives. The third goes where the models expect the best, as
/// does each of the last two. Up to ten runs per variable of one exact objective alone, the second of the three, and
/// the first too once the best run is old, is chosen near that run (near_best.hpp). While no run keeps all limits,
/// their probability alone counts. Candidates are random points of the box and of the neighbourhood of the best runs;
/// doe::propose climbs from the best.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <drawpoint/doe/propose.hpp>
#include <drawpoint/kriging/acquisition_gradient.hpp>
#include <drawpoint/kriging/acquisition_hypervolume.hpp>
#include <drawpoint/kriging/detail/near_best.hpp>
#include <drawpoint/kriging/detail/optimum_search.hpp>
#include <drawpoint/kriging/detail/searched_models.hpp>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// ln of the probability of keeping all limits and of success.
inline doe::Criterion log_probability_of_use(const SearchedModels& s) {
  return [models = s.models(), responses = s.problem.responses,
          success = s.success](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    Eigen::VectorXd score = Eigen::VectorXd::Zero(X.rows());
    for (std::size_t j = 0; j < models.size(); ++j) {
      if (!doe::is_constraint(responses[j].goal)) continue;
      const Prediction p = models[j].predict(X);
      const double sign = doe::sign_of(responses[j].goal);
      for (Eigen::Index i = 0; i < score.size(); ++i) {
        const double slack = sign * (responses[j].limit - p.mean[i]), deviation = std::sqrt(p.variance[i]);
        const double least = 1e-9 * (std::abs(responses[j].limit) + std::abs(p.mean[i])) + 1e-300;
        score[i] += log_normal_probability(slack / std::max(deviation, least));
      }
    }
    if (!success) return score;
    const Eigen::VectorXd p = success->probability(X);
    for (Eigen::Index i = 0; i < score.size(); ++i) score[i] += std::log(std::max(p[i], 1e-300));
    return score;
  };
}

inline doe::Criterion sum_of(doe::Criterion a, doe::Criterion b) {
  return [a = std::move(a), b = std::move(b)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    return a(X) + b(X);
  };
}

inline doe::Criterion logarithm_of(doe::Criterion a) {
  return [a = std::move(a)](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    Eigen::VectorXd score = a(X);
    for (double& s : score) s = std::log(std::max(s, 1e-300));
    return score;
  };
}

/// The means of a model, as if they were certain.
struct CertainModel {
  Model model;
  Prediction predict(const Eigen::MatrixXd& X, Target = Target::latent) const {
    return {model.mean(X), Eigen::VectorXd::Zero(X.rows())};
  }
  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const { return model.mean(X); }
};

/// What is to be improved on, every objective minimised.
struct Incumbents {
  std::vector<Eigen::Index> objectives;  ///< columns of SearchedModels::Z
  Eigen::VectorXd sign;
  std::vector<Eigen::Index>
      runs;  ///< the best, or the front, of the feasible runs; else the least infeasible one
  bool feasible = false;
};

/// The objectives of the runs, every one minimised: n x objectives.
inline Eigen::MatrixXd minimised(const SearchedModels& s, const Incumbents& by) {
  Eigen::MatrixXd Y(s.Z.rows(), by.sign.size());
  for (Eigen::Index k = 0; k < Y.cols(); ++k)
    Y.col(k) = affine(s.Z.col(by.objectives[static_cast<std::size_t>(k)]), by.sign[k]);
  return Y;
}

inline Incumbents incumbents_of(const SearchedModels& s) {
  Incumbents best;
  std::vector<double> signs;
  for (std::size_t j = 0; j < s.responses.size(); ++j) {
    if (!doe::is_objective(s.problem.responses[j].goal)) continue;
    best.objectives.push_back(static_cast<Eigen::Index>(j));
    signs.push_back(doe::sign_of(s.problem.responses[j].goal));
  }
  best.sign = Eigen::Map<const Eigen::VectorXd>(signs.data(), static_cast<Eigen::Index>(signs.size()));
  const std::vector<Eigen::Index> feasible = s.feasible();
  best.feasible = !feasible.empty();
  best.runs = front_rows(minimised(s, best), feasible);
  if (best.feasible) return best;
  Eigen::Index least = 0;
  for (Eigen::Index i = 1; i < s.Z.rows(); ++i)
    if (s.violation(i) < s.violation(least)) least = i;
  best.runs = {least};
  return best;
}

/// The models' means of one objective, and beyond any of them where a limit is rather broken than kept.
inline doe::Criterion expected_best(const SearchedModels& s, const Incumbents& best) {
  const auto j = static_cast<std::size_t>(best.objectives.front());
  const Eigen::VectorXd z = affine(s.Z.col(best.objectives.front()), best.sign[0]);
  const double range = largest_entry(z) - smallest_entry(z) + std::abs(largest_entry(z)) + 1e-300;
  return [model = s.responses[j].model, sign = best.sign[0], use = log_probability_of_use(s),
          barrier = largest_entry(z) + 1e6 * range, range](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
    Eigen::VectorXd score = affine(model.mean(X), -sign);
    const Eigen::VectorXd kept = use(X);
    for (Eigen::Index i = 0; i < score.size(); ++i)
      if (kept[i] < std::log(0.5)) score[i] = -barrier + range * kept[i];
    return score;
  };
}

inline doe::Criterion most_improvement(const SearchedModels& s, const Incumbents& best, bool expect) {
  const doe::Criterion use = log_probability_of_use(s);
  if (!best.feasible || best.objectives.empty()) return use;
  if (best.objectives.size() > 1) {
    const FrontView front = front_view(minimised(s, best), best.sign, best.runs);
    if (!expect)
      return sum_of(logarithm_of(expected_hypervolume_improvement(s.problem, s.models(), front)), use);
    std::vector<CertainModel> certain;
    for (const SearchedResponse& r : s.responses) certain.push_back({r.model});
    return sum_of(logarithm_of(expected_hypervolume_improvement(s.problem, certain, front)), use);
  }
  const auto j = static_cast<std::size_t>(best.objectives.front());
  const doe::Goal goal = s.problem.responses[j].goal;
  const Model& model = s.responses[j].model;
  const bool limited = s.problem.responses.size() > 1;
  if (!s.exact && !limited) return sum_of(log_knowledge_gradient(model, goal), use);
  if (expect) return expected_best(s, best);
  const double value = s.Z(best.runs.front(), best.objectives.front());
  return sum_of(log_expected_improvement(reinterpolated(model), goal, value), use);
}

/// One coordinate near x: a step of `share` of its range, of at least one for whole numbers, any level.
inline double neighbour(double x, const doe::Variable& v, double share, doe::RandomStream& random) {
  const double step = share * (v.upper - v.lower) * random.normal();
  if (v.kind == doe::VariableKind::real) return std::clamp(x + step, v.lower, v.upper);
  if (v.kind == doe::VariableKind::integer)
    return std::clamp(x + std::round(step) + (random.uniform() < 0.5 ? -1.0 : 1.0), v.lower, v.upper);
  return v.lower + std::floor(random.uniform() * (v.upper - v.lower + 1.0) * 0.999999);
}

/// `count` points around the best runs, from a third to 3e-4 of the box away: count x d.
inline Eigen::MatrixXd neighbours(const SearchedModels& s, const std::vector<Eigen::Index>& best,
                                  Eigen::Index count, doe::Seed seed) {
  doe::RandomStream random(seed);
  Eigen::MatrixXd P(count, s.X.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto pick = std::min<std::size_t>(
        static_cast<std::size_t>(random.uniform() * static_cast<double>(best.size())), best.size() - 1);
    const double share = 0.3 * std::pow(10.0, -3.0 * random.uniform());
    for (Eigen::Index k = 0; k < P.cols(); ++k) {
      const doe::Variable& v = s.problem.variables[static_cast<std::size_t>(k)];
      const double x = s.X(best[pick], k);
      const double moves = v.kind == doe::VariableKind::real ? 0.6 : 0.3;
      P(i, k) = random.uniform() < moves ? neighbour(x, v, share, random) : x;
    }
  }
  return P;
}

inline std::optional<Eigen::VectorXd> point_of(const doe::Evaluations& taken, const doe::Criterion& criterion,
                                               const doe::ProposeOptions& options) {
  const doe::Sampler sampler = [&](const doe::Evaluations&) { return criterion; };
  const Eigen::MatrixXd X = doe::propose(taken, sampler, options);
  if (X.rows() == 0) return {};
  return X.row(0).transpose();
}

/// Whether a run after the first design is chosen near the best one, which was made `age` runs ago.
inline bool goes_near_best(const SearchedModels& s, std::int64_t after_first, Eigen::Index age) {
  constexpr Eigen::Index few = 10;  // runs per variable: more of them tell where else to look
  if (!s.exact || s.success || s.problem.responses.size() > 1 || s.X.rows() >= few * s.X.cols()) return false;
  return after_first % 3 == 1 || age > 2 * s.X.cols();
}

/// The most improvement in the region of the best run; nothing where every point there has been run.
inline std::optional<Eigen::VectorXd> point_near_best(const doe::Evaluations& taken, const SearchedModels& s,
                                                      const Incumbents& best, Eigen::Index age,
                                                      const NextRun& by) {
  const NearBest region(s.problem.variables, s.X.row(best.runs.front()).transpose(),
                        static_cast<double>(age));
  doe::ProposeOptions options{.seed = by.seed, .candidates = 1};
  options.beside = region.points(2000, doe::run_seed(by.seed, taken.rows.size(), 7));
  options.allowed = [&](const Eigen::VectorXd& x) {
    return region.contains(x) && (!by.allowed || by.allowed(x));
  };
  return point_of(taken, most_improvement(s, best, false), options);
}

DRAWPOINT_KRIGING_INLINE std::optional<Eigen::VectorXd> next_run(const doe::Evaluations& ended,
                                                                 const Eigen::MatrixXd& pending,
                                                                 const NextRun& by) {
  doe::Evaluations taken = ended;  // no run is asked for where one is under way
  for (const auto& x : pending.rowwise())
    taken.rows.push_back({0, 0, 0, x.transpose(), doe::Failure{"pending"}, 0.0});
  doe::ProposeOptions options{.seed = by.seed, .candidates = 2000};
  options.allowed = by.allowed;
  if (ended.failed() == static_cast<int>(ended.rows.size()))
    return point_of(taken, doe::distance_to_runs(taken), options);
  const SearchedModels models = searched_models(ended, pending);
  const Incumbents best = incumbents_of(models);
  const bool expect = by.after_first % 3 == 2 || by.left <= 2;
  const Eigen::Index age = models.X.rows() - 1 - best.runs.front();
  if (!expect && goes_near_best(models, by.after_first, age))
    if (auto x = point_near_best(taken, models, best, age, by)) return x;
  options.beside = neighbours(models, best.runs, 1000, doe::run_seed(by.seed, taken.rows.size(), 7));
  return point_of(taken, most_improvement(models, best, expect), options);
}

}  // namespace drawpoint::kriging::detail
