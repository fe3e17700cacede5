// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The loading study that is kept in studies/results, refitted: real responses, noisy, with clusters of runs
/// where a front was confirmed.

#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/stated_interval.h>
#include <gtest/gtest.h>
#include <drawpoint/tests/studies/support.hpp>

#include <cmath>
#include <filesystem>

using namespace drawpoint;
using namespace drawpoint::studies;
using test::TestFolder;

// The cycles of a run say what a run's production is known to: 54 kg/s (headline noise_of_production). A
// model whose noise is little more than half of that follows the noise. One with 29 kg/s was taken once, in a
// study of before, for its leave-one-out, and had an NRMSE of 0.147 on 40 validation runs, 33 of them within
// their 95 %; fits that do not have 0.12 here. Of 40 runs 35 or more lie within 95 % with a probability of 0.986.
TEST(KeptStudy, ItsModelsDoNotFollowTheNoise) {
  const TestFolder folder;
  std::filesystem::copy_file(KEPT_STUDY, folder / "study.db");
  const Store store = Store::open(folder / "study.db");
  const Tables tables = tables_of(store.runs(), store.identity().problem);
  ASSERT_EQ(tables.training.rows.size(), 106u);
  const Models fitted = fit_models(tables);
  const kriging::Validation& production = fitted.validations[0];
  EXPECT_GT(std::sqrt(kriging::modelled_noise(production, 106).variance), 29);
  EXPECT_LT(production.nrmse, 0.13);
  EXPECT_GE(count_within(production, store.identity().problem.responses[0]), 35);
}
