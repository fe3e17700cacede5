// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What uncertain responses might be: draws of all responses at n points, from any surrogate.
///
/// Three sources:
/// * a function that predicts means and standard deviations: independent normals. Errors of near points are
///   then drawn as unrelated, which makes a smooth surrogate's front look more ragged than it is;
/// * a function that draws sample paths jointly (concept PathFunction): keeps the relation of near points,
///   and is the better choice where a surrogate has it;
/// * matrices of paths, n x draws for each response, as kriging::sample_paths gives them (draws_of_paths);
///   kriging/error_correlation.hpp makes those of responses that err together.
/// Normals come by quasi Monte Carlo: scrambled Sobol points (doe/sobol.hpp) for blocks of as many points as
/// fit into 37 dimensions, each block in its own random order: Latin supercube sampling (Owen 1998, "Latin
/// supercube sampling for very high-dimensional simulations"). Each draw alone is a plain one, so means over
/// draws are unbiased. Equal seeds give equal bits. Memory 8 n r bytes per draw.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <stdexcept>
#include <string>
#include <vector>

#include <drawpoint/doe/detail/normal_quantile.hpp>
#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto {

/// Predicted means and standard deviations of all responses of the problem at n points: n x r, natural units.
struct PredictedResponses {
  Eigen::MatrixXd mean, deviation;
};

/// One matrix per draw, each n x r: all responses at all points.
using Draws = std::vector<Eigen::MatrixXd>;

struct DrawOptions {
  int draws = 1024;  ///< 2 or more; best a power of 2. A probability is then known within 0.016 or better
  doe::Seed seed = 1;
};

template <class F>
concept PredictiveFunction = requires(const F& f, const Eigen::MatrixXd& X) {
  { f(X) } -> std::convertible_to<PredictedResponses>;
};

template <class F>
concept PathFunction = requires(const F& f, const Eigen::MatrixXd& X, const DrawOptions& options) {
  { f(X, options) } -> std::convertible_to<Draws>;
};

template <class F>
concept UncertainFunction = PredictiveFunction<F> || PathFunction<F>;

namespace detail {

inline void check(const std::string& place, const PredictedResponses& p) {
  if (p.mean.rows() != p.deviation.rows() || p.mean.cols() != p.deviation.cols())
    throw std::invalid_argument(place + "mean is " + std::to_string(p.mean.rows()) + " x " +
                                std::to_string(p.mean.cols()) + ", deviation is " +
                                std::to_string(p.deviation.rows()) + " x " +
                                std::to_string(p.deviation.cols()) + "; both need points x responses");
  if (!p.mean.allFinite() || !p.deviation.allFinite() || (p.deviation.array() < 0.0).any())
    throw std::invalid_argument(place +
                                "mean and deviation must be finite and deviation not negative; leave out "
                                "points where the surrogate says nothing");
  if (p.mean.cols() > doe::detail::sobol_max_dimensions)
    throw std::invalid_argument(place + "mean has " + std::to_string(p.mean.cols()) +
                                " responses; allowed are up to " +
                                std::to_string(doe::detail::sobol_max_dimensions) + "; draw paths instead");
}

/// count x dimensions standard normals; every column is stratified.
inline Eigen::MatrixXd normal_net(int count, int dimensions, doe::Seed seed) {
  doe::Problem unit{{}, {{"none", "1"}}};
  for (int j = 0; j < dimensions; ++j) unit.variables.push_back({std::to_string(j), "1", 0.0, 1.0});
  Eigen::MatrixXd Z = doe::scrambled_sobol(unit, count, {.seed = seed});
  for (double& z : Z.reshaped()) z = doe::detail::normal_quantile(std::clamp(z, 0x1p-54, 1.0 - 0x1p-53));
  return Z;
}

/// Draws agree in shape with each other and the problem, and are finite.
inline void check_draws(const std::string& place, const doe::Problem& problem, const Draws& draws) {
  doe::check(problem);
  const auto r = static_cast<Eigen::Index>(problem.responses.size());
  check_range(place, "the number of draws", static_cast<double>(draws.size()), draws.size() >= 2,
              "2 or more");
  for (const Eigen::MatrixXd& Y : draws) {
    if (Y.cols() != r || Y.rows() != draws.front().rows() || Y.rows() == 0)
      throw std::invalid_argument(place + "a draw is " + std::to_string(Y.rows()) + " x " +
                                  std::to_string(Y.cols()) + "; each must have " + std::to_string(r) +
                                  " responses at the same points, one at least");
    if (!Y.allFinite())
      throw std::invalid_argument(place + "a draw holds NaN or infinity; leave out such draws");
  }
}

}  // namespace detail

/// Independent normals. Throws std::invalid_argument for shapes that differ, numbers that are not finite,
/// negative deviations and fewer than 2 draws.
inline Draws draws_of_normals(const PredictedResponses& p, const DrawOptions& options = {}) {
  const std::string place = "pareto::draws_of_normals: ";
  detail::check(place, p);
  detail::check_range(place, "draws", options.draws, options.draws >= 2, "2 or more");
  const Eigen::Index n = p.mean.rows(), r = p.mean.cols();
  Draws draws(static_cast<std::size_t>(options.draws), p.mean);
  if (n == 0 || r == 0) return draws;
  constexpr Eigen::Index even = 37;  // dimensions of a net, the first and most even ones where they suffice
  const Eigen::Index block = std::max<Eigen::Index>(even / r, 1);
  for (Eigen::Index first = 0; first < n; first += block) {
    const Eigen::Index points = std::min(block, n - first);
    const auto number = static_cast<std::uint64_t>(first);
    const Eigen::MatrixXd Z = detail::normal_net(options.draws, static_cast<int>(points * r),
                                                 doe::run_seed(options.seed, number, 0));
    doe::RandomStream random(doe::run_seed(options.seed, number, 1));
    const std::vector<int> order = doe::detail::permutation(options.draws, random);
    for (std::size_t s = 0; s < draws.size(); ++s)
      for (Eigen::Index i = 0; i < points; ++i)
        for (Eigen::Index j = 0; j < r; ++j)
          draws[s](first + i, j) += p.deviation(first + i, j) * Z(order[s], i * r + j);
  }
  return draws;
}

/// paths: one n x draws matrix for each response, in their order.
inline Draws draws_of_paths(const std::vector<Eigen::MatrixXd>& paths) {
  Draws draws;
  if (paths.empty()) return draws;
  for (const Eigen::MatrixXd& path : paths)
    if (path.rows() != paths.front().rows() || path.cols() != paths.front().cols())
      throw std::invalid_argument(
          "pareto::draws_of_paths: one response has " + std::to_string(path.rows()) + " x " +
          std::to_string(path.cols()) + " paths, the first " + std::to_string(paths.front().rows()) + " x " +
          std::to_string(paths.front().cols()) + "; draw all at the same points, equally often");
  for (Eigen::Index s = 0; s < paths.front().cols(); ++s) {
    Eigen::MatrixXd Y(paths.front().rows(), static_cast<Eigen::Index>(paths.size()));
    for (std::size_t j = 0; j < paths.size(); ++j) Y.col(static_cast<Eigen::Index>(j)) = paths[j].col(s);
    draws.push_back(std::move(Y));
  }
  return draws;
}

/// X: n x d, natural units. Paths where f draws them, else independent normals.
template <class F>
Draws draws_at(const F& f, const Eigen::MatrixXd& X, const DrawOptions& options = {}) {
  static_assert(
      UncertainFunction<F>,
      "drawpoint: not an uncertain function. Expected pareto::PredictedResponses f(const "
      "Eigen::MatrixXd& X) const; with mean and deviation of all responses (n x r), or pareto::Draws "
      "f(const Eigen::MatrixXd& X, const pareto::DrawOptions& options) const; with one n x r matrix per "
      "draw, options.draws of them from options.seed.");
  if constexpr (PathFunction<F>) {
    detail::check_range("pareto::draws_at: ", "draws", options.draws, options.draws >= 2, "2 or more");
    return f(X, options);
  } else if constexpr (PredictiveFunction<F>) {
    return draws_of_normals(f(X), options);
  } else {
    return {};  // so that the message above stands alone
  }
}

}  // namespace drawpoint::pareto
