// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The distinct points of a table of runs, as adaptive sampling sees them: coordinates scaled to the unit box
/// of the problem, responses averaged over the successful replicates and divided by their range over all
/// sites. A site without a successful run has failed: it still takes up space. The scaling makes lengths and
/// responses comparable; a response that never varies becomes 0. Cost O(n d log n).

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/unit_box.hpp>
#include <drawpoint/doe/evaluations.hpp>

namespace drawpoint::doe::detail {

struct Sites {
  Eigen::MatrixXd U;     ///< n x d, unit box, in order of first appearance in the table
  Eigen::MatrixXd Y;     ///< n x r, range 1; rows of failed sites are 0
  std::vector<char> ok;  ///< n, whether a run succeeded there
};

/// Places in Problem::responses of those named; of all objectives and constraints when none is named, and of
/// all responses when there is no such.
inline std::vector<int> chosen_responses(const Problem& problem, const std::vector<std::string>& names) {
  std::vector<int> chosen;
  for (const std::string& name : names) chosen.push_back(response_index(problem, name));
  const auto count = static_cast<int>(problem.responses.size());
  for (int j = 0; j < count && names.empty(); ++j)
    if (problem.responses[j].goal != Goal::record) chosen.push_back(j);
  for (int j = 0; j < count && chosen.empty(); ++j) chosen.push_back(j);
  return chosen;
}

/// Site of each row, numbered in order of first appearance.
inline std::vector<int> site_of_rows(const Evaluations& runs, int& sites) {
  std::map<std::vector<double>, int> known;
  std::vector<int> site;
  for (const Evaluation& row : runs.rows) {
    const std::vector<double> x(row.x.begin(), row.x.end());
    site.push_back(known.emplace(x, static_cast<int>(known.size())).first->second);
  }
  sites = static_cast<int>(known.size());
  return site;
}

inline void scale_by_range(Eigen::MatrixXd& Y, const std::vector<char>& ok) {
  for (auto column : Y.colwise()) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < ok.size(); ++i)
      if (ok[i]) low = std::min(low, column[i]), high = std::max(high, column[i]);
    const double range = high > low ? high - low : 0.0;
    for (std::size_t i = 0; i < ok.size(); ++i)
      column[i] = ok[i] && range > 0.0 ? (column[i] - low) / range : 0.0;
  }
}

inline Sites distinct_sites(const Evaluations& runs, const std::vector<int>& responses) {
  int n = 0;
  const std::vector<int> site = site_of_rows(runs, n);
  const auto d = static_cast<Eigen::Index>(runs.problem.variables.size());
  Sites sites{Eigen::MatrixXd(n, d), Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(responses.size())),
              std::vector<char>(static_cast<std::size_t>(n), 0)};
  std::vector<int> successes(static_cast<std::size_t>(n), 0);
  for (std::size_t row = 0; row < site.size(); ++row) {
    const Evaluation& run = runs.rows[row];
    const int i = site[row];
    sites.U.row(i) = run.x;
    if (run.outcome.failed()) continue;
    ++successes[i];
    sites.ok[i] = 1;
    for (std::size_t j = 0; j < responses.size(); ++j)
      sites.Y(i, static_cast<Eigen::Index>(j)) += run.outcome.values()[responses[j]];
  }
  for (int i = 0; i < n; ++i)
    if (sites.ok[i]) sites.Y.row(i) /= successes[i];
  scale_by_range(sites.Y, sites.ok);
  sites.U = to_unit_box(std::move(sites.U), runs.problem);
  return sites;
}

}  // namespace drawpoint::doe::detail
