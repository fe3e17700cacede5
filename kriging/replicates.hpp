// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Repeated runs as one run with a known noise, for Noise::known.
///
/// The mᵢ runs at xᵢ become one, their mean ȳᵢ, whose noise has the variance τᵢ². pooled: the noise is the same
/// everywhere, so τᵢ² = s²/mᵢ with s² = Σᵢ Σⱼ (yᵢⱼ − ȳᵢ)²/Σᵢ (mᵢ − 1); needs one repeated point. own: each point has
/// its own noise, τᵢ² = sᵢ²/mᵢ with sᵢ² = Σⱼ (yᵢⱼ − ȳᵢ)²/(mᵢ − 1), drawn towards the others' as far as so few runs
/// leave it open (moderated_noise.hpp); needs two runs at each point. Cost of a fit: n³ of the distinct points.
/// Source: Ankenman, Nelson, Staum 2010, Operations Research 58(2), "Stochastic Kriging for Simulation Metamodeling".

#include <Eigen/Core>
#include <algorithm>
#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/kriging/detail/sites.hpp>
#include <drawpoint/kriging/moderated_noise.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::kriging {

/// What runs at equal points say of a simulator, by its objectives and limits; by all responses where it has none. What
/// is only recorded, such as the time a run took, may differ.
enum class RepeatsSay {
  nothing,  ///< no point was run twice, or the runs agree where noisy ones might (detail/sites.hpp)
  exact,    ///< all agree in every response
  noisy     ///< two differ in one
};

/// Looks at the runs that succeeded.
inline RepeatsSay repeats_say(const doe::Evaluations& runs) {
  const Eigen::MatrixXd X = runs.X();
  const auto sites = detail::sites_of(X);
  if (static_cast<Eigen::Index>(sites.size()) == X.rows()) return RepeatsSay::nothing;
  const std::vector<doe::Response>& responses = runs.problem.responses;
  const auto is_asked = [](const doe::Response& r) { return r.goal != doe::Goal::record; };
  const bool all = std::none_of(responses.begin(), responses.end(), is_asked);
  bool told = true, varies = false;
  for (const doe::Response& response : responses) {
    if (!all && !is_asked(response)) continue;
    const Eigen::VectorXd y = runs.y(response.name);
    if (!detail::repeats_agree(sites, y)) return RepeatsSay::noisy;
    if ((y.array() == y[0]).all()) continue;
    varies = true;
    told = told && detail::agreement_tells(sites, y);
  }
  return told && varies ? RepeatsSay::exact : RepeatsSay::nothing;
}

enum class ReplicateNoise { pooled, own };

struct Replicates {
  Eigen::MatrixXd X;               ///< distinct points in the order of their first run, one per row
  Eigen::VectorXd y;               ///< means
  Eigen::VectorXd noise_variance;  ///< of the means, unit of y squared
  Eigen::VectorXi count;           ///< runs of each point
};

/// X: n x d, y: n; rows are repeats when they are equal. Throws std::invalid_argument when the sizes differ,
/// a number is not finite, or the repeats do not suffice.
inline Replicates replicates(const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                             ReplicateNoise noise = ReplicateNoise::pooled) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("kriging::replicates: " + what);
  };
  if (X.rows() != y.size())
    reject("X has " + std::to_string(X.rows()) + " rows but y has " + std::to_string(y.size()) +
           " entries; give one response a run");
  if (!X.allFinite() || !y.allFinite())
    reject("X or y holds a number that is not finite; allowed are finite numbers; leave failed runs out");
  const auto groups = detail::sites_of(X);
  const auto points = static_cast<Eigen::Index>(groups.size());
  if (points == X.rows())
    reject("no two rows of X are equal; allowed is one repeated point or more; use Noise::nugget");
  Replicates r{Eigen::MatrixXd(points, X.cols()), Eigen::VectorXd(points), Eigen::VectorXd(points),
               Eigen::VectorXi(points)};
  for (Eigen::Index i = 0; i < points; ++i) {
    const Eigen::VectorXd runs = y(groups[i]);
    r.X.row(i) = X.row(groups[i].front());
    r.count[i] = static_cast<int>(runs.size());
    r.y[i] = runs[0] + (runs.array() - runs[0]).mean();  // exact where all agree
    r.noise_variance[i] = (runs.array() - r.y[i]).square().sum();
    if (noise == ReplicateNoise::own && runs.size() < 2)
      reject("the point of row " + std::to_string(groups[i].front()) +
             " has 1 run; allowed is 2 or more; use ReplicateNoise::pooled");
  }
  const Eigen::ArrayXd count = r.count.cast<double>();
  if (noise == ReplicateNoise::pooled)
    r.noise_variance = r.noise_variance.sum() / static_cast<double>(X.rows() - points) / count;
  else
    r.noise_variance =
        moderated_noise((r.noise_variance.array() / (count - 1.0)).matrix(), (count - 1.0).matrix()).array() /
        count;
  return r;
}

}  // namespace drawpoint::kriging
