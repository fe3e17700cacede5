// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Adaptive batches: what is stored decides, each criterion chooses as its name says.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/runs/plan.h>
#include <drawpoint/studies/runs/settings.h>
#include <drawpoint/studies/sampling/adaptive.h>
#include <drawpoint/studies/sampling/criteria.h>

#include <cmath>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

/// Flat but for a steep step near alpha = 1.5.
Eigen::VectorXd step(const Eigen::VectorXd& x) {
  return Eigen::Vector2d(std::tanh(20.0 * (x[0] - 1.5)), 0.1 + 0.01 * x[1]);
}

/// A study of `n` training runs that are done, but for the third, which failed.
std::vector<studies::Run> done_runs(const Identity& identity, int n) {
  auto runs = runs_to_add(identity, {}, n, 0);
  for (auto& run : runs) {
    run.status = Status::done;
    run.y = step(run.x);
  }
  runs[2].status = Status::failed;
  runs[2].reason = "stuck";
  return runs;
}

class Adaptive : public testing::Test {
 protected:
  std::vector<studies::Run> batch(const Sampling& sampling) const {
    return next_batch(identity_, sampling, runs_).runs;
  }

  const Identity identity_ = test::identity();
  const std::vector<studies::Run> runs_ = done_runs(identity_, 25);
};

TEST_F(Adaptive, ABatchIsDecidedByWhatIsStored) {
  const auto first = batch({.points = 20, .batch = 6}), again = batch({.points = 20, .batch = 6});
  ASSERT_EQ(first.size(), 6u);
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(first[k].x, again[k].x);
    EXPECT_EQ(first[k].predicted, again[k].predicted);
    EXPECT_EQ(first[k].id, 26 + static_cast<std::int64_t>(k));
    EXPECT_EQ(first[k].point, 1 + static_cast<std::int64_t>(k));
    EXPECT_EQ(first[k].kind, Kind::adaptive);
    EXPECT_TRUE(first[k].predicted.allFinite() && (first[k].deviation.array() >= 0.0).all());
    for (const auto& run : runs_) EXPECT_NE(run.seed, first[k].seed);
  }
}

TEST_F(Adaptive, TheLastBatchIsWhatIsLeft) {
  EXPECT_EQ(batch({.points = 2, .batch = 6}).size(), 2u);
  EXPECT_TRUE(batch({.points = 0}).empty());
}

// The step is 0.2 wide of 1.8, so a design that ignores it puts a tenth of its points within 0.1 of it.
TEST_F(Adaptive, LolaVoronoiAndErrorGoToTheStep) {
  for (const char* criteria : {"lola_voronoi", "error", "lola_voronoi=0.7,error=0.3"}) {
    int near = 0;
    for (const auto& run : batch({.points = 8, .batch = 8, .criteria = criteria}))
      near += std::abs(run.x[0] - 1.5) < 0.3;
    EXPECT_GE(near, 4) << criteria;
  }
}

TEST_F(Adaptive, EveryCriterionChooses) {
  for (const char* criteria : {"voronoi", "distance", "variance", "improvement"})
    EXPECT_EQ(batch({.points = 3, .criteria = criteria}).size(), 3u) << criteria;
}

TEST(Criteria, AreNamesWithWeights) {
  const auto shares = criteria_from("lola_voronoi=0.7,error");
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_EQ(shares[0].name, "lola_voronoi");
  EXPECT_EQ(shares[0].weight, 0.7);
  EXPECT_EQ(shares[1].weight, 1.0);
  for (const char* wrong : {"", "lola", "error=", "error=x", "error=0", "error=-1", "error=inf", "error=1,",
                            ",error", "error=1e", "error=nan"}) {
    EXPECT_THROW(criteria_from(wrong), UsageError) << wrong;
    EXPECT_NE(test::complaint([&] { criteria_from(wrong); }).find("lola_voronoi, voronoi, distance"),
              std::string::npos);
  }
}

TEST(Target, IsMetByEveryResponseOrNot) {
  std::vector<kriging::Validation> validations(2);
  validations[0].nrmse = 0.1;
  validations[1].nrmse = 0.2;
  EXPECT_TRUE(target_met({.target = 0.2}, validations));
  EXPECT_FALSE(target_met({.target = 0.19}, validations));
  EXPECT_FALSE(target_met({}, validations));
  EXPECT_FALSE(target_met({.target = 0.2}, {}));
  validations[1].nrmse = std::nan("");
  EXPECT_FALSE(target_met({.target = 0.2}, validations));
}

}  // namespace
