// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What people and scripts read: progress, durations, the JSON line.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/run/progress.h>
#include <drawpoint/studies/run/store/plain_text.h>
#include <drawpoint/studies/say/study_summary.h>

#include <cmath>
#include <nlohmann/json.hpp>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

TEST(Progress, TimeLeftIsThatOfTheRestAtTheRateOfThisSession) {
  // 10 runs in 60 s of this session; 30 to go take 180 s.
  EXPECT_EQ(progress_text({.done = 20, .failed = 1, .total = 50, .session = 10, .seconds = 60.0}),
            "20/50 runs, 1 failed, 10 per minute, 3.0 min left");
  EXPECT_EQ(progress_text({.done = 20, .total = 50}), "20/50 runs");
  EXPECT_EQ(progress_text({.done = 20, .total = 50, .things = "frames"}), "20/50 frames");
  EXPECT_EQ(progress_text({.done = 0, .total = 50, .standing = "0 at work, 50 waiting (Resources)"}),
            "0/50 runs; 0 at work, 50 waiting (Resources)");
  EXPECT_EQ(progress_text({.done = 50, .total = 50, .session = 50, .seconds = 10.0}),
            "50/50 runs, 5.0 per second");
}

TEST(Progress, DurationsKeepTwoOrThreeFigures) {
  EXPECT_EQ(duration_text(0.04), "0.0 s");
  EXPECT_EQ(duration_text(42.0), "42 s");
  EXPECT_EQ(duration_text(720.0), "12 min");
  EXPECT_EQ(duration_text(4.0 * 3600.0), "4.0 h");
  EXPECT_EQ(duration_text(72.0 * 3600.0), "3.0 d");
}

TEST(Progress, ElsewhereThanOnATerminalOneLineAStep) {
  const test::TestFolder folder;
  FILE* file = std::fopen((folder / "out").c_str(), "w");
  {
    Progress progress(fileno(file), {.total = 2});
    progress.finished_one(false);
    progress.tick("");
    progress.finished_one(true);
  }
  std::fclose(file);
  const std::string text = test::contents(folder / "out");
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(text.find("0/2 runs\n"), 0u);
  EXPECT_NE(text.find("2/2 runs, 1 failed"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

TEST(PlainText, CommandsNoTerminal) {
  EXPECT_EQ(plain_text("a\tb\nc"), "a\tb\nc");
  EXPECT_EQ(plain_text("\xC3\xA9 \xE2\x82\xAC \xF0\x9F\xAA\xA8"), "\xC3\xA9 \xE2\x82\xAC \xF0\x9F\xAA\xA8");
  EXPECT_EQ(plain_text("\033[2Jx\r\a\177"), "\xE2\x90\x9B[2Jx\xE2\x90\x8D\xE2\x90\x87\xE2\x90\xA1");
  const std::string replaced = "\xEF\xBF\xBD";
  for (const char* bad : {"\xC2\x9B", "\xE2\x80\xAE", "\xE2\x81\xA6", "\xFF", "\xC0\x80", "\xE2\x80\xA8"})
    EXPECT_EQ(plain_text("a" + std::string(bad) + "b").substr(0, 4), "a" + replaced);
  EXPECT_EQ(plain_text("\xE2\x82", 100), replaced + replaced) << "cut inside a character";
}

TEST(PlainText, IsCutToAStatedLength) {
  EXPECT_EQ(plain_text("abcdef", 6), "abcdef");
  EXPECT_EQ(plain_text("abcdefg", 6), "abcdef ... (cut: it has 7 bytes)");
  EXPECT_EQ(plain_text("abcde\xC3\xA9", 6), "abcde ... (cut: it has 7 bytes)");
  EXPECT_EQ(plain_text("abcdef ... (cut: it has 7 bytes)", 6), "abcdef ... (cut: it has 7 bytes)") << "once";
  EXPECT_LT(plain_text(std::string(20000000, '\033')).size(), most_of_reason + 50);
}

TEST(JsonLine, IsOneLineWithTheDocumentedMembers) {
  Summary summary{.study = "s",
                  .ended = {{Kind::training, 40}, {Kind::adaptive, 8}, {Kind::validation, 10}},
                  .failed = 2,
                  .unfinished = 5,
                  .findings = {{"F1", "it pays", Verdict::not_reproduced, "0.1"}},
                  .nrmse = {{"production", 0.0625}, {"spill", std::nan("")}},
                  .front = 3,
                  .report = "/a \"b\"/report.html"};
  summary.polishing = {.residual = Eigen::Vector3d(1e-9, 1e-6, std::nan("")), .gain = 0.25};
  const std::string line = json_line(summary);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const auto data = nlohmann::json::parse(line);
  EXPECT_EQ(data["runs"], 58);
  EXPECT_EQ(data["adaptive"], 8);
  summary.adaptive_wanted = 20;
  EXPECT_NE(text(summary).find("8 adaptive runs, 20 adaptive points wanted"), std::string::npos);
  EXPECT_EQ(data["confirmation"], 0);
  EXPECT_EQ(data["confirmed"]["points"], 0);
  EXPECT_EQ(text(summary).find("s: 40 training, 8 adaptive and 10 validation runs, 2 failed"), 0u);
  EXPECT_EQ(data["failed"], 2);
  EXPECT_EQ(data["unfinished"], 5);
  EXPECT_NE(text(summary).find("2 failed; 5 more to be made"), std::string::npos);
  EXPECT_EQ(data["findings"]["F1"], "not reproduced");
  EXPECT_EQ(data["nrmse"]["production"], 0.0625);
  EXPECT_TRUE(data["nrmse"]["spill"].is_null());
  EXPECT_EQ(data["front"], 3);
  EXPECT_EQ(data["certified"], 2);
  EXPECT_EQ(data["polishing_gain_percent"], 0.25);
  EXPECT_FALSE(data.contains("not_polished"));
  EXPECT_EQ(data["report"], "/a \"b\"/report.html");
  EXPECT_FALSE(data.contains("error"));
}

// The error of the mean leads where single runs are noisy; where they are not it is that of runs.
TEST(Text, SaysTheErrorOfTheMeanFirst) {
  Summary summary{.study = "s", .nrmse = {{"production", 0.2}, {"spill", 0.05}}};
  summary.mean_errors["production"] = {.rmse = 3, .lower = 0, .upper = 9, .noise = 19, .range = 100};
  summary.mean_errors["spill"] = {.rmse = 5, .lower = 4, .upper = 7, .noise = 0, .range = 100};
  const std::string all = text(summary);
  EXPECT_NE(all.find("  error of the mean of production: 0.0300 of the range, 0.0000 to 0.0900 with 95 %; of "
                     "single runs: 0.2000 (NRMSE)\n  NRMSE of spill: 0.0500\n"),
            std::string::npos)
      << all;
  const auto data = nlohmann::json::parse(json_line(summary));
  EXPECT_EQ(data["mean_error"]["production"]["nrmse"], 0.03);
  EXPECT_EQ(data["mean_error"]["production"]["nrmse_upper"], 0.09);
  EXPECT_EQ(data["nrmse"]["production"], 0.2);
}

TEST(Text, SaysWhetherTheFrontWasSimulated) {
  Summary summary{.study = "s", .front = 2, .report = "/r.html"};
  const auto line = [&] {
    const std::string all = text(summary);
    const std::size_t begin = all.find("Pareto front");
    return all.substr(begin, all.find('\n', begin) - begin);
  };
  EXPECT_EQ(line(), "Pareto front: 2 points, predicted; simulate those that matter with the command confirm");
  summary.confirmations = {
      .runs = {{.run = 7}, {.run = 8}}, .values = 3, .within = 2, .failed = 1, .dominated = 1};
  EXPECT_EQ(line(),
            "Pareto front: 2 points, predicted; simulated: 2 points, 2 of 3 values within the stated 95 % "
            "interval, 1 failed, 1 dominated by earlier runs");
  EXPECT_EQ(nlohmann::json::parse(json_line(summary))["confirmed"], nlohmann::json({{"points", 2},
                                                                                    {"values", 3},
                                                                                    {"within", 2},
                                                                                    {"failed", 1},
                                                                                    {"dominated", 1},
                                                                                    {"breaking", 0},
                                                                                    {"agree", false}}));
  summary.no_front = "the models allow none";
  EXPECT_EQ(line(), "Pareto front: none, because the models allow none");
}

TEST(Text, SaysWhyAFrontIsNotPolished) {
  const Summary summary{.study = "s", .front = 2, .not_polished = "six objectives", .report = "/r"};
  EXPECT_NE(text(summary).find("Pareto front: 2 points, predicted, not polished (six objectives)"),
            std::string::npos);
  const auto data = nlohmann::json::parse(json_line(summary));
  EXPECT_TRUE(data["certified"].is_null());
  EXPECT_TRUE(data["polishing_gain_percent"].is_null());
  EXPECT_EQ(data["not_polished"], "six objectives");
}

TEST(JsonLine, WithoutAReportSaysWhy) {
  const auto data = nlohmann::json::parse(
      json_line({.study = "s", .ended = {{Kind::training, 2}}, .failed = 2, .error = "no models"}));
  EXPECT_TRUE(data["report"].is_null());
  EXPECT_EQ(data["error"], "no models");
}

}  // namespace
