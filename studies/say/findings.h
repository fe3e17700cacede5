// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A study's findings, held against its runs.

#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/say/export.h>
#include <drawpoint/studies/say/page/report.h>
#include <drawpoint/studies/study.hpp>

#include <vector>

namespace drawpoint::studies {

/// Asks the study with the runs and validations of the report, and puts the answers there. `logged`: the runs
/// whose log may be used. If the study throws, there are no findings and a warning says why.
std::vector<Finding> hold_findings(ReportInput& input, const Study& study,
                                   const std::vector<const Run*>& logged, const OptionValues& options,
                                   const Folder& folder);

/// The same as a table of id, claim, verdict and grounds, of a study that has findings. Throws std::runtime_error where
/// the runs do not allow models, and as the study's findings.
ExportTable findings_table(const Study& study, const Store& store, const Folder& folder);

}  // namespace drawpoint::studies
