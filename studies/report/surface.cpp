// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/report/surface.h>
#include <drawpoint/doe/uniform.hpp>

namespace drawpoint::studies::detail {

std::optional<Surface> surface(const kriging::Model& model) {
  const auto& state = model.state();
  if (state.trend.by_user()) return std::nullopt;
  Surface s{state.input.centre, state.input.factor, state.correlation, state.X, {}, {}, {}, state.y_centre};
  if (state.X.rows() == 0) return s;
  s.weights = state.y_scale * state.gls.alpha;
  s.terms = state.trend.terms;
  s.coefficients = model.trend_coefficients();
  return s;
}

Eigen::VectorXd influence(const kriging::Model& model, const doe::Problem& problem) {
  constexpr int samples = 512;
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  const Eigen::MatrixXd A = doe::uniform_random(problem, samples, {.seed = 1}),
                        B = doe::uniform_random(problem, samples, {.seed = 2});
  const Eigen::VectorXd at_a = model.mean(A), at_b = model.mean(B);
  const double centre = 0.5 * (at_a.mean() + at_b.mean());
  const double variance =
      ((at_a.array() - centre).square().sum() + (at_b.array() - centre).square().sum()) / (2.0 * samples);
  Eigen::VectorXd total = Eigen::VectorXd::Zero(d);
  if (!(variance > 0.0)) return total;
  for (Eigen::Index k = 0; k < d; ++k) {
    Eigen::MatrixXd mixed = A;
    mixed.col(k) = B.col(k);
    total[k] = (at_a - model.mean(mixed)).squaredNorm() / (2.0 * samples * variance);
  }
  return total;
}

}  // namespace drawpoint::studies::detail
