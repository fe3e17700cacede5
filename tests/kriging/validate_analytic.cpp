// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/validate.hpp>

using namespace drawpoint::kriging;
using Eigen::VectorXd;

namespace {

// A constant response gives a model that predicts 4 everywhere, so every error is known.
Model four() { return fit(VectorXd::LinSpaced(5, 0, 1), VectorXd::Constant(5, 4.0)); }

std::string message_of(const Eigen::MatrixXd& X, const VectorXd& y) {
  try {
    validate(four(), X, y);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

}  // namespace

// Errors −3, 0, 1, 4: RMSE √(26/4), range 7.
TEST(Validate, FollowsItsDefinition) {
  const Eigen::Vector4d y(1, 4, 5, 8);
  const Validation v = validate(four(), VectorXd::LinSpaced(4, 0, 1), y);
  EXPECT_DOUBLE_EQ(v.rmse, std::sqrt(6.5));
  EXPECT_DOUBLE_EQ(v.nrmse, std::sqrt(6.5) / 7.0);
  EXPECT_EQ(v.observed, VectorXd(y));
  EXPECT_EQ(v.predicted, VectorXd(VectorXd::Constant(4, 4.0)));
  EXPECT_TRUE(v.variance.isZero());
}

TEST(Validate, HasNoNrmseWithoutARange) {
  const Validation v = validate(four(), VectorXd::Zero(2), VectorXd::Constant(2, 6.0));
  EXPECT_DOUBLE_EQ(v.rmse, 2.0);
  EXPECT_TRUE(std::isnan(v.nrmse));
}

TEST(Validate, RejectsWhatItCannotCompare) {
  EXPECT_EQ(message_of(VectorXd::Zero(2), VectorXd::Zero(3)),
            "kriging::validate: X has 2 rows but y has 3 entries; give one response a run");
  EXPECT_EQ(message_of(Eigen::MatrixXd(0, 1), VectorXd(0)),
            "kriging::validate: X has 0 runs; allowed is 1 or more; give runs that the model has not seen");
  EXPECT_EQ(message_of(VectorXd::Zero(1), VectorXd::Constant(1, std::nan(""))),
            "kriging::validate: y holds a number that is not finite; allowed are finite numbers; leave "
            "failed runs out");
  EXPECT_EQ(message_of(Eigen::MatrixXd::Zero(1, 2), VectorXd::Zero(1)),
            "kriging::Model: X has 2 columns; the model has 1 variables; give one point per row");
}
