// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Where the local searches start: the likeliest of many random candidates that are not close to each other.
///
/// A candidate has a common length scale, a factor on it for each variable and a nugget, all log-uniform. The
/// common length grows with √d, as distances in the unit box do; not in a sum, which has none of these. Its
/// weights differ by a factor of up to ten. Interpolation (λ below 1e-4) and noise are
/// two explanations of the same data with separate maxima, so the best candidate of each is always a start.
/// Candidates are ranked on at most 250 runs, evenly picked, where ranking needs no more. Deterministic in
/// the seed. Cost: candidates · min(n, 250)³/3.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/detail/climb.hpp>
#include <drawpoint/kriging/detail/likelihood.hpp>
#include <drawpoint/kriging/options.hpp>
#include <numeric>
#include <vector>

namespace drawpoint::kriging::detail {

inline constexpr double interpolation_nugget = 1e-4;

/// Runs beyond which an evaluation costs more than what it may find.
inline constexpr Eigen::Index many = 250;

inline double log_uniform(doe::RandomStream& random, double lower, double upper) {
  return std::log(lower) + random.uniform() * std::log(upper / lower);
}

/// (ln θ, exponents, weights, ln λ) inside the box. Known noise leaves the process variance to be drawn, in
/// units of the response's.
inline Eigen::VectorXd candidate(doe::RandomStream& random, const Box& box, const ParameterPlaces& places,
                                 double known_noise) {
  const Eigen::Index m = box.lower.size(), of_weights = places.weight(0);
  const auto d = static_cast<double>(places.weights ? 1 : places.variables());
  const double common = log_uniform(random, 0.1, 1.0) + 0.5 * std::log(d);
  Eigen::VectorXd p(m);
  for (Eigen::Index k = 0; k < places.theta_count; ++k)
    p[k] = -std::log(8.0) - 2.0 * (common + log_uniform(random, 0.5, 4.0));
  for (Eigen::Index k = places.theta_count; k < of_weights; ++k) p[k] = 1.5 + 0.49 * random.uniform();
  for (Eigen::Index k = of_weights; k + 1 < m; ++k) p[k] = log_uniform(random, 0.3, 3.0);
  p[m - 1] = known_noise > 0 ? std::log(known_noise) - log_uniform(random, 0.3, 100.0)
                             : log_uniform(random, 1e-8, 0.3);
  return moved(box, p, 0.0, p);
}

/// Evenly picked rows of X (and of y) as a matrix of at most `limit` rows.
inline Eigen::MatrixXd thinned(const Eigen::MatrixXd& X, Eigen::Index limit) {
  const Eigen::Index n = X.rows(), m = std::min(n, limit);
  Eigen::MatrixXd rows(m, X.cols());
  for (Eigen::Index k = 0; k < X.cols(); ++k)
    for (Eigen::Index i = 0; i < m; ++i) rows(i, k) = X(i * n / m, k);
  return rows;
}

struct RankedPoint {
  Eigen::VectorXd p;
  double value = 0;
};

/// Places of the values from the highest down; equal ones keep their order.
inline std::vector<int> ranking(const std::vector<double>& values) {
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return values[a] > values[b] || (values[a] == values[b] && a < b); });
  return order;
}

/// Best first; ties keep the order of drawing.
inline std::vector<RankedPoint> ranked_candidates(Likelihood& likelihood, const Box& box, int count,
                                                  doe::Seed seed) {
  doe::RandomStream random(seed);
  std::vector<RankedPoint> all(count), ranked;
  std::vector<double> values;
  for (RankedPoint& c : all) {
    c.p = candidate(random, box, likelihood.places(), likelihood.problem().known_noise);
    c.value = likelihood.value(c.p);
    values.push_back(c.value);
  }
  for (const int i : ranking(values)) ranked.push_back(all[i]);
  return ranked;
}

/// Those that lie apart from all better ones: on average e apart or more in each θ, e³ in λ.
inline std::vector<RankedPoint> kept_apart(const std::vector<RankedPoint>& ranked) {
  std::vector<RankedPoint> kept;
  for (const RankedPoint& c : ranked) {
    const Eigen::Index d = c.p.size() - 1;
    const bool apart = std::all_of(kept.begin(), kept.end(), [&](const RankedPoint& other) {
      const Eigen::VectorXd step = difference(c.p, other.p);
      return dot(step.data(), step.data(), d) + step[d] * step[d] / 9.0 >= 1.25 * static_cast<double>(d + 1);
    });
    if (apart) kept.push_back(c);
  }
  return kept;
}

/// The first `count`, taken in turn from the two explanations while both last.
inline std::vector<Eigen::VectorXd> alternated(const std::vector<RankedPoint>& ranked, int count) {
  std::vector<Eigen::VectorXd> smooth, noisy, starts;
  for (const RankedPoint& c : ranked)
    (c.p[c.p.size() - 1] < std::log(interpolation_nugget) ? smooth : noisy).push_back(c.p);
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    if (i < smooth.size()) starts.push_back(smooth[i]);
    if (i < noisy.size()) starts.push_back(noisy[i]);
  }
  starts.resize(std::min<std::size_t>(starts.size(), count));
  return starts;
}

/// options.starts points of the box or fewer, never none.
inline std::vector<Eigen::VectorXd> starting_points(Likelihood& likelihood, const Box& box,
                                                    const FitOptions& options) {
  return alternated(kept_apart(ranked_candidates(likelihood, box, options.candidates, options.seed)),
                    options.starts);
}

}  // namespace drawpoint::kriging::detail
