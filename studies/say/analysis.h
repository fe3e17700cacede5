// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From stored runs to the report: one Kriging model per response, its correlation and trend chosen by
/// leave-one-out among four, validated on the validation runs, searched for the trade-offs between all
/// objectives within all constraints (front.h). Failed runs are left out of the models and counted. Equal
/// stores give equal models and fronts: the search is seeded by the study seed.

#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/say/study_summary.h>
#include <drawpoint/studies/study.hpp>

#include <string>

namespace drawpoint::studies {

struct Typed {
  std::string command = {};  ///< the command line that the report shows
  std::string program = {};  ///< what stands before a command in advice
};

/// Writes folder.report(). If the runs do not allow models (nearly all failed), there is no report and
/// Summary::error says why. Throws std::runtime_error if
/// the report cannot be written.
Summary analyse(const Study& study, const Store& store, const Folder& folder, const Typed& typed);

}  // namespace drawpoint::studies
