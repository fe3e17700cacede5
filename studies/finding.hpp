// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is claimed about a black box, and whether the runs of a study bear it out. The study decides from what
/// it knows when its runs are made and its models fitted, and says what decided.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/studies/options.hpp>

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace drawpoint::studies {

enum class Verdict { reproduced, not_reproduced, unclear };

constexpr const char* to_string(Verdict verdict) {
  return verdict == Verdict::reproduced       ? "reproduced"
         : verdict == Verdict::not_reproduced ? "not reproduced"
                                              : "unclear";
}

struct Finding {
  std::string id;     ///< F1
  std::string claim;  ///< in a sentence
  Verdict verdict = Verdict::unclear;
  std::string grounds;  ///< the number that decided and its threshold, or why nothing could
};

/// Results of the successful runs, training and validation apart. Variables and responses are in the problem's order.
struct StudyResults {
  doe::Problem problem;
  Eigen::MatrixXd X, Y;                     ///< training: n x d and n x r, natural units
  Eigen::MatrixXd X_new, Y_new;             ///< validation
  std::vector<std::filesystem::path> logs;  ///< of the training runs, row by row; empty where there is none
  /// Errors of the models on the validation runs against the mean response, over the range of all runs; empty without
  /// validation runs.
  std::vector<double> nrmse;
  std::vector<double> nrmse_error = {};  ///< standard errors of these; empty: by the number of runs alone
  std::vector<std::filesystem::path> logs_new = {};  ///< of the validation runs
  OptionValues options = {};                         ///< of the study
};

}  // namespace drawpoint::studies
