// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The commands of a study's program. Each returns the exit code of a command that did its work (0, or 1 for
/// a failed run or study), throws UsageError (exit code 2), Interrupted (130) or another std::exception (1).
/// Messages go to standard output, or to standard error when that is kept for JSON.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/say/export.h>
#include <drawpoint/studies/study.hpp>

namespace drawpoint::studies {

/// Makes the runs that are missing, adaptive ones among them, then the report.
int run_command(const Study& study, const Settings& settings);
/// Simulates points of the predicted front until prediction and simulation agree, then the report.
int confirm_command(const Study& study, const Settings& settings);
/// The runs that are to be made elsewhere, as a table; plans the next ones where none is left.
int ask_command(const Study& study, const Settings& settings);
/// Takes what came out of runs made elsewhere.
int tell_command(const Study& study, const Settings& settings);
/// Leaves a run out of all that is shown, with a reason, or lists the corrections of the folder.
int exclude_command(const Study& study, const Settings& settings);
/// What the output folder holds.
int status_command(const Study& study, const Settings& settings);
/// How each response is fitted, and how well runs are predicted without themselves.
int fit_command(const Study& study, const Settings& settings);
/// The models against the validation runs, one by one.
int validate_command(const Study& study, const Settings& settings);
/// The predicted front in the terminal.
int front_command(const Study& study, const Settings& settings);
/// What the models expect at points of the user's, as a table.
int predict_command(const Study& study, const Settings& settings);
/// One strategy, what it gains, and how to simulate it.
int recommend_command(const Study& study, const Settings& settings);
/// The folder in one file, for another machine.
int share_command(const Study& study, const Settings& settings);
/// Such a file as a new folder.
int open_command(const Study& study, const Settings& settings);
/// What another folder of the study gives in place of this one; neither is changed.
int compare_command(const Study& study, const Settings& settings);
/// One run as a page of its own.
int replay_command(const Study& study, const Settings& settings);
/// A page that follows the study, on this machine, until Ctrl-C.
int live_command(const Study& study, const Settings& settings);
/// The report again, from the stored runs.
int report_command(const Study& study, const Settings& settings);
/// Writes a table to the file of the settings, or to standard output.
void write_table(const Study& study, const ExportTable& table, const ExportSettings& settings);

/// The runs or the front as a table for other programs.
int export_command(const Study& study, const Settings& settings);
/// A new folder with the runs of another, their responses taken anew from the logs.
int rerun_responses_command(const Study& study, const Settings& settings);
/// One run in this process.
int evaluate_command(const Study& study, const PointSettings& settings);
/// One run in this process, with all that passes between it and its program.
int check_command(const Study& study, const PointSettings& settings);
/// Study::prepare in this process, for `run`.
int prepare_command(const Study& study, const PointSettings& settings);

/// Where messages of a command go: 2 (standard error) when standard output is kept for JSON, else 1.
inline int message_descriptor(const Settings& settings) { return settings.json ? 2 : 1; }

}  // namespace drawpoint::studies
