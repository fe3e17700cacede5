// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/runs/plan.h>
#include <drawpoint/studies/runs/settings.h>
#include <drawpoint/doe/augmented_latin_hypercube.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/doe/uniform.hpp>

#include <algorithm>
#include <utility>

namespace drawpoint::studies {
namespace {

enum class Stream : std::uint64_t { training, validation_points, validation_runs };

/// Seeds for everything but training runs; these take run numbers below 2^62.
doe::Seed stream_seed(const Identity& identity, Stream stream, std::uint64_t part) {
  const std::uint64_t beyond_all_runs = 1ull << 63;
  return doe::run_seed(identity.seed, beyond_all_runs + static_cast<std::uint64_t>(stream), part);
}

doe::Seed seed_of(const Identity& identity, Kind kind, std::int64_t point, int replicate) {
  const doe::Seed study =
      kind == Kind::training ? identity.seed : stream_seed(identity, Stream::validation_runs, 0);
  return doe::run_seed(study, static_cast<std::uint64_t>(point), static_cast<std::uint64_t>(replicate));
}

Eigen::MatrixXd points_of(const std::vector<Run>& runs, Kind kind, Eigen::Index dimension) {
  Eigen::MatrixXd X(count_points(runs, kind), dimension);
  for (const auto& run : runs) {
    if (run.kind == kind) X.row(run.point - 1) = run.x.transpose();
  }
  return X;
}

void append(std::vector<Run>& runs, const Identity& identity, Kind kind, const Eigen::MatrixXd& X,
            std::pair<std::int64_t, std::int64_t> first_point_and_id) {
  auto [point, id] = first_point_and_id;
  const int replicates = kind == Kind::training ? identity.replicates : 1;
  for (Eigen::Index row = 0; row < X.rows(); ++row, ++point) {
    for (int replicate = 0; replicate < replicates; ++replicate) {
      Run run;
      run.id = id++;
      run.kind = kind;
      run.point = point;
      run.replicate = replicate;
      run.seed = seed_of(identity, kind, point, replicate);
      run.x = X.row(row);
      runs.push_back(run);
    }
  }
}

void refuse_to_shrink(int stored, int wanted, const std::string& option, const std::string& what) {
  if (wanted >= stored) return;
  throw UsageError(option + " " + std::to_string(wanted) + ": the output folder already holds " +
                   std::to_string(stored) + " " + what +
                   " points, and a study grows but does not shrink; use " + option + " " +
                   std::to_string(stored) + " or more, or choose another folder with --out");
}

}  // namespace

bool has_corners(const doe::Problem& problem, int runs) {
  const std::size_t dimension = problem.variables.size();
  return dimension < 30 && runs >= (1 << dimension);
}

Eigen::MatrixXd first_design(const Identity& identity, int runs) {
  return doe::optimized_latin_hypercube(
      identity.problem, runs,
      {.seed = stream_seed(identity, Stream::training, 0), .corners = identity.corners, .centred = false});
}

Eigen::MatrixXd further_design(const Identity& identity, const Eigen::MatrixXd& existing, int runs) {
  const int corners = identity.corners ? 1 << identity.problem.variables.size() : 0;
  const auto more = runs - static_cast<int>(existing.rows());
  const auto seed = stream_seed(identity, Stream::training, static_cast<std::uint64_t>(existing.rows()));
  const Eigen::MatrixXd latin = existing.bottomRows(existing.rows() - corners);
  return doe::augmented_latin_hypercube(identity.problem, latin, more, {.seed = seed}).bottomRows(more);
}

std::vector<Run> runs_to_add(const Identity& identity, const std::vector<Run>& existing, int runs,
                             int validation) {
  const int trained = count_points(existing, Kind::training);
  const int validated = count_points(existing, Kind::validation);
  refuse_to_shrink(trained, runs, "--runs", "training");
  refuse_to_shrink(validated, validation, "--validation", "validation");
  const auto dimension = static_cast<Eigen::Index>(identity.problem.variables.size());
  std::vector<Run> added;
  if (runs > trained) {
    const auto X = trained == 0
                       ? first_design(identity, runs)
                       : further_design(identity, points_of(existing, Kind::training, dimension), runs);
    append(added, identity, Kind::training, X, {trained + 1, existing.size() + 1});
  }
  if (validation > validated) {
    const auto seed = stream_seed(identity, Stream::validation_points, static_cast<std::uint64_t>(validated));
    const auto X = doe::uniform_random(identity.problem, validation - validated, {.seed = seed});
    append(added, identity, Kind::validation, X, {validated + 1, existing.size() + added.size() + 1});
  }
  return added;
}

int count_points(const std::vector<Run>& runs, Kind kind) {
  std::int64_t last = 0;
  for (const auto& run : runs) {
    if (run.kind == kind) last = std::max(last, run.point);
  }
  return static_cast<int>(last);
}

}  // namespace drawpoint::studies
