// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A folder belongs to one study: same options resume it, other options are refused with what differs, and
/// nothing in it changes.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/option_values.h>
#include <sys/wait.h>
#include <drawpoint/doe/problem_json.hpp>

#include <nlohmann/json.hpp>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

using test::complaint;
using test::TestFolder;

Study sample() {
  return {.name = "sample",
          .problem = test::two_by_two(),
          .black_box =
              [](const Eigen::VectorXd& x) {
                return doe::Outcome{x[0], x[1]};
              },
          .defaults = {.runs = 6, .validation = 2}};
}

class SessionTest : public testing::Test {
 protected:
  std::string refused(const Study& study, const Settings& settings) {
    const std::string before = test::contents(folder_.store());
    const std::string text = complaint([&] { plan_study(study, folder_, settings); });
    EXPECT_EQ(test::contents(folder_.store()), before);
    EXPECT_THROW(plan_study(study, folder_, settings), UsageError);
    return text;
  }

  TestFolder place_;
  const Folder folder_{place_.path()};
};

TEST_F(SessionTest, NumbersComeFromOptionsThenTheStoreThenTheStudy) {
  EXPECT_EQ(plan_study(sample(), folder_, {}).runs().size(), 8u);
  EXPECT_EQ(plan_study(sample(), folder_, {.plan = {.runs = 9, .validation = 3}}).runs().size(), 12u);
  EXPECT_EQ(plan_study(sample(), folder_, {}).runs().size(), 12u);
}

TEST_F(SessionTest, SamplingComesFromOptionsThenTheStoreThenTheStudy) {
  Study study = sample();
  study.defaults.adaptive = 5;
  EXPECT_EQ(plan_study(study, folder_, {}).sampling().points, 5);
  EXPECT_EQ(plan_study(study, folder_, {.plan = {.adaptive = 9, .batch = 3}}).sampling().points, 9);
  const Store store = plan_study(study, folder_, {.plan = {.criteria = "error", .target = 0.1}});
  EXPECT_EQ(store.sampling().points, 9);
  EXPECT_EQ(store.sampling().batch, 3);
  EXPECT_EQ(store.sampling().criteria, "error");
  EXPECT_EQ(store.sampling().target, 0.1);
  EXPECT_EQ(store.runs().size(), 8u);  // adaptive points are planned when their turn comes
}

TEST_F(SessionTest, AdaptivePointsDoNotShrinkAndATargetNeedsValidation) {
  {
    Store store = plan_study(sample(), folder_, {.plan = {.validation = 0, .adaptive = 4}});
    const Eigen::MatrixXd X = Eigen::MatrixXd::Constant(3, 2, 0.5);
    store.add(runs_at(store.identity(), store.runs(), Kind::adaptive, {.X = X}));
  }
  EXPECT_NE(refused(sample(), {.plan = {.adaptive = 2}}).find("--adaptive 3 or more"), std::string::npos);
  EXPECT_NE(refused(sample(), {.plan = {.target = 0.1}}).find("--validation 10 or more"), std::string::npos);
  EXPECT_EQ(plan_study(sample(), folder_, {.plan = {.adaptive = 3}}).sampling().points, 3);
}

TEST_F(SessionTest, DoneRunsStayWhenTheStudyGrows) {
  {
    Store store = plan_study(sample(), folder_, {});
    for (const auto& run : store.runs()) store.save_done(run.id, run.x * 2.0, 0.1);
  }
  const Store store = plan_study(sample(), folder_, {.plan = {.runs = 7}});
  int done = 0;
  for (const auto& run : store.runs()) {
    if (run.status != Status::done) continue;
    ++done;
    EXPECT_EQ(run.y, run.x * 2.0);
  }
  EXPECT_EQ(done, 8);
  EXPECT_EQ(store.runs().size(), 9u);
}

TEST_F(SessionTest, OtherOptionsAreRefused) {
  plan_study(sample(), folder_, {});
  const std::string text = refused(sample(), {.plan = {.seed = 7}});
  EXPECT_EQ(text, "studies: " + place_.path().string() +
                      " holds another study: seed 1 there, 7 here; choose another folder with --out, or move "
                      "this one away");
  EXPECT_NE(refused(sample(), {.plan = {.replicates = 2}}).find("replicates 1 there, 2 here"),
            std::string::npos);
  EXPECT_NE(refused(sample(), {.plan = {.runs = 3}}).find("--runs 6 or more"), std::string::npos);
  EXPECT_EQ(plan_study(sample(), folder_, {.plan = {.seed = 1}}).runs().size(), 8u);
}

Study with_options_of_its_own() {
  Study study = sample();
  study.options = {{"rock", "what is loaded", "ore", {"ore", "waste"}},
                   {.name = "cycles", .help = "per run", .value = "2", .least = 1, .most = 9}};
  return study;
}

TEST_F(SessionTest, OptionsOfTheStudyBelongToTheFolder) {
  const Study study = with_options_of_its_own();
  const Store store = plan_study(study, folder_, {.options = {{"rock", "waste"}}});
  EXPECT_EQ(store.identity().options, (OptionValues{{"rock", "waste"}, {"cycles", "2"}}));
  EXPECT_EQ(plan_study(study, folder_, {}).identity().options, store.identity().options);
  EXPECT_EQ(plan_study(study, folder_, {.options = {{"cycles", "2"}}}).runs().size(), 8u);
  EXPECT_NE(refused(study, {.options = {{"rock", "ore"}}}).find("option rock: waste there, ore here"),
            std::string::npos);
  EXPECT_NE(refused(sample(), {}).find("option cycles: 2 there, none here"), std::string::npos);
}

// The new option counts as it was before; the file, and what its runs are told, do not depend on the default.
TEST_F(SessionTest, AFolderOutlivesANewOption) {
  Study study = with_options_of_its_own();
  plan_study(study, folder_, {});
  study.options.push_back({.name = "walls", .value = "rough", .choices = {"rough", "smooth"}});
  EXPECT_NE(refused(study, {}).find("option walls: none there, rough here"), std::string::npos);
  study.options.back().before = "smooth";
  EXPECT_EQ(open_store(study, folder_).identity().options.at("walls"), "smooth");
  EXPECT_EQ(plan_study(study, folder_, {.options = {{"walls", "smooth"}}}).runs().size(), 8u);
  EXPECT_NE(refused(study, {.options = {{"walls", "rough"}}}).find("option walls: smooth there, rough here"),
            std::string::npos);
  EXPECT_FALSE(Store::open(folder_.store()).identity().options.contains("walls"));
  study.options.back().before = "soft";
  EXPECT_NE(complaint([&] { check(study.options); }).find("before an option came"), std::string::npos);
}

TEST_F(SessionTest, OptionsThatCannotGoTogetherAreRefusedBeforeAFolderIsMade) {
  Study study = with_options_of_its_own();
  study.options_complaint = [](const OptionValues& options) -> std::string {
    return options.at("rock") == "waste" && options.at("cycles") == "2" ? "--rock waste takes 3 cycles" : "";
  };
  EXPECT_EQ(complaint([&] {
              check_new_study(study, {.options = {{"rock", "waste"}}});
            }),
            "--rock waste takes 3 cycles");
  EXPECT_NO_THROW(check_new_study(study, {.options = {{"rock", "waste"}, {"cycles", "3"}}}));
}

TEST(StudyOptions, ValuesAreCheckedInWords) {
  const auto options = with_options_of_its_own().options;
  EXPECT_EQ(complaint(options[0], "waste"), "");
  EXPECT_EQ(complaint(options[0], "coal"),
            "\"coal\" is not one of the values of --rock; allowed: ore, waste");
  EXPECT_EQ(complaint(options[1], "9"), "");
  for (const char* wrong : {"0", "10", "2.5", "two", "", " 2"})
    EXPECT_EQ(complaint(options[1], wrong),
              "\"" + std::string(wrong) +
                  "\" is not one of the values of --cycles; allowed: whole numbers "
                  "from 1 to 9");
}

TEST(StudyOptions, NamesAndDefaultsAreChecked) {
  const auto text = [](const StudyOption& option) { return complaint([&] { check({option}); }); };
  for (const char* name : {"", "Rock", "1st", "a b", "runs", "seed"})
    EXPECT_NE(text({name, "", "a", {"a"}}).find("cannot name an option"), std::string::npos) << name;
  EXPECT_NE(text({"rock", "", "b", {"a"}}).find("default of an option"), std::string::npos);
  EXPECT_NO_THROW(check({{"rock", "", "a", {"a"}}, {.name = "n-2", .value = "3", .least = 1, .most = 3}}));
}

TEST_F(SessionTest, OtherProblemsAreRefused) {
  plan_study(sample(), folder_, {});
  Study other = sample();
  other.problem.variables[0].upper = 2.5;
  EXPECT_NE(refused(other, {}).find("variable \"alpha\": upper bound 2.0 there, 2.5 here"),
            std::string::npos);
  other = sample();
  other.problem.responses[1].limit = 0.3;
  EXPECT_NE(refused(other, {}).find("response \"spill\": limit 0.25 there, 0.3 here"), std::string::npos);
  other = sample();
  other.problem.responses[0].goal = doe::Goal::minimize;
  EXPECT_NE(refused(other, {}).find("goal maximize there, minimize here"), std::string::npos);
  other = sample();
  other.problem.variables.pop_back();
  EXPECT_NE(refused(other, {}).find("variables are alpha, lip there, alpha here"), std::string::npos);
  other = sample();
  other.name = "other";
  EXPECT_NE(refused(other, {}).find("name \"sample\" there, \"other\" here"), std::string::npos);
}

TEST_F(SessionTest, LogsWithoutAStoreAreNotWrittenOver) {
  std::filesystem::create_directories(folder_.logs());
  plan_study(sample(), folder_, {});
  test::write_file(folder_.log(3), "raw");
  plan_study(sample(), folder_, {});
  std::filesystem::remove(folder_.store());
  const std::string text = complaint([&] { plan_study(sample(), folder_, {}); });
  EXPECT_NE(text.find("has logs of runs, such as run_0003.h5, and no study.db"), std::string::npos) << text;
  EXPECT_FALSE(std::filesystem::exists(folder_.store()));
  std::filesystem::remove(folder_.log(3));
  EXPECT_EQ(plan_study(sample(), folder_, {}).runs().size(), 8u);
}

TEST_F(SessionTest, AMissingStudySaysSo) {
  EXPECT_NE(complaint([&] { open_store(sample(), folder_); }).find("there is no study in"),
            std::string::npos);
}

TEST(Problems, SurviveTheStoreAsText) {
  doe::Problem problem = test::two_by_two();
  const doe::Problem real = problem;
  for (const bool discrete : {false, true}) {
    if (discrete)
      problem.variables = {doe::integer_variable("teeth", "1", 2, 6),
                           doe::categorical_variable("tool", {"a", "b"})};
    EXPECT_EQ(difference(doe::problem_from_json(nlohmann::json::parse(to_json(problem).dump())), problem),
              "");
  }
  problem.responses[0].lower = 0;
  const doe::Problem read = doe::problem_from_json(nlohmann::json::parse(to_json(problem).dump()));
  EXPECT_EQ(difference(read, problem), "");
  EXPECT_EQ(difference(real, problem).empty(), false);
  doe::Problem other = problem;
  other.responses[0].upper = 800;
  EXPECT_EQ(difference(problem, other), "response \"production\": largest value none there, 800.0 here");
  other = problem;
  other.responses[1].standard_error = "production_error";
  EXPECT_EQ(difference(doe::problem_from_json(nlohmann::json::parse(to_json(other).dump())), other), "");
  EXPECT_EQ(difference(problem, other), "response \"" + problem.responses[1].name +
                                            "\": standard error \"\" there, \"production_error\" here");
  doe::Problem counted = other;
  counted.responses[1].standard_error_freedom = 2;
  EXPECT_EQ(difference(doe::problem_from_json(nlohmann::json::parse(to_json(counted).dump())), counted), "");
  EXPECT_EQ(difference(other, counted),
            "response \"" + problem.responses[1].name +
                "\": degrees of freedom of the standard error 0.0 there, 2.0 here");
  other = problem;
  other.variables[1].levels[1] = "c";
  EXPECT_EQ(difference(problem, other), "variable \"tool\": levels [\"a\",\"b\"] there, [\"a\",\"c\"] here");
  other = real;
  other.variables[0].kind = doe::VariableKind::integer;
  EXPECT_EQ(difference(real, other),
            "variable \"" + other.variables[0].name + "\": kind real there, integer here");
}

/// The sample study as it may be later: its first response tells its error.
Study later(Study study) {
  study.problem.responses[0].standard_error = "error";
  study.problem.responses.push_back({.name = "error",
                                     .unit = study.problem.responses[0].unit,
                                     .goal = doe::Goal::record,
                                     .lower = 0,
                                     .description = "of the first"});
  return study;
}

TEST(Problems, AreKnownBeforeTheirLaterResponses) {
  const doe::Problem before = test::two_by_two();
  Study study;
  study.problem = before;
  const doe::Problem after = later(study).problem;
  const auto found = before_later_responses(before, after);
  ASSERT_TRUE(found);
  EXPECT_EQ(difference(*found, before), "");
  EXPECT_FALSE(before_later_responses(before, before));
  EXPECT_FALSE(before_later_responses(after, before));
  doe::Problem other = after;
  other.responses.back().goal = doe::Goal::minimize;
  EXPECT_FALSE(before_later_responses(before, other)) << "a new objective makes another study";
  other = after;
  other.variables[0].upper += 1;
  EXPECT_FALSE(before_later_responses(before, other));
}

// A folder is read as it was begun, and takes no run that would have more responses than its others.
TEST_F(SessionTest, AFolderOfBeforeIsReadAndTakesNoRuns) {
  plan_study(sample(), folder_, {});
  const Study now = later(sample());
  EXPECT_EQ(as_begun(now, folder_).problem.responses.size(), sample().problem.responses.size());
  EXPECT_NO_THROW(open_store(as_begun(now, folder_), folder_));
  const std::string text = complaint([&] { open_store(now, folder_); });
  EXPECT_NE(text.find("was begun before the study had its last responses, error among them; begin another "
                      "folder with --out"),
            std::string::npos)
      << text;
  Study with_logs = now;
  with_logs.logs.responses = [](const std::filesystem::path&, const OptionValues&) {
    return doe::Failure{"none"};
  };
  EXPECT_NE(complaint([&] { open_store(with_logs, folder_); }).find("rerun-responses --from"),
            std::string::npos);
  EXPECT_EQ(as_begun(now, Folder{"/nowhere"}).problem.responses.size(), now.problem.responses.size());
}

// What is wrong with a store is said by the command that opens it, not by a look before: the live page waits
// for a store that is damaged or busy, and others clean up after a writer that died.
TEST_F(SessionTest, ALookAtAFolderOfBeforeLeavesFaultsToOthers) {
  test::write_file(folder_.store(), "no database");
  EXPECT_EQ(as_begun(later(sample()), folder_).problem.responses.size(), 3u);
  EXPECT_THROW(open_store(sample(), folder_), std::runtime_error);
}

TEST(Folders, ARegularFileInTheWayIsNamed) {
  const TestFolder place;
  test::write_file(place / "taken", "x");
  const std::string text = complaint([&] { make_writable(Folder{place / "taken"}); });
  EXPECT_NE(text.find((place / "taken").string()), std::string::npos) << text;
  EXPECT_NE(text.find("--out"), std::string::npos) << text;
}

TEST(Folders, OneProcessAtATime) {
  const TestFolder place;
  const Folder folder{place.path()};
  const FolderLock lock(folder);
  const std::string text = complaint([&] { FolderLock second(folder); });
  EXPECT_NE(text.find("another process (number " + std::to_string(getpid()) + ") is working in"),
            std::string::npos)
      << text;
}

TEST(Folders, ALockDiesWithItsProcess) {
  const TestFolder place;
  const Folder folder{place.path()};
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(folder);
    raise(SIGKILL);
  }
  waitpid(child, nullptr, 0);
  const FolderLock lock(folder);
  EXPECT_EQ(test::contents(place / ".lock"), std::to_string(getpid()));
}

TEST(BlackBoxes, MayTakeSeedAndContext) {
  const RunContext context{.log = "run.h5", .shared = "shared"};
  const Eigen::VectorXd x = Eigen::Vector2d(1.0, 2.0);
  const StudyFunction plain = [](const Eigen::VectorXd& p) { return p.sum(); };
  const StudyFunction seeded = [](const Eigen::VectorXd& p, doe::Seed seed) {
    return p[0] + static_cast<double>(seed);
  };
  const StudyFunction full = [](const Eigen::VectorXd&, doe::Seed, const RunContext& c) {
    return doe::Outcome(doe::Failure{c.log.string() + c.shared.string()});
  };
  EXPECT_EQ(plain(x, 5, context).values()[0], 3.0);
  EXPECT_EQ(seeded(x, 5, context).values()[0], 6.0);
  EXPECT_EQ(full(x, 5, context).reason(), "run.h5shared");
  EXPECT_FALSE(static_cast<bool>(StudyFunction()));
}

}  // namespace
