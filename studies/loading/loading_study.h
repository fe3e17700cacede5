// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What all studies of loading have in common: a study of one is what it varies and what it measures.

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/loading/scenario.hpp>
#include <drawpoint/studies/study.hpp>

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace drawpoint::studies {

struct LoadingStudy {
  std::string name, about;
  doe::Problem problem;
  Defaults defaults;
  std::vector<StudyOption> options;
  /// The scenario of a run, but for its seed and log; its pile must be the same for all x. May throw.
  std::function<engine::loading::Scenario(const Eigen::VectorXd& x, const RunContext& run)> scenario;
  /// What the responses need of a log.
  engine::loading::LogContent content = engine::loading::LogContent::without_scene;
  /// The responses of a log that has a cycle.
  std::function<doe::Outcome(const engine::loading::LoadingLog& log, const OptionValues& options)> responses;
};

/// Prepares the pile, simulates, and draws figures, replay and headlines as lhd_loading does. A run that did not
/// complete is a failure.
Study study_of(const LoadingStudy& loading);

/// loading_options() without some, which a study sets itself.
std::vector<StudyOption> loading_options_without(const std::set<std::string>& names);

/// With these values, and the default of what the study has left out.
RunContext with_options(RunContext run, const OptionValues& values);

/// A response that is kept beside the objectives, at least 0.
doe::Response recorded(const char* name, const char* unit, const std::string& description);
/// One that is the standard error of another, by the scatter of the run's cycles.
doe::Response standard_error(const char* name, const char* unit, const std::string& of);

}  // namespace drawpoint::studies
