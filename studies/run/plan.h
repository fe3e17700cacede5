// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which runs a study makes.
///
/// The points of the first design (training) are a Latin hypercube chosen for the distance between its points
/// (doe/optimized_latin_hypercube.hpp), with the 2^d corners of the box in front where they are two fifths of
/// it or less. Validation points are independent and uniform. What comes after the first design is chosen
/// elsewhere (sampling/). Each run has random numbers of its own, derived from the study seed.
///
/// A study grows without losing a run: the store keeps the points, so that a study begun by another version
/// grows from what it has. New validation points are more of the same. New training points are those of
/// doe/augmented_latin_hypercube.hpp: with n points in all, each axis is cut in n equal strata, and no new
/// point shares a stratum with another point. Corners stay out of the count, and are never added later. A
/// grown design is not the one that the larger number would have given from the start.

#include <drawpoint/studies/run/store/store.h>

#include <Eigen/Core>
#include <vector>

namespace drawpoint::studies {

/// Whether a first design of so many points starts with the corners: where they are two fifths of it or less.
bool has_corners(const doe::Problem& problem, int runs);

/// The training points (n x d) of a new design.
Eigen::MatrixXd first_design(const Identity& identity, int runs);

/// Further training points ((runs - existing.rows()) x d) for the existing ones (n x d). Requires runs >
/// existing.rows().
Eigen::MatrixXd further_design(const Identity& identity, const Eigen::MatrixXd& existing, int runs);

/// The runs to add to `existing` so that there are `runs` training and `validation` validation points. Throws
/// UsageError if there are more already. Deterministic in its arguments.
std::vector<Run> runs_to_add(const Identity& identity, const std::vector<Run>& existing, int runs,
                             int validation);

/// One more run at the training point nearest to the middle of the box, where twenty or more are `existing` or `added`
/// and some are added: at a corner, where nothing happens, noisy runs agree, too. None where the runs tell their noise,
/// or a point has a replicate already.
std::vector<Run> run_that_asks_for_chance(const Identity& identity, const std::vector<Run>& existing,
                                          const std::vector<Run>& added);

/// Points to run, natural units, and what is predicted there: mean and 95 % interval of one run.
struct PlannedPoints {
  Eigen::MatrixXd X;  ///< n x d
  /// n x responses; no rows where nothing is predicted.
  Eigen::MatrixXd predicted = {}, lower = {}, upper = {};
};

/// Runs of a kind at these points, their numbers and seeds continuing those of `existing`.
std::vector<Run> runs_at(const Identity& identity, const std::vector<Run>& existing, Kind kind,
                         const PlannedPoints& points);

/// Seed for choosing further points when there are `runs` runs.
doe::Seed seed_of_choice(const Identity& identity, std::size_t runs);

/// Number of design points of a kind.
int count_points(const std::vector<Run>& runs, Kind kind);

/// Throws UsageError when fewer points are wanted than there are.
void refuse_to_shrink(int stored, int wanted, const std::string& option, const std::string& what);

}  // namespace drawpoint::studies
