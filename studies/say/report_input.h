// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the report has from the table of runs alone, logs apart: tables, models, front, confirmations, and
/// what to be careful about in these. The command front says the same in the terminal.

#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/say/page/report.h>
#include <drawpoint/studies/study.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// Tables and confirmations.
ReportInput input_of(const Study& study, const Store& store, const std::vector<Run>& runs);

/// Models, validations, front, and a fact per model. Throws std::invalid_argument if the runs do not allow
/// models.
void add_models(ReportInput& input, doe::Seed seed);

/// Both, for a command that needs models: where there are none std::runtime_error begins with the command and says what
/// to do.
ReportInput input_with_models(const Study& study, const Store& store, const std::vector<Run>& runs,
                              const std::string& command);

/// Warnings about runs, models and front.
void add_warnings(ReportInput& input, const std::vector<Run>& runs);

/// Why runs failed and how often; empty where none did.
std::string failure_warning(const ReportInput& input);

}  // namespace drawpoint::studies
