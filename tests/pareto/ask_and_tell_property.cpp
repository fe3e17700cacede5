// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Laws of a search that is driven from outside, saved and resumed, for every search.

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <drawpoint/doe/detail/hash.hpp>
#include <drawpoint/pareto/moead.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/pareto/nsga3.hpp>
#include <drawpoint/pareto/sms_emoa.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/pareto/named_searches.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <ostream>
#include <string>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

using test::Named;
using test::named;

std::vector<Named> all_searches() {
  return {named<Nsga2>("nsga2", Nsga2Options{}),
          named<Nsga2>("nsga2_geometric", Nsga2Options{.elitism = Elitism::geometric}),
          named<Nsga3>("nsga3", Nsga3Options{}),
          named<SmsEmoa>("sms_emoa", SmsEmoaOptions{.children = 5}),
          named<Moead>("moead", MoeadOptions{}),
          named<Moead>("moead_pbi", MoeadOptions{.scalarisation = Scalarisation::pbi})};
}

/// Two objectives of different signs, a limit, a whole number, noise from the seed and a corner that fails.
const doe::Problem problem{
    {{"x", "m", 0.0, 1.0}, {"y", "m", -1.0, 1.0}, doe::integer_variable("n", "1", 0, 4)},
    {{"cost", "kg", doe::Goal::minimize},
     {"yield", "kg/s", doe::Goal::maximize},
     {"slope", "m", doe::Goal::at_most, 0.8}}};

doe::Outcome noisy(const Eigen::VectorXd& x, doe::Seed seed) {
  if (x[0] > 0.4 && x[1] > 0.3) return doe::Failure{"stuck\nin the \\ corner"};
  const double noise = 1e-3 * doe::RandomStream(seed).uniform();
  return {x[0] + x[1] * x[1] + 0.1 * x[2] + noise, std::sqrt(x[0]) - x[1] * x[1] + 0.2 * x[2], x[0] - x[1]};
}

SearchOptions quick(int threads = 1) {
  return {.population = 20,
          .stopping = {.generations = 12, .stall_generations = 12},
          .seed = 7,
          .threads = threads};
}

void expect_equal(const Front& a, const Front& b) {
  EXPECT_EQ(a.X, b.X);
  EXPECT_EQ(a.Y, b.Y);
  EXPECT_EQ(a.responses, b.responses);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.failed, b.failed);
  EXPECT_EQ(a.generations, b.generations);
  EXPECT_EQ(a.stopped_by, b.stopped_by);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.message, b.message);
}

/// One population asked for, evaluated and told.
void advance(Search& search) {
  const Eigen::MatrixXd X = search.ask();
  const std::vector<doe::Seed> seeds = search.seeds();
  std::vector<doe::Outcome> outcomes;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    outcomes.push_back(noisy(X.row(static_cast<Eigen::Index>(i)).transpose(), seeds[i]));
  search.tell(outcomes);
}

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// Of a checkpoint that was altered.
void fit_checksum(std::string& text) {
  text.resize(text.rfind("checksum "));
  text += "checksum " + doe::detail::checksum(text) + "\n";
}

class DrivenSearches : public testing::TestWithParam<Named> {
 protected:
  ~DrivenSearches() override { std::filesystem::remove(path_); }

  std::unique_ptr<Search> made(const SearchOptions& options = quick()) const {
    return GetParam().make(problem, options);
  }

  /// What restore says of a text in the place of a checkpoint.
  std::string refusal(Search& search, const std::string& text) const {
    write(path_, text);
    return support::thrown_text<std::runtime_error>([&] { search.restore(path_); });
  }

  const std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                      ("drawpoint-checkpoint-" + std::to_string(::getpid()) + ".txt");
};

// A search of a black box with another number of responses would else spend all of its evaluations on failures.
TEST_P(DrivenSearches, FirstValuesOfAWrongCountAreRefusedAndChangeNothing) {
  const auto search = made(), other = made();
  std::vector<doe::Outcome> outcomes(search->seeds().size(), doe::Failure{"stuck"});
  outcomes[3] = {1.0, 2.0};
  EXPECT_EQ(
      support::thrown_text<std::invalid_argument>([&] { search->tell(outcomes); }),
      "pareto::Search: the black box returned 2 values where the problem has 3 responses; return one value "
      "per response, in the order of Problem::responses");
  EXPECT_THROW(finish(*made(), [](const Eigen::VectorXd& x) { return x[0]; }), std::invalid_argument);
  expect_equal(finish(*search, noisy), finish(*other, noisy));
  const auto later = made();
  advance(*later);
  const int failed = later->front().failed, told = static_cast<int>(later->seeds().size());
  later->tell(std::vector<doe::Outcome>(later->seeds().size(), doe::Outcome{1.0, 2.0}));
  EXPECT_EQ(later->front().failed, failed + told);
  later->save(path_);
  const auto restored = made();
  restored->restore(path_);
  EXPECT_NO_THROW(restored->tell(std::vector<doe::Outcome>(told, doe::Outcome{1.0, 2.0})));
}

TEST_P(DrivenSearches, DrivenFromOutsideGiveTheSameFront) {
  const auto inside = made(), outside = made();
  while (!outside->done()) {
    EXPECT_EQ(outside->ask(), outside->ask());
    advance(*outside);
  }
  const Front front = finish(*inside, noisy);
  expect_equal(outside->front(), front);
  EXPECT_EQ(front.stopped_by, StopReason::generations);
  EXPECT_GT(front.failed, 0);
  EXPECT_EQ(front.message.empty(), front.failed <= 0.02 * front.evaluations) << front.message;
  EXPECT_EQ(outside->ask().rows(), 0);
}

// Without its own archive, members or scaling a copy would follow the original, or stand still.
TEST_P(DrivenSearches, CopiesGoTheirOwnWay) {
  const auto search = made();
  for (int i = 0; i < 3; ++i) advance(*search);
  const Search kept = *search;
  const Front then = kept.front();
  const Front end = finish(*search, noisy);
  expect_equal(kept.front(), then);
  Search copy = kept, assigned = *made(quick(2));
  expect_equal(finish(copy, noisy), end);
  assigned = kept;
  assigned = *&assigned;
  expect_equal(finish(assigned, noisy), end);
  const Search moved = std::move(assigned);
  expect_equal(moved.front(), end);
}

TEST_P(DrivenSearches, GiveTheSameBitsOnAnyNumberOfThreads) {
  const Front front = finish(*made(), noisy);
  for (const int threads : {2, 3, 8, 0}) expect_equal(finish(*made(quick(threads)), noisy), front);
}

// Before the first population, within the search, at its end; resumed by another object on 1, 2 and 8
// threads.
TEST_P(DrivenSearches, SavedAndResumedGoOnToTheSameBits) {
  const Front front = finish(*made(), noisy);
  const auto interrupted = made();
  for (int told = 0;; ++told) {
    if (told < 4 || interrupted->done()) {
      interrupted->save(path_);
      for (const int threads : {1, 2, 8}) {
        const auto resumed = made(quick(threads));
        advance(*resumed);  // what it did before does not matter
        resumed->restore(path_);
        expect_equal(resumed->front(), interrupted->front());
        expect_equal(finish(*resumed, noisy), front);
      }
    }
    if (interrupted->done()) return;
    advance(*interrupted);
  }
}

TEST_P(DrivenSearches, SavedAndReadAndSavedIsTheSameFile) {
  const auto search = made();
  for (int i = 0; i < 3; ++i) advance(*search);
  search->save(path_);
  const std::string first = content(path_);
  const auto other = made();
  other->restore(path_);
  other->save(path_);
  EXPECT_EQ(content(path_), first);
}

// Under way and at its end: with a larger budget, however it is given, the search becomes what it would have
// been with that budget from the first.
TEST_P(DrivenSearches, GoOnToTheSameBitsWithALargerBudget) {
  SearchOptions longer = quick();
  longer.stopping.generations = 17;
  const Front front = finish(*made(longer), noisy);
  SearchOptions few = longer, never = longer;
  few.stopping.evaluations = 150;
  never.stopping.stall_gain = 1e9;  // stalls as soon as its window is full
  for (const SearchOptions& shorter : {quick(), few, never}) {
    const auto search = made(shorter);
    for (int told = 0;; ++told) {
      if (told < 3 || search->done()) {
        search->save(path_);
        const auto resumed = made(longer);
        resumed->restore(path_);
        EXPECT_FALSE(resumed->done());
        expect_equal(finish(*resumed, noisy), front);
      }
      if (search->done()) break;
      advance(*search);
    }
    EXPECT_LT(search->front().generations, front.generations);
  }
}

TEST_P(DrivenSearches, EndWithTheGenerationUnderWayWhereTheBudgetIsSmaller) {
  const auto search = made();
  while (search->front().generations < 5) advance(*search);
  search->save(path_);
  SearchOptions shorter = quick();
  shorter.stopping.generations = 3;
  const auto resumed = made(shorter);
  resumed->restore(path_);
  EXPECT_FALSE(resumed->done());
  const Front front = finish(*resumed, noisy);
  EXPECT_EQ(front.generations, 6);
  EXPECT_EQ(front.stopped_by, StopReason::generations);
  const Front whole = finish(*search, noisy);
  search->save(path_);
  resumed->restore(path_);
  EXPECT_TRUE(resumed->done());
  EXPECT_EQ(resumed->ask().rows(), 0);
  expect_equal(resumed->front(), whole);
}

// The window of a stall rule begins where the rule does, also where it was away in between.
TEST_P(DrivenSearches, TakeOnAStallRuleOnTheWay) {
  SearchOptions plain = quick();
  plain.stopping.stall_generations.reset();
  SearchOptions stalling = quick();
  stalling.stopping.generations = 40;
  stalling.stopping.stall_generations = 5;
  stalling.stopping.stall_gain = 1e9;
  const auto first = made();
  for (int i = 0; i < 3; ++i) advance(*first);
  first->save(path_);
  const auto second = made(plain);
  second->restore(path_);
  finish(*second, noisy);
  second->save(path_);
  const auto third = made(stalling);
  third->restore(path_);
  const Front front = finish(*third, noisy);
  EXPECT_EQ(front.stopped_by, StopReason::stall);
  EXPECT_EQ(front.generations, 12 + 6);  // the first volume is that of generation 13
}

// Earlier versions asked for nothing more at the end.
TEST_P(DrivenSearches, SayWhenAnEndedSearchCannotGoOn) {
  const auto search = made();
  const Front front = finish(*search, noisy);
  search->save(path_);
  std::string text = content(path_);
  const std::size_t asked = text.find("\nasked ") + 1;
  text.replace(asked, text.find('\n', asked) - asked, "asked 0 0");
  fit_checksum(text);
  SearchOptions longer = quick();
  longer.stopping.generations = 17;
  const auto resumed = made(longer);
  EXPECT_NE(refusal(*resumed, text).find("kept no points to go on with"), std::string::npos);
  expect_equal(finish(*resumed, noisy), finish(*made(longer), noisy));
  const auto same = made();
  same->restore(path_);
  EXPECT_TRUE(same->done());
  expect_equal(same->front(), front);
}

// A stop within the third population: it is dropped, and what a new search makes of the checkpoint is what
// the search would have become.
TEST_P(DrivenSearches, StopWithinAPopulationAndGoOn) {
  for (const int threads : {1, 4}) {
    std::stop_source source;
    std::atomic<int> calls{0};
    const auto stopping = [&](const Eigen::VectorXd& x, doe::Seed seed) {
      if (++calls == 45) source.request_stop();
      return noisy(x, seed);
    };
    SearchOptions options = quick(threads);
    options.stop = source.get_token();
    const auto search = made(options);
    const Front early = finish(*search, stopping);
    EXPECT_TRUE(search->done());
    EXPECT_EQ(early.stopped_by, StopReason::stopped);
    EXPECT_LE(early.evaluations, 45);
    EXPECT_GT(early.evaluations, 45 - 20);
    EXPECT_LE(calls, 45 + threads);
    search->save(path_);
    const auto resumed = made();
    resumed->restore(path_);
    expect_equal(finish(*resumed, noisy), finish(*made(), noisy));
  }
}

TEST_P(DrivenSearches, StoppedBeforeAnythingWasEvaluatedSaySo) {
  std::stop_source source;
  source.request_stop();
  SearchOptions options = quick();
  options.stop = source.get_token();
  const Front none = finish(*made(options), noisy);
  EXPECT_EQ(none.status, SearchStatus::nothing_evaluated);
  EXPECT_EQ(none.message, "the search was stopped before its first population was evaluated");
  EXPECT_EQ(none.X.rows(), 0);
  EXPECT_EQ(none.Y.cols(), 2);
}

TEST_P(DrivenSearches, RefuseOutcomesThatDoNotFit) {
  const auto search = made();
  const auto text = [&](const std::vector<doe::Outcome>& outcomes) {
    return support::thrown_text<std::invalid_argument>([&] { search->tell(outcomes); });
  };
  EXPECT_EQ(text({doe::Outcome(1.0)}),
            "pareto::Search::tell: 1 outcomes for 20 points; give one per row of ask()");
  finish(*search, noisy);
  EXPECT_EQ(text({}), "pareto::Search::tell: the search has ended (generations); ask done() first");
}

// What is told once more would be taken for the outcomes of the next points, which nobody has seen.
TEST_P(DrivenSearches, RefuseOutcomesThatAreToldTwice) {
  const auto search = made(), other = made();
  const std::vector<doe::Outcome> outcomes(search->seeds().size(), doe::Outcome({1.0, 2.0, 0.0}));
  for (Search* one : {search.get(), other.get()}) one->tell(outcomes);
  for (const std::size_t count : {outcomes.size(), std::size_t{1}})  // a steady state asks for one
    EXPECT_THROW(search->tell({outcomes.begin(), outcomes.begin() + static_cast<std::ptrdiff_t>(count)}),
                 std::invalid_argument);
  expect_equal(finish(*search, noisy), finish(*other, noisy));
}

// Of a problem with four designs a front has at most four points, each once.
TEST(Fronts, HoldEachPointOnce) {
  const doe::Problem whole{
      .variables = {doe::integer_variable("a", "1", 0, 1), doe::integer_variable("b", "1", 0, 1)},
      .responses = {{"f", "1", doe::Goal::minimize}, {"g", "1", doe::Goal::minimize}}};
  const auto f = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return Eigen::Vector2d(x[0], 1 - x[0] + x[1]);
  };
  SearchOptions options;
  options.population = 20;
  options.stopping.generations = 5;
  for (const Front& front : {nsga2(f, whole, {.search = options}), nsga3(f, whole, {.search = options}),
                             sms_emoa(f, whole, {.search = options}), moead(f, whole, {.search = options})}) {
    EXPECT_EQ(front.X.rows(), 2);
    EXPECT_EQ(front.responses, (Eigen::Matrix2d() << 0, 1, 1, 0).finished());
  }
}

TEST_P(DrivenSearches, TakeFaultyOutcomesForFailures) {
  const auto search = made();
  std::vector<doe::Outcome> outcomes(20, doe::Outcome({1.0, NAN, 0.0}));
  outcomes.back() = doe::Outcome(1.0);
  search->tell(outcomes);
  EXPECT_EQ(search->front().failed, 20);
  EXPECT_EQ(search->front().message, "all 20 evaluations failed; the first: response \"yield\" is nan");
}

// Cut anywhere, or with any byte changed, it is refused, and the search goes on as if nothing had been read.
TEST_P(DrivenSearches, RefuseACheckpointThatIsCutOffOrAltered) {
  const auto search = made(), other = made();
  for (int i = 0; i < 2; ++i) advance(*search);
  search->save(path_);
  const std::string whole = content(path_);
  EXPECT_NE(refusal(*other, whole.substr(0, whole.size() - 1)).find("is cut off"), std::string::npos);
  EXPECT_NE(refusal(*other, whole.substr(0, whole.size() / 2)).find("is cut off"), std::string::npos);
  for (std::size_t i = 0; i < whole.size(); i += 97) {
    EXPECT_NE(refusal(*other, whole.substr(0, i)), "") << i;
    std::string altered = whole;
    altered[i] = static_cast<char>(altered[i] ^ 1);
    EXPECT_NE(refusal(*other, altered), "") << i;
  }
  std::string altered = whole;
  altered[whole.size() / 2] = '?';
  EXPECT_NE(refusal(*other, altered).find("is damaged: its checksum does not fit"), std::string::npos);
  EXPECT_NE(refusal(*other, "alpha,beta\n").find("its first line is not \"drawpoint pareto checkpoint 1\""),
            std::string::npos);
  expect_equal(finish(*other, noisy), finish(*made(), noisy));
}

// Found only when part of it has been read: what stands before "asked" is another state's.
TEST_P(DrivenSearches, StayAsTheyWereWhereACheckpointLacksAnItem) {
  const auto saved = made(), search = made();
  for (int i = 0; i < 3; ++i) advance(*saved);
  saved->save(path_);
  std::string text = content(path_);
  const std::size_t line = text.find("\nasked ");
  ASSERT_NE(line, std::string::npos);
  text.erase(line, text.find('\n', line + 1) - line);
  fit_checksum(text);
  advance(*search);
  EXPECT_NE(refusal(*search, text).find("is damaged at \"asked\""), std::string::npos);
  expect_equal(finish(*search, noisy), finish(*made(), noisy));
}

TEST_P(DrivenSearches, RefuseACheckpointOfAnotherProblemOrOtherOptions) {
  made()->save(path_);
  const std::string begin = "pareto::Search::restore: \"" + path_.string() + "\" ";
  const auto text = [&](const doe::Problem& of, const SearchOptions& options) {
    const auto search = GetParam().make(of, options);
    return support::thrown_text<std::runtime_error>([&] { search->restore(path_); });
  };
  doe::Problem wider = problem;
  wider.variables[0].upper = 2.0;
  EXPECT_EQ(text(wider, quick()),
            begin +
                "is of another problem: it has \"variable \"x\" 0 m to 1 m real\" where this search has "
                "\"variable \"x\" 0 m to 2 m real\"; restore it into the search that it is of");
  doe::Problem looser = problem;
  looser.responses[2].limit = 0.9;
  EXPECT_NE(
      text(looser, quick()).find("is of another problem: it has \"response \"slope\" [m] at_most 0.8\""),
      std::string::npos);
  doe::Problem smaller = problem;
  smaller.responses.pop_back();
  EXPECT_NE(text(smaller, quick()).find("is of another problem"), std::string::npos);
  SearchOptions reseeded = quick();
  reseeded.seed = 8;
  EXPECT_EQ(text(problem, reseeded), begin +
                                         "was made with other options: it has \"option seed 7\" where this "
                                         "search has \"option seed 8\"; restore it into the search that it "
                                         "is of");
  SearchOptions sharper = quick();
  sharper.variation.mutation_index = 30.0;
  EXPECT_NE(text(problem, sharper).find("it has \"option mutation_index 20\""), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(All, DrivenSearches, testing::ValuesIn(all_searches()),
                         [](const auto& info) { return info.param.name; });

TEST(AskAndTell, ACheckpointOfAnotherSearchIsRefused) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("drawpoint-checkpoint-other-" + std::to_string(::getpid()) + ".txt");
  Nsga2(problem, {.search = quick()}).save(path);
  Nsga3 other(problem, {.search = quick()});
  EXPECT_EQ(support::thrown_text<std::runtime_error>([&] { other.restore(path); }),
            "pareto::Search::restore: \"" + path.string() +
                "\" is of another search: it has \"search pareto::nsga2\" where this search has \"search "
                "pareto::nsga3\"; restore it into the search that it is of");
  Nsga2 geometric(problem, {.search = quick(), .elitism = Elitism::geometric});
  EXPECT_NE(support::thrown_text<std::runtime_error>([&] {
              geometric.restore(path);
            }).find("it has \"option elitism plain\" where this search has \"option elitism geometric\""),
            std::string::npos);
  std::filesystem::remove(path);
  EXPECT_EQ(support::thrown_text<std::runtime_error>([&] { other.restore(path); }),
            "pareto::Search::restore: \"" + path.string() +
                "\" cannot be read; check the name and the permissions");
}

TEST(AskAndTell, StatusesHaveTexts) {
  EXPECT_EQ(to_string(SearchStatus::nothing_evaluated), "nothing_evaluated");
  EXPECT_EQ(to_string(StopReason::stopped), "stopped");
}

}  // namespace
