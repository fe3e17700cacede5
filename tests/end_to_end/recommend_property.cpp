// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// One strategy with what it gains: the arithmetic of it, its truth for a known function, and the command that it
/// gives.

#include <drawpoint/tests/end_to_end/support.hpp>

#include <cmath>

using namespace drawpoint;
using namespace drawpoint::test;
using nlohmann::json;

namespace {

const std::string study = TROUBLED_STUDY;  // cost x² + y, wear (x - 1)² + y / 2, both to be small

class Recommending : public StudyTest {
 protected:
  json recommended(const std::string& options = "") const {
    const Ended end = run(study + " recommend --json" + options + out());
    EXPECT_EQ(end.code, 0) << end.err;
    return end.json();
  }
};

double cost_at(const json& x) { return std::pow(x["x"].get<double>(), 2) + x["y"].get<double>(); }

TEST_F(Recommending, SaysWhatIsTrueOfAKnownFunctionBesideAReferenceAndHowToSimulateIt) {
  ASSERT_EQ(run(study + " --runs 16 --validation 4" + out()).code, 0);
  const json said = recommended();
  EXPECT_TRUE(contains(said["choice"], "the recommended one of "));
  EXPECT_EQ(said["against"], json({{"x", 0.5}, {"y", 10.0}})) << "the middle of the box";
  const json cost = said["responses"]["cost"];
  EXPECT_NEAR(cost["mean"].get<double>(), cost_at(said["x"]), 0.1);
  EXPECT_NEAR(cost["against"].get<double>(), 10.25, 0.1);
  // To be small: a gain is what there is less of.
  EXPECT_DOUBLE_EQ(cost["gain"].get<double>(), cost["against"].get<double>() - cost["mean"].get<double>());
  for (const char* response : {"cost", "wear"}) {
    const json r = said["responses"][response];
    EXPECT_LE(r["run_lower"], r["lower"]);
    EXPECT_LE(r["lower"], r["mean"]);
    EXPECT_LE(r["mean"], r["upper"]);
    EXPECT_LE(r["upper"], r["run_upper"]);
    EXPECT_LE(r["gain_lower"], r["gain"]);
    EXPECT_LE(r["gain"], r["gain_upper"]);
  }
  EXPECT_EQ(said["simulated"], json::array());
  const Ended text = run(study + " recommend" + out());
  EXPECT_TRUE(
      contains(text.out, "Not simulated yet; to have it simulated:\n  troubled_study confirm --points 0"));
  // Against itself nothing is gained; a wrong reference is refused.
  const json x = said["x"];
  const json same = recommended(" --against x=" + x["x"].dump() + ",y=" + x["y"].dump());
  EXPECT_EQ(same["against"], x);
  EXPECT_EQ(same["x"], x) << "of all that are no worse it is the nearest to the best of both";
  for (const char* figure : {"gain", "gain_lower", "gain_upper"})
    EXPECT_EQ(same["responses"]["cost"][figure].get<double>(), 0.0) << figure;
  const auto refused = [&](const std::string& point, const std::string& words) {
    expect_refused(study + " recommend --against " + point + out(), 2, "--against: " + words);
  };
  refused("x=1", "y is missing; give NAME=VALUE,... for each of x, y");
  refused("x=1,x=0", "x stands there twice");
  refused("x=1,z=0", "\"z=0\" names no variable");
  refused("x=1,y=much", "y = \"much\" is no number");
  refused("x=7,y=0", "x = 7 m is outside its range 0 to 1 m");
  // The command that it gives simulates this point alone.
  const std::string line = said["confirm"];
  ASSERT_EQ(run(study + line.substr(line.find(' '))).code, 0);
  EXPECT_EQ(count("kind = 'confirmation'"), 1);
  EXPECT_EQ(query("SELECT x FROM runs WHERE kind = 'confirmation'"),
            query("SELECT " + said["x"]["x"].dump()));
}

TEST_F(Recommending, APlaceThatWasSimulatedIsSaidWithItsRunAndNotMadeAgain) {
  ASSERT_EQ(run(study + " --runs 12 --validation 4" + out()).code, 0);
  const std::string place = " confirm --points 0 --x=0.25,5" + out();
  ASSERT_EQ(run(study + place).code, 0);
  ASSERT_EQ(count("kind = 'confirmation'"), 1);
  const Ended again = run(study + place);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(contains(again.out,
                       "nothing to simulate: --x=0.25,5 was simulated before, by run 17; the report "
                       "has what came out\n"));
  EXPECT_FALSE(contains(again.out, "every point of the front that matters"));
  EXPECT_EQ(count("kind = 'confirmation'"), 1);
  // Beside a new one it is said too; of one that failed, how it is made again.
  const Ended two = run(study + " confirm --points 0 --x=0.25,5 --x=0.3,6" + out());
  EXPECT_TRUE(contains(two.out, "--x=0.25,5 was simulated before, by run 17"));
  EXPECT_TRUE(contains(two.out, "round 1: 1 point to simulate"));
  const std::string bad = " confirm --points 0 --rounds 1 --x=0.75,5" + out();
  ASSERT_EQ(run("env TROUBLE=throw " + study + bad + " --no-spot-check").code, 0);
  const Ended failed = run(study + bad);
  EXPECT_TRUE(contains(failed.out,
                       "--x=0.75,5 was tried before, by run 19, which failed; --retry-failed makes "
                       "it again\n"));
  // The front's own words are for the front.
  const Ended asked = run(study + " confirm --points 60 --rounds 30" + out());
  EXPECT_EQ(asked.code, 0) << asked.err;
}

}  // namespace
