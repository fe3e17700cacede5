// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What `propose` can be told.

#include <Eigen/Core>
#include <functional>
#include <optional>

#include <drawpoint/doe/allowed.hpp>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe {

enum class BatchRule { cells, penalty, believer, joint };

struct ProposeOptions {
  Seed seed = 1;  ///< of the candidates, together with the number of rows of the table
  int batch = 1;  ///< points to choose, 1 or more
  /// Random points to choose from, 1 or more; empty: 100 per run, within 1000 to 20000: enough for the best
  /// of each cell.
  std::optional<int> candidates = {};
  /// More points to choose from, k x d, natural units, inside the bounds; k = 0 is allowed: the neighbourhood of
  /// the best run, say, which random points of many variables miss.
  Eigen::MatrixXd beside = {};
  BatchRule rule = BatchRule::cells;
  /// What a run at x (natural units) would give, for BatchRule::believer: a surrogate's mean, say.
  std::function<Outcome(const Eigen::VectorXd& x)> believe{};
  /// Points whose runs are under way, k x d, natural units: they keep others away as chosen points do.
  Eigen::MatrixXd pending = {};
  Allowed allowed{};  ///< candidates are drawn where it holds; empty: the whole box
  bool climb = true;  ///< from each chosen candidate to the next maximum
};

}  // namespace drawpoint::doe
