// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/settings.h>
#include <drawpoint/doe/augmented_latin_hypercube.hpp>
#include <drawpoint/doe/detail/unit_box.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/doe/uniform.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace drawpoint::studies {
namespace {

enum class Stream : std::uint64_t {
  training,
  validation_points,
  validation_runs,
  adaptive_runs,
  confirmation_runs,
  choices
};

/// Seeds for everything but training runs; these take run numbers below 2^62.
doe::Seed stream_seed(const Identity& identity, Stream stream, std::uint64_t part) {
  const std::uint64_t beyond_all_runs = 1ull << 63;
  return doe::run_seed(identity.seed, beyond_all_runs + static_cast<std::uint64_t>(stream), part);
}

doe::Seed seed_of(const Identity& identity, Kind kind, std::int64_t point, int replicate) {
  const auto study = [&] {
    switch (kind) {
      case Kind::validation:
        return stream_seed(identity, Stream::validation_runs, 0);
      case Kind::adaptive:
        return stream_seed(identity, Stream::adaptive_runs, 0);
      case Kind::confirmation:
        return stream_seed(identity, Stream::confirmation_runs, 0);
      default:
        return identity.seed;
    }
  };
  return doe::run_seed(study(), static_cast<std::uint64_t>(point), static_cast<std::uint64_t>(replicate));
}

Eigen::MatrixXd points_of(const std::vector<Run>& runs, Kind kind, Eigen::Index dimension) {
  Eigen::MatrixXd X(count_points(runs, kind), dimension);
  for (const auto& run : runs) {
    if (run.kind == kind) X.row(run.point - 1) = run.x.transpose();
  }
  return X;
}

}  // namespace

std::vector<Run> runs_at(const Identity& identity, const std::vector<Run>& existing, Kind kind,
                         const PlannedPoints& points) {
  const int replicates = kind == Kind::validation ? 1 : identity.replicates;
  std::vector<Run> runs;
  for (Eigen::Index row = 0; row < points.X.rows(); ++row) {
    for (int replicate = 0; replicate < replicates; ++replicate) {
      Run run;
      run.id = static_cast<std::int64_t>(existing.size() + runs.size()) + 1;
      run.kind = kind;
      run.point = count_points(existing, kind) + row + 1;
      run.replicate = replicate;
      run.seed = seed_of(identity, kind, run.point, replicate);
      run.x = points.X.row(row);
      if (points.predicted.rows() > 0) {
        run.predicted = points.predicted.row(row);
        run.lower = points.lower.row(row);
        run.upper = points.upper.row(row);
      }
      runs.push_back(run);
    }
  }
  return runs;
}

doe::Seed seed_of_choice(const Identity& identity, std::size_t runs) {
  return stream_seed(identity, Stream::choices, runs);
}

void refuse_to_shrink(int stored, int wanted, const std::string& option, const std::string& what) {
  if (wanted >= stored) return;
  throw UsageError(option + " " + std::to_string(wanted) + ": the output folder already holds " +
                   std::to_string(stored) + " " + what +
                   " points, and a study grows but does not shrink; use " + option + " " +
                   std::to_string(stored) + " or more, or choose another folder with --out");
}

bool has_corners(const doe::Problem& problem, int runs) {
  const std::size_t dimension = problem.variables.size();
  return dimension < 30 && 2LL * runs >= 5LL * (1LL << dimension);
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
  std::vector<Run> all = existing;
  const auto add = [&](Kind kind, const Eigen::MatrixXd& X) {
    const std::vector<Run> more = runs_at(identity, all, kind, {.X = X});
    all.insert(all.end(), more.begin(), more.end());
  };
  if (runs > trained) {
    add(Kind::training, trained == 0
                            ? first_design(identity, runs)
                            : further_design(identity, points_of(existing, Kind::training, dimension), runs));
  }
  if (validation > validated) {
    const auto seed = stream_seed(identity, Stream::validation_points, static_cast<std::uint64_t>(validated));
    add(Kind::validation, doe::uniform_random(identity.problem, validation - validated, {.seed = seed}));
  }
  return {all.begin() + static_cast<std::ptrdiff_t>(existing.size()), all.end()};
}

std::vector<Run> run_that_asks_for_chance(const Identity& identity, const std::vector<Run>& existing,
                                          const std::vector<Run>& added) {
  constexpr int fewest = 20;
  std::vector<Run> all = existing;
  all.insert(all.end(), added.begin(), added.end());
  const auto trains = [](const Run& r) { return r.kind == Kind::training; };
  if (identity.problem.deterministic || doe::tells_noise(identity.problem) ||
      std::none_of(added.begin(), added.end(), trains) || count_points(all, Kind::training) < fewest ||
      std::any_of(all.begin(), all.end(), [](const Run& r) { return r.replicate > 0; }))
    return {};
  const auto far_out = [&](const Run& r) {
    const Eigen::MatrixXd unit = doe::detail::to_unit_box(r.x.transpose(), identity.problem);
    return trains(r) ? (unit.array() - 0.5).abs().maxCoeff() : std::numeric_limits<double>::infinity();
  };
  Run run = *std::min_element(all.begin(), all.end(),
                              [&](const Run& a, const Run& b) { return far_out(a) < far_out(b); });
  run.id = static_cast<std::int64_t>(all.size()) + 1;
  run.replicate = 1;
  run.seed = seed_of(identity, run.kind, run.point, run.replicate);
  return {run};
}

int count_points(const std::vector<Run>& runs, Kind kind) {
  std::int64_t last = 0;
  for (const auto& run : runs) {
    if (run.kind == kind) last = std::max(last, run.point);
  }
  return static_cast<int>(last);
}

}  // namespace drawpoint::studies
