// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A study's findings, held against its runs.

#include <drawpoint/studies/report/report.h>
#include <drawpoint/studies/store/folder.h>
#include <drawpoint/studies/study.hpp>

#include <vector>

namespace drawpoint::studies {

/// Asks the study with the runs and validations of the report, and puts a table of the answers before the
/// report's figures of one run. If the study throws, there are no findings and a warning says why.
std::vector<Finding> hold_findings(ReportInput& input, const Study& study, const Folder& folder);

}  // namespace drawpoint::studies
