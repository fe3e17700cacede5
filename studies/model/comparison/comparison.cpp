// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/comparison/comparison.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace drawpoint::studies {
namespace {

/// The runs of one side at one point that ended.
struct PointRuns {
  std::vector<const Run*> done, failed;

  bool has_value() const { return !done.empty(); }
  Eigen::VectorXd mean() const {
    Eigen::VectorXd sum = done.front()->y;
    for (std::size_t i = 1; i < done.size(); ++i) sum += done[i]->y;
    return sum / static_cast<double>(done.size());
  }
  std::vector<doe::Seed> seeds() const {
    std::vector<doe::Seed> all;
    for (const Run* run : done) all.push_back(run->seed);
    std::sort(all.begin(), all.end());
    return all;
  }
  std::vector<std::int64_t> ids() const {
    std::vector<std::int64_t> all;
    for (const auto* runs : {&done, &failed})
      for (const Run* run : *runs) all.push_back(run->id);
    std::sort(all.begin(), all.end());
    return all;
  }
};

using PlaceKey = std::pair<Kind, std::string>;

/// Kind and bits of the point.
PlaceKey key_of(const Run& run) {
  return {run.kind, std::string(reinterpret_cast<const char*>(run.x.data()),
                                static_cast<std::size_t>(run.x.size()) * sizeof(double))};
}

/// In order of the first run at each.
std::vector<std::pair<PlaceKey, PointRuns>> points_of(const std::vector<Run>& runs) {
  std::map<PlaceKey, std::size_t> places;
  std::vector<std::pair<PlaceKey, PointRuns>> points;
  for (const Run& run : runs) {
    const bool ended = has_ended(run);
    if (!ended || run.kind == Kind::imported) continue;
    const auto [place, is_new] = places.emplace(key_of(run), points.size());
    if (is_new) points.push_back({place->first, {}});
    PointRuns& there = points[place->second].second;
    (run.status == Status::done ? there.done : there.failed).push_back(&run);
  }
  return points;
}

Eigen::MatrixXd stacked_rows(const std::vector<Eigen::VectorXd>& rows) {
  Eigen::MatrixXd all(static_cast<Eigen::Index>(rows.size()), rows.empty() ? 0 : rows.front().size());
  for (std::size_t i = 0; i < rows.size(); ++i) all.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
  return all;
}

/// Means at the pairs, a row each.
struct PairedMeans {
  std::vector<Eigen::VectorXd> a, b;
};

PairedMeans paired_means(const std::vector<Run>& a, const std::vector<Run>& b, Comparison& comparison) {
  std::map<PlaceKey, PointRuns> of_b;
  for (auto& [key, runs] : points_of(b)) of_b.emplace(key, std::move(runs));
  PairedMeans means;
  for (const auto& [key, runs_a] : points_of(a)) {
    const auto found = of_b.find(key);
    if (found == of_b.end()) continue;
    const PointRuns& runs_b = found->second;
    if (!runs_a.has_value() || !runs_b.has_value()) {
      comparison.left_out.push_back({runs_a.ids(), runs_b.ids(), !runs_a.has_value(), !runs_b.has_value()});
      continue;
    }
    means.a.push_back(runs_a.mean());
    means.b.push_back(runs_b.mean());
    comparison.with_other_seeds += runs_a.seeds() != runs_b.seeds();
  }
  return means;
}

/// Whether a point was chosen without regard to what runs gave.
bool is_spread(const PlaceKey& key) { return key.first == Kind::training || key.first == Kind::validation; }

/// One row per such point.
Eigen::MatrixXd spread_means(const std::vector<Run>& runs) {
  std::vector<Eigen::VectorXd> rows;
  for (const auto& [key, there] : points_of(runs)) {
    if (is_spread(key) && there.has_value()) rows.push_back(there.mean());
  }
  return stacked_rows(rows);
}

int points_with_value(const std::vector<Run>& runs, bool of_all_kinds) {
  int count = 0;
  for (const auto& [key, there] : points_of(runs))
    count += there.has_value() && (of_all_kinds || is_spread(key));
  return count;
}

std::vector<ResponseDifference> paired_responses(const Eigen::MatrixXd& Y_a, const Eigen::MatrixXd& Y_b) {
  std::vector<ResponseDifference> all;
  for (Eigen::Index j = 0; j < Y_a.cols(); ++j)
    all.push_back({paired_difference(Y_a.col(j), Y_b.col(j)),
                   static_cast<int>((Y_b.col(j).array() > Y_a.col(j).array()).count()),
                   static_cast<int>((Y_b.col(j).array() == Y_a.col(j).array()).count())});
  return all;
}

std::vector<ResponseDifference> independent_responses(const Eigen::MatrixXd& Y_a,
                                                      const Eigen::MatrixXd& Y_b) {
  std::vector<ResponseDifference> all;
  for (Eigen::Index j = 0; j < Y_a.cols(); ++j)
    all.push_back({independent_difference(Y_a.col(j), Y_b.col(j))});
  return all;
}

}  // namespace

Comparison compare_runs(const std::vector<Run>& a, const std::vector<Run>& b) {
  Comparison comparison;
  const PairedMeans means = paired_means(a, b, comparison);
  comparison.pairs = static_cast<int>(means.a.size());
  comparison.paired = comparison.pairs >= 2;
  comparison.points_a = points_with_value(a, comparison.paired);
  comparison.points_b = points_with_value(b, comparison.paired);
  if (comparison.paired)
    comparison.responses = paired_responses(stacked_rows(means.a), stacked_rows(means.b));
  else if (comparison.points_a >= 2 && comparison.points_b >= 2)
    comparison.responses = independent_responses(spread_means(a), spread_means(b));
  return comparison;
}

}  // namespace drawpoint::studies
