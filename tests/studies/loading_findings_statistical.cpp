// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// How often the findings of small noisy studies are decided, and rightly: 40 runs each, of fixed seeds.

#include <gtest/gtest.h>
#include <drawpoint/tests/studies/loading_formulas.hpp>

#include <map>
#include <string>

using namespace drawpoint;
using namespace drawpoint::studies;
using namespace drawpoint::studies::test;

namespace {

constexpr int studies_of_a_kind = 12;

/// How many of F1 to F13 have each verdict, over the studies.
struct Counts {
  std::map<std::string, std::map<Verdict, int>> of;
  std::map<Verdict, int> all;

  Counts(const Formula& f, const Vector3d& noise) {
    for (unsigned seed = 1; seed <= studies_of_a_kind; ++seed)
      for (const auto& [id, finding] : found(without_validation(results_of(40, f, noise, 10 * seed)))) {
        if (id == "F14" || id == "F15" || id == "F16") continue;
        ++of[id][finding.verdict];
        ++all[finding.verdict];
      }
  }
  static StudyResults without_validation(StudyResults results) {
    results.X_new.resize(0, 4);
    results.Y_new.resize(0, 3);
    return results;
  }
};

// Measured on 100 others: one of 1300 was decided.
TEST(LoadingFindings, OfPureNoiseAreUnclear) {
  const Counts counts([](const Vector4d&) { return Vector3d(300, 5, 0.2); }, {100, 3, 0.05});
  EXPECT_GE(counts.all.at(Verdict::unclear), 13 * studies_of_a_kind - 3);
}

// Noise of half the deviation of the mean response. Of 40 others none of 520 was called reproduced.
TEST(LoadingFindings, ThatAreFalseAreNotReproduced) {
  Counts counts(otherwise, {65, 4.5, 0.04});
  EXPECT_LE(counts.all[Verdict::reproduced], 3);
  for (const char* id : {"F4", "F7", "F9"})
    EXPECT_GE(counts.of[id][Verdict::not_reproduced], studies_of_a_kind - 4) << id;
}

TEST(LoadingFindings, ThatAreTrueAreReproducedWhereNoiseLeavesThem) {
  Counts counts(as_the_source, {95, 3.9, 0.03});
  for (const char* id : {"F1", "F7"})
    EXPECT_GE(counts.of[id][Verdict::reproduced], studies_of_a_kind - 4) << id;
  for (const char* id : {"F1", "F2", "F7", "F8", "F11"})
    EXPECT_LE(counts.of[id][Verdict::not_reproduced], 1) << id;
}

}  // namespace
