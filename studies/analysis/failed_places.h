// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where runs fail: models are blind to failures, so neither fronts nor adaptive runs go by them there.
///
/// A point lies beside a failure when every run at the nearest simulated place (in the unit box) failed.

#include <drawpoint/studies/analysis/tables.h>

#include <Eigen/Core>
#include <vector>

namespace drawpoint::studies {

class FailedPlaces {
 public:
  FailedPlaces() = default;  ///< none
  explicit FailedPlaces(const Tables& tables);

  bool empty() const { return !any_; }
  /// One entry per row of X (n x d, natural units).
  std::vector<bool> beside(const Eigen::MatrixXd& X) const;

 private:
  doe::Problem problem_;
  Eigen::MatrixXd places_;  ///< in the unit box
  std::vector<bool> failed_;
  bool any_ = false;
};

}  // namespace drawpoint::studies
