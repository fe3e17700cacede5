// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where runs fail: models of responses are blind to it, so a model of success (kriging/success_model.hpp),
/// of all runs, those for validation too, tells fronts and adaptive runs where not to go.
///
/// A place is avoided when a run is likelier to fail there than to succeed, if places tell at all which runs
/// fail, or when every run failed within 2 % of each variable's range of it: failures that follow no place,
/// such as a machine that went down, forbid their own surroundings and no more, however many they are.

#include <drawpoint/studies/model/fits/tables.h>
#include <drawpoint/kriging/success_model.hpp>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace drawpoint::studies {

class Failures {
 public:
  Failures() = default;  ///< none
  explicit Failures(const Tables& tables);

  bool none() const { return !model_; }
  /// Probability that a run at each row of X (n x d, natural units) succeeds; 1 while no run has failed.
  Eigen::VectorXd probability_of_success(const Eigen::MatrixXd& X) const;
  /// One entry per row of X.
  std::vector<bool> avoided(const Eigen::MatrixXd& X) const;
  /// Empty while no run has failed.
  const std::optional<kriging::SuccessModel>& model() const { return model_; }
  /// Whether the place tells which runs fail, without a full stop; empty while none has failed.
  std::string text() const;

 private:
  doe::Problem problem_;
  std::optional<kriging::SuccessModel> model_;
  Eigen::MatrixXd lost_;  ///< places where every run failed, in the unit box
};

}  // namespace drawpoint::studies
