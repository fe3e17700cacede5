// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The store gives back what it took, bit for bit, and leaves alone what is not its own.

#include <drawpoint/tests/studies/support.hpp>

#include <SQLiteCpp/SQLiteCpp.h>
#include <drawpoint/studies/run/store/columns.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/row_checksum.h>
#include <drawpoint/studies/run/store/run_logs.h>
#include <drawpoint/studies/run/store/store.h>

#include <cmath>
#include <thread>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

using test::complaint;
using test::TestFolder;

Run planned(std::int64_t id, double alpha, double lip) {
  studies::Run run;
  run.id = id;
  run.point = id;
  run.seed = 0xfedcba9876543210ull + static_cast<std::uint64_t>(id);
  run.x = Eigen::Vector2d(alpha, lip);
  return run;
}

class StoreTest : public testing::Test {
 protected:
  TestFolder folder_;
  const std::filesystem::path file_ = folder_ / "study.db";
};

TEST_F(StoreTest, GivesBackEveryBit) {
  const Eigen::Vector2d y(std::nextafter(1.0, 2.0), -1e-300);
  {
    Store store = Store::create(file_, test::identity(true, 3));
    store.add({planned(1, 0.1 + 0.2, std::nextafter(3.0, 0.0)), planned(2, 1.0 / 3.0, -1.0)});
    store.mark_running(1);
    store.save_done(1, y, 0.25);
    store.save_failed(2, "it's \"stuck\"", 1.5);
  }
  const Store store = Store::open(file_);
  EXPECT_EQ(store.identity().seed, test::identity().seed);
  EXPECT_EQ(store.identity().replicates, 3);
  EXPECT_TRUE(store.identity().corners);
  EXPECT_EQ(difference(store.identity().problem, test::two_by_two()), "");
  const auto runs = store.runs();
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].seed, 0xfedcba9876543211ull);
  EXPECT_EQ(runs[0].x, Eigen::Vector2d(0.1 + 0.2, std::nextafter(3.0, 0.0)));
  EXPECT_EQ(runs[0].y, y);
  EXPECT_EQ(runs[0].status, Status::done);
  EXPECT_EQ(runs[0].seconds, 0.25);
  EXPECT_EQ(runs[0].started.size(), std::string("2000-01-01T00:00:00Z").size());
  EXPECT_EQ(runs[1].status, Status::failed);
  EXPECT_EQ(runs[1].reason, "it's \"stuck\"");
}

TEST_F(StoreTest, CorrectionsKeepWhatStoodThere) {
  {
    Store store = Store::create(file_, test::identity());
    store.add({planned(1, 0.5, 2.0), planned(2, 0.6, 2.0)});
    store.save_done(1, Eigen::Vector2d(0.1 + 0.2, 0.1), 2.5);
    store.save_failed(2, "stuck", 1.0);
    EXPECT_TRUE(store.corrections().empty());
    store.replace(1, Eigen::Vector2d(3.0, 0.2), "", 2.5, "a decimal comma");
    store.exclude(1, "the belt stood");
  }
  Store store = Store::open(file_);
  EXPECT_TRUE(store.runs()[0].left_out);
  EXPECT_EQ(store.runs()[0].status, Status::failed);
  EXPECT_EQ(store.runs()[0].reason, "left out: excluded by hand: the belt stood");
  const auto ledger = store.corrections();
  ASSERT_EQ(ledger.size(), 2u);
  EXPECT_EQ(ledger[0].before, "{\"status\":\"done\",\"values\":[0.30000000000000004,0.1],\"seconds\":2.5}");
  EXPECT_EQ(ledger[1].before, "{\"status\":\"done\",\"values\":[3.0,0.2],\"seconds\":2.5}");
  store.exclude(1, "it did not", true);
  EXPECT_EQ(store.runs()[0].y, Eigen::Vector2d(3.0, 0.2));
  store.plan_again(true);
  EXPECT_EQ(store.runs()[1].status, Status::planned) << "the failed one";
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE corrections SET why = 'x' WHERE number = 2");
  EXPECT_NE(complaint([&] { store.runs(); }).find("correction 2 does not fit its checksum"),
            std::string::npos);
}

TEST_F(StoreTest, AMovedFolderIsCalledMoved) {
  std::filesystem::create_directory(folder_ / "here");
  Store store = Store::create(folder_ / "here" / "study.db", test::identity());
  store.add({planned(1, 0.5, 2.0)});
  std::filesystem::rename(folder_ / "here", folder_ / "there");
  EXPECT_NE(complaint([&] { store.save_failed(1, "stuck", 1.0); }).find("the folder was moved"),
            std::string::npos);
}

// Values of 1e-17 beside such of 0.3 are what a response without signal gives; 1e30 is what nobody measured.
TEST_F(StoreTest, ValuesThatCannotBeAreLeftOut) {
  Store store = Store::create(file_, test::identity());
  std::vector<studies::Run> runs;
  for (int id = 1; id <= 8; ++id) runs.push_back(planned(id, 0.5 + 0.1 * id, 2.0));
  store.add(runs);
  const std::vector<double> values = {1e-17, 2e-17, 0.3, 1e30, 1e200, -1e200, HUGE_VAL, 3e-17};
  for (int id = 1; id <= 8; ++id)
    store.save_done(id, Eigen::Vector2d(values[static_cast<std::size_t>(id) - 1], 0.1), 1.0);
  const auto read = store.runs();
  for (const int id : {1, 2, 3, 8}) EXPECT_FALSE(read[static_cast<std::size_t>(id) - 1].left_out) << id;
  for (const int id : {4, 5, 6, 7}) EXPECT_TRUE(read[static_cast<std::size_t>(id) - 1].left_out) << id;
  EXPECT_EQ(read[3].reason,
            "left out: \"production\" is 1e+30 kg/s, which is more than 1e12 times the median size");
}

TEST_F(StoreTest, KeepsWhatWasPredictedAndHowTheStudyGoesOn) {
  {
    Store store = Store::create(file_, test::identity());
    studies::Run predicted = planned(2, 0.6, 2.5);
    predicted.kind = Kind::confirmation;
    predicted.predicted = Eigen::Vector2d(0.1 + 0.2, -1e-300);
    predicted.lower = Eigen::Vector2d(0.5, 0.0);
    predicted.upper = Eigen::Vector2d(1.5, 0.25);
    store.add({planned(1, 0.5, 2.0), predicted, planned(3, 0.7, 2.0)});
    store.save_done(2, Eigen::Vector2d(1.0, 2.0), 0.1);
    store.set_sampling(
        {.points = 40, .batch = 5, .criteria = "error=0.3", .rounds = {{2, 1}, {7, 0}}, .target = 0.1 + 0.2});
    EXPECT_NE(complaint([&] { store.set_sampling({.target = std::nan("")}); }).find("target is not finite"),
              std::string::npos);
  }
  const Store store = Store::open(file_);
  const auto runs = store.runs();
  EXPECT_EQ(runs[1].kind, Kind::confirmation);
  EXPECT_EQ(runs[1].predicted, Eigen::Vector2d(0.1 + 0.2, -1e-300));
  EXPECT_EQ(runs[1].lower, Eigen::Vector2d(0.5, 0.0));
  EXPECT_EQ(runs[1].upper, Eigen::Vector2d(1.5, 0.25));
  for (const std::size_t k : {0, 2}) {
    ASSERT_EQ(runs[k].predicted.size(), 2);
    EXPECT_TRUE(runs[k].predicted.array().isNaN().all() && runs[k].lower.array().isNaN().all() &&
                runs[k].upper.array().isNaN().all());
  }
  EXPECT_EQ(store.sampling().points, 40);
  EXPECT_EQ(store.sampling().batch, 5);
  EXPECT_EQ(store.sampling().criteria, "error=0.3");
  EXPECT_EQ(store.sampling().target, 0.1 + 0.2);
  ASSERT_EQ(store.sampling().rounds.size(), 2u);
  EXPECT_EQ(store.sampling().rounds[0].first, 2);
  EXPECT_EQ(store.sampling().rounds[0].named, 1);
  EXPECT_EQ(store.sampling().rounds[1].first, 7);
}

TEST_F(StoreTest, TableIsReadableWithPlainSql) {
  Store store = Store::create(file_, test::identity());
  store.add({planned(1, 0.5, 2.0)});
  store.save_done(1, Eigen::Vector2d(7.5, 0.125), 0.25);
  SQLite::Database database(file_.string());
  SQLite::Statement query(database,
                          "SELECT alpha, lip, production, spill, seed FROM runs WHERE status = 'done'");
  ASSERT_TRUE(query.executeStep());
  EXPECT_EQ(query.getColumn(0).getDouble(), 0.5);
  EXPECT_EQ(query.getColumn(1).getDouble(), 2.0);
  EXPECT_EQ(query.getColumn(2).getDouble(), 7.5);
  EXPECT_EQ(query.getColumn(3).getDouble(), 0.125);
  EXPECT_EQ(query.getColumn(4).getString(), std::to_string(0xfedcba9876543211ull));
}

TEST_F(StoreTest, PlansAgainWhatWasInFlightAndOnDemandWhatFailed) {
  Store store = Store::create(file_, test::identity());
  store.add({planned(1, 0.5, 2.0), planned(2, 0.6, 2.0), planned(3, 0.7, 2.0)});
  store.save_done(1, Eigen::Vector2d(1.0, 2.0), 0.1);
  store.mark_running(2);
  store.save_failed(3, "no", 0.1);
  store.plan_again(false);
  auto runs = store.runs();
  EXPECT_EQ(runs[0].status, Status::done);
  EXPECT_EQ(runs[1].status, Status::planned);
  EXPECT_EQ(runs[2].status, Status::failed);
  store.plan_again(true);
  runs = store.runs();
  EXPECT_EQ(runs[0].status, Status::done);
  EXPECT_EQ(runs[2].status, Status::planned);
  EXPECT_EQ(runs[2].reason, "");
}

TEST_F(StoreTest, AddsAllRunsOrNone) {
  Store store = Store::create(file_, test::identity());
  store.add({planned(1, 0.5, 2.0)});
  complaint([&] { store.add({planned(2, 0.6, 2.0), planned(1, 0.7, 2.0)}); });
  EXPECT_EQ(store.runs().size(), 1u);
}

TEST_F(StoreTest, LeavesAForeignFileAsItIs) {
  {
    SQLite::Database other(file_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    other.exec("CREATE TABLE runs (id INTEGER PRIMARY KEY)");
  }
  const std::string before = test::contents(file_);
  const std::string text = complaint([&] { Store::open(file_); });
  EXPECT_NE(text.find("not the store of a Drawpoint study"), std::string::npos) << text;
  EXPECT_NE(text.find("--out"), std::string::npos) << text;
  EXPECT_EQ(test::contents(file_), before);
}

TEST_F(StoreTest, RefusesTextAndEmptyFiles) {
  test::write_file(file_, "alpha,production\n0.5,12\n" + std::string(4096, 'x'));
  const std::string before = test::contents(file_);
  EXPECT_NE(complaint([&] { Store::open(file_); }).find("not a database"), std::string::npos);
  EXPECT_EQ(test::contents(file_), before);
  test::write_file(file_, "");
  EXPECT_NE(complaint([&] { Store::open(file_); }).find("is empty, and not the store"), std::string::npos);
}

TEST_F(StoreTest, RefusesADamagedFile) {
  {
    Store store = Store::create(file_, test::identity());
    std::vector<studies::Run> many;
    for (int id = 1; id <= 500; ++id) many.push_back(planned(id, 0.5, 2.0));
    store.add(many);
  }
  std::string bytes = test::contents(file_);
  for (std::size_t i = 8192; i < 8192 + 2048; ++i) bytes[i] = '\x5a';  // inside the pages of the table
  test::write_file(file_, bytes);
  const std::string text = complaint([&] { Store::open(file_).runs(); });
  EXPECT_NE(text.find("damaged"), std::string::npos) << text;
  EXPECT_NE(text.find(file_.string()), std::string::npos) << text;
  EXPECT_EQ(test::contents(file_), bytes);
  test::write_file(file_, bytes.substr(0, bytes.size() / 2));
  EXPECT_NE(complaint([&] { Store::open(file_).runs(); }).find("damaged"), std::string::npos);
}

// Whatever bit of the file flips: it is refused, or what it says is what was stored. 83 is prime to the 8
// bits of a byte and to the pages, so bits of all places take part.
TEST_F(StoreTest, NoFlippedBitIsTakenForData) {
  std::vector<studies::Run> stored;
  {
    Store store = Store::create(file_, test::identity());
    store.add({planned(1, 0.5, 2.0), planned(2, 0.6, 2.5), planned(3, 0.7, 3.0)});
    store.save_done(1, Eigen::Vector2d(0.1 + 0.2, 2.0), 0.1, "0123456789abcdef");
    store.save_failed(2, "stuck", 0.5);
    stored = store.runs();
  }
  const std::string sound = test::contents(file_);
  int refused = 0;
  for (std::size_t bit = 0; bit < 8 * sound.size(); bit += 83) {
    std::string bytes = sound;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
    test::write_file(file_, bytes);
    try {
      const Store store = Store::open(file_);
      const std::vector<studies::Run> runs = store.runs();
      EXPECT_EQ(store.identity().seed, test::identity().seed) << bit;
      EXPECT_EQ(difference(store.identity().problem, test::two_by_two()), "") << bit;
      ASSERT_EQ(runs.size(), stored.size()) << bit;
      for (std::size_t k = 0; k < runs.size(); ++k)
        EXPECT_EQ(detail::row_checksum(runs[k]), detail::row_checksum(stored[k])) << bit;
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
}

TEST_F(StoreTest, RefusesRowsThatAreGoneOrWereChanged) {
  const auto after = [&](const std::string& sql) {
    std::filesystem::remove(file_);
    Store::create(file_, test::identity())
        .add({planned(1, 0.5, 2.0), planned(2, 0.6, 2.5), planned(3, 0.7, 3.0)});
    SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec(sql);
    return complaint([&] { Store::open(file_).runs(); });
  };
  const auto says = [&](const std::string& sql, const std::string& words) {
    const std::string text = after(sql);
    EXPECT_NE(text.find(words), std::string::npos) << sql << ": " << text;
    EXPECT_NE(text.find("--out"), std::string::npos) << text;
  };
  says("DELETE FROM runs WHERE id = 2", "run 2 is not there");
  says("DELETE FROM runs WHERE id = 3", "it holds 2 of 3 runs");
  says("UPDATE runs SET alpha = 99 WHERE id = 2", "run 2 does not fit its checksum");
  says("UPDATE runs SET seed = 'many' WHERE id = 1", "run 1 does not fit its checksum");
  says("UPDATE study SET value = '7' WHERE key = 'seed'", "table study does not fit its checksum");
}

// `status` may look while `run` adds: what it reads is of one moment, so it is never taken for damage.
TEST_F(StoreTest, IsReadWhileAnotherAddsRows) {
  constexpr int rows = 100;
  Store writer = Store::create(file_, test::identity());
  std::thread adding([&] {
    for (int id = 1; id <= rows; ++id) writer.add({planned(id, 0.5, 2.0)});
  });
  std::size_t seen = 0;
  while (seen < rows) {
    std::size_t now = 0;
    EXPECT_NO_THROW(now = Store::open(file_).runs().size());
    if (HasFailure()) break;
    EXPECT_GE(now, seen);
    seen = now;
  }
  adding.join();
}

TEST_F(StoreTest, KnowsTheLogThatARunWrote) {
  const Folder folder{folder_.path()};
  std::filesystem::create_directories(folder.logs());
  Store store = Store::create(file_, test::identity());
  store.add({planned(1, 0.5, 2.0), planned(2, 0.6, 2.5), planned(3, 0.7, 3.0)});
  for (const int id : {1, 2}) {
    test::write_file(folder.log(id), "log of run " + std::to_string(id));
    store.save_done(id, Eigen::Vector2d(1.0, 2.0), 0.1, file_checksum(folder.log(id)));
  }
  const auto state = [&](std::size_t k) { return log_state(folder, store.runs()[k]); };
  EXPECT_EQ(state(0), LogState::sound);
  EXPECT_EQ(state(2), LogState::none);
  std::filesystem::copy_file(folder.log(1), folder.log(2), std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(state(1), LogState::other);
  test::write_file(folder.log(1), "log of run 1, damaged");
  EXPECT_EQ(state(0), LogState::other);
  std::filesystem::remove(folder.log(1));
  EXPECT_EQ(state(0), LogState::none);
  std::filesystem::create_directory(folder.log(1));
  EXPECT_EQ(state(0), LogState::other);
}

TEST_F(StoreTest, RefusesAnotherSchemaVersion) {
  Store::create(file_, test::identity());
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
  EXPECT_NE(complaint([&] { Store::open(file_); }).find("schema version 99"), std::string::npos);
}

TEST(Columns, AreUniqueWithoutRegardToCase) {
  const doe::Problem problem{.variables = {{"seed", "1", 0, 1}, {"Speed", "1", 0, 1}, {"a \"b\"", "1", 0, 1}},
                             .responses = {{"speed", "1"}, {"status", "1"}}};
  const Columns columns = columns_of(problem);
  EXPECT_EQ(columns.x, (std::vector<std::string>{"\"x_seed\"", "\"Speed\"", "\"a \"\"b\"\"\""}));
  EXPECT_EQ(columns.y, (std::vector<std::string>{"\"y_speed\"", "\"y_status\""}));
}

}  // namespace
