// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the commands that make one run in this process have in common.

#include <drawpoint/studies/run/program/program_trouble.h>
#include <drawpoint/studies/run/settings.h>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/studies/study.hpp>

#include <filesystem>
#include <optional>

namespace drawpoint::studies {

/// A folder for the log of a run that nobody wants to keep.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// An outcome, and why the program that should have given it did not.
struct Made {
  doe::Outcome outcome;
  std::optional<ProgramTrouble::Kind> trouble = {};
};

Made make_run(const Study& study, const Eigen::VectorXd& x, doe::Seed seed, const RunContext& context);

/// As lines or as one JSON object. `as_stored`: whether a run that was made again came out as before.
void print(const doe::Problem& problem, const doe::Outcome& outcome, bool as_json,
           const std::optional<bool>& as_stored);

/// What a run by hand or the preparation is told.
RunContext context_of(const Study& study, const PointSettings& settings, const std::filesystem::path& log,
                      const std::filesystem::path& shared);

/// The shared folder for a run by hand: the one that is named, filled where it is not there yet, else one
/// that is made for this run alone.
std::filesystem::path shared_folder(const Study& study, const PointSettings& settings,
                                    std::optional<TemporaryFolder>& temporary);

}  // namespace drawpoint::studies
