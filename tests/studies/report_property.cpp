// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>
#include <unistd.h>

#include <drawpoint/studies/say/findings.h>
#include <drawpoint/studies/say/page/assets.h>
#include <drawpoint/studies/say/page/page.h>
#include <drawpoint/tests/studies/report_cases.hpp>
#include <drawpoint/tests/support/told.hpp>
#include <regex>

using namespace drawpoint;
using namespace drawpoint::studies;
using namespace drawpoint::studies::report_cases;

namespace {

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("drawpoint_report_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file() const { return folder_ / "report.html"; }

  nlohmann::json written(const ReportInput& in) const {
    write_report(file(), in);
    return data_in(text_of(file()));
  }

  std::ptrdiff_t files() const {
    return std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator());
  }

  std::filesystem::path folder_;
};

/// The page without what stands between <script> and </script>: all that a browser reads as markup.
std::string markup(const std::string& page) {
  std::string rest;
  for (std::size_t at = 0; at != std::string::npos;) {
    const std::size_t open = page.find("<script", at);
    const std::size_t end_of_tag = open == std::string::npos ? open : page.find('>', open) + 1;
    rest += page.substr(at, end_of_tag == std::string::npos ? end_of_tag : end_of_tag - at);
    at = end_of_tag == std::string::npos ? end_of_tag : page.find("</script", end_of_tag);
  }
  return rest;
}

bool mentions(const nlohmann::json& texts, const std::string& part) {
  for (const auto& text : texts)
    if (text.get<std::string>().find(part) != std::string::npos) return true;
  return false;
}

/// Predictions off by this share of the range.
void miss_by(kriging::Validation& v, double share) {
  v.rmse = share * (v.observed.maxCoeff() - v.observed.minCoeff());
  v.nrmse = share;
  v.predicted = v.observed.array() + v.rmse;
}

}  // namespace

TEST_F(Report, LoadsNothing) {
  write_report(file(), input(2, 2, 8, 4));
  const std::string page = text_of(file()), tags = markup(page);
  EXPECT_GT(page.size(), 4'000'000u) << "the libraries are inside";
  EXPECT_FALSE(std::regex_search(tags, std::regex("(src|href|srcset|action) *=", std::regex::icase)));
  EXPECT_EQ(tags.find("@import"), std::string::npos);
  EXPECT_EQ(tags.find("url("), std::string::npos);
  EXPECT_NE(tags.find("content=\"default-src 'none'; script-src 'unsafe-inline'"), std::string::npos)
      << "the page forbids the browser any network";
  EXPECT_EQ(page.find("@DRAWPOINT_"), std::string::npos) << "every place is filled";
}

// Opened as a file, a page may not store anything.
TEST_F(Report, KeepsNothingInTheBrowser) {
  const std::string_view app = detail::app_asset();
  for (const char* store : {"localStorage", "sessionStorage", "indexedDB", "document.cookie"})
    EXPECT_EQ(app.find(store), std::string_view::npos) << store;
}

TEST_F(Report, IsForScreensOfEitherColourAndForPaper) {
  write_report(file(), input(2, 2, 8, 4));
  const std::string page = text_of(file());
  for (const char* part :
       {"content=\"light dark\"", ":root[data-theme=\"dark\"]", "@media print", "prefers-color-scheme: dark",
        "Clear selection", "Save as SVG", "Parallel coordinates of all designs", "Side by side"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST_F(Report, NoTextBecomesMarkup) {
  ReportInput in = input(2, 2, 8, 4);
  in.study = in.about = in.command = nasty;
  in.problem.variables[0].name = in.problem.responses[0].unit = "<b>" + std::string(R"(&%{x})");
  in.validation.rows[0].outcome = doe::Failure{nasty};
  in.facts = {{nasty, nasty}};
  in.warnings = {nasty};
  in.findings = {{"F1", nasty, Verdict::unclear, nasty}};
  in.illustrations = {
      {{"type", "table"}, {"title", nasty}, {"caption", nasty}, {"columns", {nasty}}, {"rows", {{nasty}}}}};
  const auto data = written(in);
  const std::string page = text_of(file());
  std::size_t scripts = 0;
  for (std::size_t at = page.find("<script"); at != std::string::npos; at = page.find("<script", at + 1)) {
    const std::size_t end = page.find("</script", at);
    ASSERT_NE(end, std::string::npos);
    ++scripts;
    at = end;
  }
  EXPECT_EQ(scripts, 3u) << "data, plotly.js, the page's own";
  EXPECT_NE(page.find("<title>&lt;/script&gt;"), std::string::npos);
  const std::string readable =
      nasty.substr(0, nasty.size() - 1) + "\xEF\xBF\xBD";  // the broken byte is replaced
  EXPECT_EQ(data.at("study"), readable);
  EXPECT_EQ(data.at("facts").at(0).at(1), readable);
  EXPECT_EQ(data.at("validation").at("rows").at(0).at("reason"), readable);
  EXPECT_EQ(data.at("findings").at(0).at(1), readable);
  EXPECT_EQ(data.at("illustrations").at(0).at("rows").at(0).at(0), readable);
}

TEST_F(Report, SaysTheFindingsApartFromTheFiguresOfOneRun) {
  ReportInput in = input(1, 1, 8, 0);
  EXPECT_TRUE(written(in).at("findings").empty());
  in.findings = {{"F1", "it pays", Verdict::not_reproduced, "0.1"}, {"F2", "it costs", Verdict::unclear, ""}};
  const auto data = written(in);
  EXPECT_EQ(data.at("findings"),
            nlohmann::json({{"F1", "it pays", "not reproduced", "0.1"}, {"F2", "it costs", "unclear", ""}}));
  EXPECT_TRUE(data.at("illustrations").empty());
}

// Runs 6 and 7 were chosen where the study looked: a claim about the whole box is not held against them.
TEST_F(Report, FindingsAreHeldAgainstTheFirstDesign) {
  ReportInput in = input(2, 2, 8, 3);
  in.kinds = {{0, "training"}, {6, "adaptive"}, {7, "confirmation"}};
  StudyResults held;
  const Study study{.presentation = {.findings = [&](const StudyResults& results) {
                      held = results;
                      return std::vector<Finding>();
                    }}};
  hold_findings(in, study, {}, {}, Folder{});
  EXPECT_EQ(held.X, in.training.X().topRows(6));
  EXPECT_EQ(held.Y.rows(), 6);
  EXPECT_EQ(held.logs.size(), 6u);
  EXPECT_EQ(held.X_new.rows(), 3);
}

TEST_F(Report, CopesWithAnyNumberOfVariablesAndResponses) {
  for (const auto& [d, r] : {std::pair{1, 1}, {1, 3}, {2, 1}, {3, 2}, {7, 4}}) {
    const auto data = written(input(d, r, 12, 10));
    EXPECT_EQ(data.at("models").size(), static_cast<std::size_t>(r));
    EXPECT_EQ(data.at("influence").at(0).size(), static_cast<std::size_t>(d));
    EXPECT_EQ(data.at("summary").at("trust").size(), static_cast<std::size_t>(r));
    EXPECT_LT(data.at("main_pair").at(1), d);
    EXPECT_EQ(data.at("front").at("X").size(), 12u);
  }
}

TEST_F(Report, WithoutValidationRunsNothingIsCalledGood) {
  const auto data = written(input(2, 2, 8, 0));
  EXPECT_TRUE(data.at("validations").at(0).is_null());
  for (const auto& verdict : data.at("summary").at("trust")) EXPECT_EQ(verdict.at("grade"), "unknown");
}

TEST_F(Report, CarriesTheCertificateOfEveryPoint) {
  ReportInput in = input(2, 2, 8, 0);
  EXPECT_TRUE(written(in).at("polishing").at("residual").empty());
  in.polishing.residual = Eigen::VectorXd::Constant(8, 1e-9);
  in.polishing.residual[3] = std::nan("");
  in.polishing.gain = 0.4;
  const auto polishing = written(in).at("polishing");
  EXPECT_EQ(polishing.at("certified"), 7);
  EXPECT_TRUE(polishing.at("residual").at(3).is_null());
  EXPECT_EQ(polishing.at("gain"), 0.4);
  in.polishing.residual.resize(5);
  try {
    written(in);
    FAIL() << "5 residuals for 8 points were taken";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(),
                 "studies::write_report: 5 residuals for 8 points of the front; give one each or none");
  }
}

TEST_F(Report, SaysHowLikelyARunSucceeds) {
  ReportInput in = input(2, 2, 8, 0);
  EXPECT_TRUE(written(in).at("front").at("success").empty());
  in.success = Eigen::VectorXd::LinSpaced(8, 0.6, 0.95);
  EXPECT_EQ(written(in).at("front").at("success").at(7), 0.95);
  in.success.resize(5);
  support::expect_told([&] { written(in); }, {"5 probabilities of success for 8 points of the front"});
}

TEST_F(Report, SaysHowSureTheFrontIs) {
  ReportInput in = input(2, 2, 8, 0);
  EXPECT_TRUE(written(in).at("front").at("non_dominated").empty());
  in.uncertainty.non_dominated = Eigen::VectorXd::LinSpaced(8, 0.25, 1.0);
  const double never = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d at(1, 2), best(3, 4), middle(5, 6), worst(7, never);
  in.uncertainty.bands = {{0, 1, at, best, middle, worst}};
  const auto front = written(in).at("front");
  EXPECT_EQ(front.at("non_dominated").at(0), 0.25);
  EXPECT_TRUE(mentions(written(in).at("summary").at("sentences"), "5 of these 8 points are non-dominated"));
  EXPECT_EQ(front.at("bands").at(0).at("second"), 1);
  EXPECT_EQ(front.at("bands").at(0).at("optimistic"), nlohmann::json({3.0, 4.0}));
  EXPECT_EQ(front.at("bands").at(0).at("pessimistic").at(0), 7.0);
  EXPECT_TRUE(front.at("bands").at(0).at("pessimistic").at(1).is_null());
  in.uncertainty.non_dominated.resize(5);
  support::expect_told([&] { written(in); }, {"5 probabilities of being non-dominated for 8 points"});
}

TEST_F(Report, SaysWhatSimulationSaidOfTheFront) {
  ReportInput in = input(2, 2, 8, 0);
  const auto said = [&](const std::string& part) {
    return written(in).at("summary").dump().find(part) != std::string::npos;
  };
  EXPECT_TRUE(said("None of these points has been simulated"));
  const Eigen::Vector2d x(0.5, 1.0), mean(2.0, 1.0);
  in.confirmations = {.runs = {{.run = 9,
                                .round = 2,
                                .x = x,
                                .outcome = Eigen::VectorXd(Eigen::Vector2d(2.1, 5.0)),
                                .predicted = mean,
                                .lower = mean.array() - 0.2,
                                .upper = mean.array() + 0.2,
                                .within = {true, false},
                                .values = 18,
                                .held = 16,
                                .dominated = true},
                               {.run = 10,
                                .round = 2,
                                .x = x,
                                .outcome = doe::Failure{nasty},
                                .predicted = mean,
                                .lower = mean,
                                .upper = mean,
                                .within = {false, false}}},
                      .values = 18,
                      .within = 16,
                      .failed = 1,
                      .dominated = 1};
  in.kinds = {{0, "training"}, {1, "adaptive"}};
  const auto data = written(in);
  const auto& rows = data.at("confirmations").at("rows");
  EXPECT_EQ(rows.at(0).at("within"), nlohmann::json({true, false}));
  EXPECT_EQ(rows.at(0).at("y"), nlohmann::json({2.1, 5.0}));
  EXPECT_TRUE(rows.at(1).at("y").is_null());
  EXPECT_EQ(data.at("training").at("rows").at(1).at("kind"), "adaptive");
  EXPECT_TRUE(said("7 training, 1 adaptive, 0 validation"));
  EXPECT_EQ(data.at("front").at("lower").size(), 8u);
  EXPECT_EQ(data.at("front").at("upper").size(), 8u);
  EXPECT_FALSE(said("None of these points"));
  EXPECT_TRUE(said("16 of 18 values within the stated 95 % interval"));
  EXPECT_TRUE(said("1 of 2 points of predicted fronts failed"));
  // Two misses or more of 18 happen by chance in 0.23 of all cases, three or more in 0.06.
  EXPECT_FALSE(said("promised what simulation did not keep"));
  in.confirmations.runs[0].held = 15;
  EXPECT_TRUE(said("promised what simulation did not keep"));
}

// Of y0 = 1, 2, ... 8 the limit at 3.5 lets three through, and the best of y1 among these counts.
TEST_F(Report, MarksRunsThatBreakALimit) {
  ReportInput in = input(2, 2, 8, 0);
  for (const auto& row : written(in).at("training").at("rows")) EXPECT_TRUE(row.at("breaks").empty());
  in.problem.responses[0].goal = doe::Goal::at_most;
  in.problem.responses[0].limit = 3.5;
  in.training.problem = in.problem;
  for (int i = 0; i < 8; ++i)
    in.training.rows[static_cast<std::size_t>(i)].outcome =
        doe::Outcome(Eigen::VectorXd(Eigen::Vector2d(1.0 + i, 8.0 - i)));
  in.training.rows[1].outcome = doe::Failure{"stuck"};
  in.front.Y = in.front.Y.col(1).eval();
  const auto data = written(in);
  const auto& rows = data.at("training").at("rows");
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_EQ(rows.at(i).at("breaks"), i < 3 ? nlohmann::json::array() : nlohmann::json({0})) << i;
  EXPECT_TRUE(mentions(data.at("summary").at("sentences"),
                       "the best of 2 single runs within the limits, run 2, gave 6.00 s"));
  EXPECT_TRUE(mentions(data.at("summary").at("sentences"),
                       "The lowest y1 within the limits that the surrogates predict"));
  EXPECT_EQ(data.at("summary").at("cards").at(0).at("label"), "Lowest y1 predicted within the limits");
}

TEST_F(Report, SaysThatAllRunsFailed) {
  const auto data = written(failed_input());
  EXPECT_TRUE(data.at("models").empty());
  EXPECT_EQ(data.at("front").at("X").size(), 0u);
  EXPECT_TRUE(mentions(data.at("summary").at("sentences"), "No training run succeeded"));
  EXPECT_TRUE(mentions(data.at("summary").at("cautions"), "8 of 8 runs failed (100 %)"));
  EXPECT_EQ(data.at("summary").at("trust").at(1).at("grade"), "unknown");
  EXPECT_EQ(data.at("summary").at("next").at(0).at("command"), "run --retry-failed");
}

TEST_F(Report, TellsNoiseFromErrorsOfTheSurrogate) {
  ReportInput in = input(2, 1, 8, 6);
  kriging::Validation& v = in.validations[0];
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(50);
  v = {.rmse = 5.0,
       .nrmse = 0.31,
       .observed = ones,
       .predicted = 5 * ones,
       .variance = ones,
       .observation_variance = 17 * ones};
  v.observed.head(25).setConstant(0);
  v.observed.tail(25).setConstant(10);
  const auto data = written(in);
  const std::string grade = data.at("summary").at("trust").at(0).at("text");
  EXPECT_EQ(grade.find("is predicted in the mean of many runs with a typical error of 3.00 s, 30 % of the "
                       "range seen ("),
            0u)
      << grade;
  EXPECT_NE(grade.find("; single runs scatter by 4.00 s and are missed by 5.00 s (NRMSE 31 %)"),
            std::string::npos)
      << grade;
  const auto& ends = data.at("validations").at(0).at("mean_nrmse");
  EXPECT_LT(ends.at(1), ends.at(0));
  EXPECT_GT(ends.at(2), ends.at(0));
  EXPECT_EQ(data.at("validations").at(0).at("noise"), 4.0);
  EXPECT_EQ(data.at("validations").at(0).at("rmse_without_noise").at(0), 3.0);
  EXPECT_TRUE(mentions(data.at("summary").at("cautions"), "single runs scatter by more than that"));
}

// Of exact responses a fit has the least noise that it can have; of one run none is known.
TEST_F(Report, SaysNothingOfNoiseThatIsNone) {
  ReportInput in = input(2, 1, 8, 6);
  kriging::Validation& v = in.validations[0];
  v = {.rmse = 1e-6,
       .nrmse = 1e-7,
       .observed = Eigen::Vector2d(0, 10),
       .predicted = Eigen::Vector2d(0, 10),
       .variance = Eigen::Vector2d(0, 0),
       .observation_variance = Eigen::Vector2d(1e-10, 1e-10)};
  auto data = written(in);
  EXPECT_TRUE(data.at("validations").at(0).at("noise").is_null());
  v.variance = v.observation_variance = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  data = written(in);
  EXPECT_TRUE(data.at("validations").at(0).at("noise").is_null());
  EXPECT_EQ(data.at("summary").at("trust").at(0).at("text").get<std::string>().find("scatters"),
            std::string::npos);
}

TEST_F(Report, FlagsWhatCannotBeTrusted) {
  ReportInput in = input(2, 1, 8, 6);
  in.validation.rows[3].outcome = doe::Failure{"stuck"};
  // Of the range of all runs, training runs too.
  const Eigen::VectorXd y = in.training.y("y0"), observed = in.validations[0].observed;
  const double all =
      std::max(y.maxCoeff(), observed.maxCoeff()) - std::min(y.minCoeff(), observed.minCoeff());
  miss_by(in.validations[0], 0.31 * all / (observed.maxCoeff() - observed.minCoeff()));
  in.front.Y(0, 0) = 1e3;
  in.warnings = {"mind this"};
  const auto data = written(in);
  const auto& cautions = data.at("summary").at("cautions");
  EXPECT_EQ(cautions.at(0), "mind this");
  EXPECT_TRUE(mentions(cautions, "1 of 14 runs failed (7.1 %)"));
  EXPECT_TRUE(mentions(cautions, "y0 is poor: it misses the mean by 31 % of the range seen ("));
  EXPECT_TRUE(mentions(cautions, "Only 5 validation points"));
  EXPECT_TRUE(mentions(cautions, "simulate it before believing it"));
  EXPECT_EQ(data.at("summary").at("trust").at(0).at("grade"), "poor");
}

/// Commands of the steps that the page names, in order.
std::vector<std::string> next_commands(const nlohmann::json& data) {
  std::vector<std::string> commands;
  for (const auto& step : data.at("summary").at("next")) commands.push_back(step.at("command"));
  return commands;
}

using Commands = std::vector<std::string>;

TEST_F(Report, SaysWhatToDoNext) {
  ReportInput in = input(2, 2, 16, 12);
  in.going_on = {.folder = " --out here", .training = 16, .validation = 12};
  EXPECT_EQ(next_commands(written(in)), Commands{"confirm --out here"});
  const Eigen::Vector2d y(1, 2);
  CheckedRun checked{.run = 30, .round = 1, .x = y, .outcome = Eigen::VectorXd(y), .values = 20, .held = 19};
  checked.predicted = checked.lower = checked.upper = y;
  checked.within = {true, true};
  in.confirmations.add(checked);
  EXPECT_EQ(next_commands(written(in)), Commands{"front --out here"});
  in.training.rows[3].outcome = doe::Failure{"stuck"};
  EXPECT_EQ(next_commands(written(in)), (Commands{"run --retry-failed --out here", "front --out here"}));
  in.confirmations = {};
  checked.held = 10;
  in.confirmations.add(checked);
  EXPECT_EQ(next_commands(written(in)).back(), "confirm --out here") << "half of the intervals do not hold";
  in.going_on = {.making = "ask", .training = 16, .validation = 12, .adaptive = 40};
  miss_by(in.validations[0], 0.3);
  EXPECT_EQ(next_commands(written(in)), (Commands{"ask --retry-failed", "ask --adaptive 54", "confirm"}));
  in.validation.rows.resize(4);
  EXPECT_EQ(next_commands(written(in)), (Commands{"ask --retry-failed", "ask --adaptive 54", "confirm"}))
      << "eight validation runs are still to come";
  in.going_on.validation = 4;
  EXPECT_EQ(next_commands(written(in)),
            (Commands{"ask --retry-failed", "ask --validation 12", "ask --adaptive 54"}))
      << "three at most";
  in.validation.rows[0].outcome = doe::Failure{"stuck"};
  EXPECT_EQ(next_commands(written(in)).at(1), "ask --validation 13");
  in.going_on.possible = false;
  EXPECT_EQ(next_commands(written(in)), Commands{""});
}

/// An error of 5 in a range of 10, poor whatever of it is noise; the model takes single runs to scatter by `noise`.
void make_poor(kriging::Validation& v, double noise) {
  v.observed = Eigen::VectorXd::LinSpaced(v.observed.size(), 0, 10);
  miss_by(v, 0.5);
  v.variance.setOnes();
  v.observation_variance = v.variance.array() + noise * noise;
}

TEST_F(Report, AdvisesQuieterRunsWhereNoiseLeads) {
  ReportInput in = input(2, 2, 8, 12);
  in.going_on.training = 8;
  make_poor(in.validations[0], 4.0);
  EXPECT_EQ(next_commands(written(in)), (Commands{"", "confirm"}));
  miss_by(in.validations[1], 0.3);
  const auto data = written(in);
  EXPECT_EQ(next_commands(data), (Commands{"", "run --runs 16", "confirm"}))
      << "not where noise would choose";
  EXPECT_EQ(data.at("summary").at("next").at(0).at("text").get<std::string>().find("Make runs quieter"), 0u);
}

// Of an error of 5 s a noise of 3 s leaves 4 s to the model, one of 4 s leaves 3; the model here knows of
// 0.1 s.
TEST_F(Report, BelievesTheStudyOfItsNoiseBeforeTheSurrogate) {
  ReportInput in = input(2, 1, 8, 12);
  make_poor(in.validations[0], 0.1);
  const std::string words = "takes a run to scatter by 0.100 s, the runs themselves say";
  EXPECT_EQ(next_commands(written(in)), (Commands{"run --adaptive 8", "confirm"}));
  EXPECT_FALSE(mentions(written(in).at("summary").at("cautions"), words)) << "nobody says";
  in.headlines = {{"noise_of_y0", "s", 3, ""}};
  EXPECT_EQ(next_commands(written(in)), (Commands{"run --adaptive 8", "confirm"}));
  EXPECT_TRUE(mentions(written(in).at("summary").at("cautions"), words));
  in.headlines[0].value = 4;
  EXPECT_EQ(next_commands(written(in)), (Commands{"", "confirm"}));
  in.headlines[0].value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(next_commands(written(in)), (Commands{"run --adaptive 8", "confirm"}));
}

// A surrogate that is poor leads nobody: what it has learned of its variables may be noise.
TEST_F(Report, SaysWhatMattersMostOnlyWhereTheSurrogateCanTell) {
  ReportInput in = input(2, 2, 8, 6);
  miss_by(in.validations[0], 0.05);
  miss_by(in.validations[1], 0.31);
  const auto sentences = written(in).at("summary").at("sentences");
  EXPECT_TRUE(mentions(sentences, "matters most is x0 for y0") ||
              mentions(sentences, "matters most is x1 for y0"))
      << sentences;
  EXPECT_TRUE(mentions(sentences, "not said for y1"));
  EXPECT_FALSE(mentions(sentences, "for y0, x"));
}

TEST_F(Report, LeavesAFaultyFigureOutAndSaysSo) {
  ReportInput in = input(2, 1, 8, 4);
  in.illustrations = {
      {{"type", "sketch"}, {"title", "t"}, {"caption", "c"}},
      {{"type", "table"}, {"title", "t"}, {"caption", "c"}, {"columns", {"a"}}, {"rows", {{1, 2}}}},
      {{"type", "table"}, {"title", "good"}, {"caption", "c"}, {"columns", {"a"}}, {"rows", {{1}}}},
      7,
      {{"type", "plan"}, {"title", "t"}, {"caption", "c"}, {"x", {1, 2}}, {"y", {1}}, {"heights", {{1.0}}}},
      {{"type", "scene"},
       {"title", "t"},
       {"caption", "c"},
       {"shapes", nlohmann::json::array()},
       {"bodies", nlohmann::json::array()},
       {"drift",
        {{"from", 2}, {"length", 1}, {"width", 6}, {"height", 5}, {"raise", {{"x", 1}, {"radius", 1}}}}}}};
  const auto data = written(in);
  ASSERT_EQ(data.at("illustrations").size(), 1u);
  EXPECT_EQ(data.at("illustrations").at(0).at("title"), "good");
  const auto& cautions = data.at("summary").at("cautions");
  EXPECT_TRUE(mentions(
      cautions, "Figure 1 of the simulation was left out: the type \"sketch\" is none of path, plan, scene"));
  EXPECT_TRUE(mentions(cautions, "Figure 2 of the simulation was left out: a row has not as many cells"));
  EXPECT_TRUE(mentions(cautions, "Figure 4 of the simulation was left out: \"type\" is missing"));
  EXPECT_TRUE(mentions(
      cautions,
      "Figure 5 of the simulation was left out: a row of \"heights\" has not one value per value of \"x\""));
  EXPECT_TRUE(mentions(cautions, "Figure 6 of the simulation was left out: the drift has no extent"));
}

TEST_F(Report, SetsRunsAgainstEachOther) {
  ReportInput in = input(2, 1, 8, 0);
  EXPECT_TRUE(written(in).at("contrasts").empty());
  in.contrasts = {
      {{"type", "table"}, {"title", "well"}, {"caption", "c"}, {"columns", {"a"}}, {"rows", {{1}}}},
      {{"type", "sketch"}, {"title", "badly"}, {"caption", "c"}}};
  const auto data = written(in);
  ASSERT_EQ(data.at("contrasts").size(), 1u);
  EXPECT_EQ(data.at("contrasts").at(0).at("title"), "well");
  EXPECT_TRUE(mentions(data.at("summary").at("cautions"), "Figure 2 of the simulation was left out"));
}

TEST_F(Report, IsWrittenWholeOrNotAtAll) {
  write_report(file(), input(1, 1, 5, 0));
  const std::string before = text_of(file());
  ReportInput wrong = input(1, 1, 5, 0);
  wrong.models.push_back(wrong.models[0]);
  try {
    write_report(file(), wrong);
    FAIL() << "two models for one response were accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "studies::write_report: 2 models for 1 responses; give one each or none");
  }
  EXPECT_EQ(text_of(file()), before);
  EXPECT_EQ(files(), 1) << "no temporary file is left";
  EXPECT_THROW(write_report(folder_ / "missing" / "report.html", input(1, 1, 5, 0)), std::runtime_error);
}
