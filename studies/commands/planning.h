// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a study does next, by what its runs have shown; for the commands that make runs and for `ask`.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/study.hpp>

#include <Eigen/Core>
#include <string>

namespace drawpoint::studies {

/// Throws UsageError for options of `run` and `ask` that cannot be: asked before anything is written.
void check_request(const Study& study, const Settings& settings);

/// Plans a batch of adaptive runs and says so. False when the study has what it wants, or no models to go by, which
/// the store remembers. `time_is_up`: why no batch may be begun any more; empty: one may. Requires that no run is
/// planned.
bool add_batch(Store& store, const std::string& time_is_up, int messages);

/// The points that the user names, checked.
Eigen::MatrixXd named_points(const doe::Problem& problem, const ConfirmSettings& settings);

/// Plans a round of confirmation on the front of this moment and says so. False when there is nothing to
/// simulate.
bool add_round(Store& store, const Study& study, const ConfirmSettings& settings, int round, int messages);

}  // namespace drawpoint::studies
