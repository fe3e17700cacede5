// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// All that the command compare knows of two folders of one study; neither is changed.

#include <drawpoint/studies/model/comparison/comparison.h>
#include <drawpoint/studies/model/comparison/front_comparison.h>
#include <drawpoint/studies/model/fits/flat_responses.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/study.hpp>

#include <optional>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// What was asked for on one side.
struct ComparedFolder {
  Folder folder;
  const Store& store;
};

struct ComparedSide {
  std::string folder = {};
  int ended = 0, failed = 0;  ///< runs; the failed ones are among those that ended
  std::vector<Headline> headlines = {};
  std::vector<std::string> warnings = {};
  std::optional<pareto::Front> front = {};  ///< predicted
  std::string no_front = {};                ///< why there is none
  std::vector<FlatResponse> flat = {};
};

/// Something that was decided otherwise on the two sides.
struct OtherChoice {
  std::string what, a, b;
};

struct ComparedFolders {
  std::string study = {};
  doe::Problem problem = {};
  ComparedSide a = {}, b = {};
  std::vector<OtherChoice> choices = {};  ///< options, then simulator, seed and replicates
  Comparison runs = {};
  std::optional<FrontComparison> fronts = {};  ///< where both sides have one, in a common objective
  doe::Problem common = {};                    ///< objectives of both fronts; others are recorded only
};

/// Requires stores of the study's problem. Fits the models of both.
ComparedFolders compare_folders(const Study& study, const ComparedFolder& a, const ComparedFolder& b);

}  // namespace drawpoint::studies
