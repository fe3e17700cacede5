// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <rapidcheck/gtest.h>
#include <bit>
#include <csignal>
#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <fstream>
#include <sstream>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

namespace fs = std::filesystem;

/// A folder of its own that goes away with its contents.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("drawpoint-evaluations-" + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  fs::path file() const { return path_ / "runs.csv"; }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
  }

 private:
  fs::path path_;
};

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Any finite double: every exponent, subnormals and both zeros included.
double arbitrary_double() {
  const auto bits = *rc::gen::suchThat(rc::gen::arbitrary<std::uint64_t>(), [](std::uint64_t b) {
    return std::isfinite(std::bit_cast<double>(b));
  });
  return std::bit_cast<double>(bits);
}

Eigen::VectorXd arbitrary_vector(Eigen::Index size) {
  Eigen::VectorXd values(size);
  for (double& v : values) v = arbitrary_double();
  return values;
}

Evaluation arbitrary_row() {
  Evaluation row{*rc::gen::arbitrary<std::int64_t>(),
                 *rc::gen::arbitrary<int>(),
                 *rc::gen::arbitrary<Seed>(),
                 arbitrary_vector(3),
                 arbitrary_vector(2),
                 arbitrary_double()};
  if (*rc::gen::arbitrary<bool>())
    row.outcome =
        Failure{*rc::gen::container<std::string>(rc::gen::element('a', '"', ',', '\n', '\r', ' ', ';'))};
  return row;
}

/// Equality of bits, so that 0 and -0 differ.
bool same_bits(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double u, double v) {
    return std::bit_cast<std::uint64_t>(u) == std::bit_cast<std::uint64_t>(v);
  });
}

RC_GTEST_PROP(EvaluationsCsv, EveryTableComesBackBitForBit, ()) {
  const Folder folder;
  Evaluations table{support::loader_problem(), {}};
  const int count = *rc::gen::inRange(0, 6);
  for (int i = 0; i < count; ++i) table.rows.push_back(arbitrary_row());
  write_csv(table, folder.file());
  const Evaluations back = read_csv(table.problem, folder.file());
  RC_ASSERT(back.rows.size() == table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Evaluation &a = table.rows[i], &b = back.rows[i];
    RC_ASSERT(a.run == b.run && a.replicate == b.replicate && a.seed == b.seed);
    RC_ASSERT(same_bits(a.x, b.x) && same_bits(a.outcome.values(), b.outcome.values()));
    RC_ASSERT(a.outcome.failed() == b.outcome.failed());
    RC_ASSERT(a.outcome.reason() == b.outcome.reason());
    RC_ASSERT(std::bit_cast<std::uint64_t>(a.seconds) == std::bit_cast<std::uint64_t>(b.seconds));
  }
}

Evaluations small_table() {
  const Eigen::Vector3d x(-25.0, 0.002, 0.5);
  return {support::loader_problem(),
          {{0, 0, 11, x, {41.5, 0.25}, 1.5}, {1, 0, 12, x, Failure{"bucket stuck, twice"}, 0.5}}};
}

TEST(EvaluationsCsv, TheFormatIsAsDocumented) {
  const Folder folder;
  write_csv(small_table(), folder.file());
  EXPECT_EQ(
      text_of(folder.file()),
      "run,replicate,seed,status,lip_angle [deg],\"lift, \"\"speed\"\" [m/s]\",kappa [1],production [kg/s],"
      "\"joint, damage [s]\",seconds,failure\n"
      "0,0,11,ok,-25,0.002,0.5,41.5,0.25,1.5,\n"
      "1,0,12,failed,-25,0.002,0.5,,,0.5,\"bucket stuck, twice\"\n");
}

/// What read_csv says about the small table after `change` has damaged its text.
template <class Change>
std::string complaint(const Change& change) {
  const Folder folder;
  write_csv(small_table(), folder.file());
  std::string text = text_of(folder.file());
  change(text);
  std::ofstream(folder.file(), std::ios::binary) << text;
  std::string what =
      support::thrown_text<std::runtime_error>([&] { read_csv(support::loader_problem(), folder.file()); });
  const auto line = what.find("\" line ");
  return line == std::string::npos ? what : what.substr(line + 2);
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, from.size(), to);
}

TEST(EvaluationsCsv, DamageIsNamedWithLineAndColumn) {
  EXPECT_EQ(complaint([](std::string&) {}), "");
  EXPECT_EQ(complaint([](std::string& t) { replace(t, "41.5", "41,5"); }), "line 2: 12 fields, expected 11");
  EXPECT_EQ(complaint([](std::string& t) { replace(t, "41.5", "41.5x"); }),
            "line 2: column \"production [kg/s]\": \"41.5x\" is not a number it can hold");
  EXPECT_EQ(complaint([](std::string& t) { replace(t, "41.5", "nan"); }),
            "line 2: column \"production [kg/s]\": nan is not finite");
  EXPECT_EQ(complaint([](std::string& t) { replace(t, "0,0,11", "0,0,-11"); }),
            "line 2: column \"seed\": \"-11\" is not a number it can hold");
  EXPECT_EQ(complaint([](std::string& t) { replace(t, "failed", "lost"); }),
            "line 3: column \"status\": \"lost\"; allowed is ok or failed");
  EXPECT_EQ(complaint([](std::string& t) { replace(t, ",,,", ",1,,"); }),
            "line 3: column \"production [kg/s]\": a failed run has no value");
  EXPECT_EQ(complaint([](std::string& t) { replace(t, "kg/s", "t/h"); }),
            "line 1: column 8 is \"production [t/h]\", this problem expects \"production [kg/s]\"; the file "
            "belongs to "
            "another problem");
  EXPECT_EQ(complaint([](std::string& t) { t.pop_back(); }), "line 3: the file ends inside a line");
  EXPECT_EQ(complaint([](std::string& t) { t.resize(t.size() - 4); }),
            "line 3: the file ends inside a quoted field");
  EXPECT_EQ(complaint([](std::string& t) { t.clear(); }), "line 1: the file is empty");
}

TEST(EvaluationsCsv, LineEndsOfOtherSystemsAreAccepted) {
  const auto with_returns = [](std::string& text) {
    std::string changed;
    for (const char c : text) {
      if (c == '\n') changed += '\r';
      changed += c;
    }
    text = changed;
  };
  EXPECT_EQ(complaint(with_returns), "");
}

TEST(EvaluationsCsv, AMissingFileOrFolderIsNamed) {
  const fs::path lost = "/nonexistent-folder/runs.csv";
  EXPECT_EQ(
      support::thrown_text<std::runtime_error>([&] { read_csv(support::loader_problem(), lost); }),
      "doe::read_csv: cannot read \"/nonexistent-folder/runs.csv\"; check that it exists and is readable");
  EXPECT_EQ(support::thrown_text<std::runtime_error>([&] { write_csv(small_table(), lost); }),
            "doe::write_file: cannot create a file beside \"/nonexistent-folder/runs.csv\": No such file or "
            "directory; the "
            "file is as it was; check the folder and the free space");
}

/// While it lives, no file of this process grows beyond `bytes`: the same failing write as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(EvaluationsCsv, AFailedWriteLeavesTheOldFileAndNothingElse) {
  const Folder folder;
  write_csv(small_table(), folder.file());
  const std::string before = text_of(folder.file());
  Evaluations large = small_table();
  for (int i = 0; i < 1000; ++i) large.rows.push_back(large.rows.front());
  std::string what;
  {
    const FileSizeLimit limit(4096);
    what = support::thrown_text<std::runtime_error>([&] { write_csv(large, folder.file()); });
  }
  EXPECT_NE(what.find("doe::write_file: cannot write"), std::string::npos) << what;
  EXPECT_EQ(text_of(folder.file()), before);
  EXPECT_EQ(folder.files(), 1U);
  write_csv(large, folder.file());
  EXPECT_EQ(read_csv(large.problem, folder.file()).rows.size(), large.rows.size());
  EXPECT_EQ(folder.files(), 1U);
}

}  // namespace
