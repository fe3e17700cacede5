// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Scatter of cycles within runs, by the two-way layout y_ij = run_i + number_j + ε_ij: what differs between the
/// first cycle and the second in the mean of all runs is no noise. With ȳ_i the mean of run i and n_i its cycles,
/// the numbers' effects minimise S = Σ (y_ij − ȳ_i − (number_j − their mean over run i))², and the variance of ε
/// is S over its degrees of freedom, Σ (n_i − 1) less one of the numbers. Runs may lack cycles. Cost: n_i³
/// per run, and a small system of equations.

#include <Eigen/Core>
#include <vector>

namespace drawpoint::studies {

class CycleScatter {
 public:
  /// A run: its cycles' numbers, from 0 on, and values, as many.
  void add(const std::vector<int>& numbers, const std::vector<double>& values);

  double variance() const;  ///< of ε; not a number without degrees of freedom
  int degrees() const;      ///< of freedom

 private:
  Eigen::MatrixXd information_;  // of the numbers' effects, one row and column per number from 0
  Eigen::VectorXd right_;        // right-hand side of their equations
  double squares_ = 0;           // Σ (y_ij − ȳ_i)²
  int within_ = 0;               // Σ (n_i − 1)
};

}  // namespace drawpoint::studies
