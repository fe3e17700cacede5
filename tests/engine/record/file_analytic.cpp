// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What is written is what is read, for every kind of content, and other programs see plain HDF5.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <drawpoint/engine/record/file.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <thread>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::record;

namespace {

namespace fs = std::filesystem;

const FileKind kind{"drawpoint test file", 3};

class RecordFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file(const std::string& name = "file.h5") const { return folder_ / name; }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("drawpoint_record_" + std::to_string(::getpid()));
};

TEST_F(RecordFile, KeepsAttributes) {
  Writer writer(file(), kind);
  writer.number("/", "pi", 3.141592653589793);
  writer.number("a/b", "nan", std::nan(""));
  writer.integer("a", "big", std::numeric_limits<std::int64_t>::min());
  writer.text("a/b", "greek", "θ = 38°");
  writer.text("a", "empty", "");
  writer.text("a", "long", std::string(100000, 'x'));
  writer.commit();
  const Reader reader(file(), kind);
  EXPECT_EQ(reader.number("", "pi"), 3.141592653589793);
  EXPECT_TRUE(std::isnan(reader.number("a/b", "nan")));
  EXPECT_EQ(reader.integer("a", "big"), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(reader.text("/a/b", "greek"), "θ = 38°");
  EXPECT_EQ(reader.text("a", "empty"), "");
  EXPECT_EQ(reader.text("a", "long").size(), 100000u);
  EXPECT_EQ(reader.attributes("a"), (std::vector<std::string>{"big", "empty", "long"}));
  EXPECT_EQ(reader.attributes("/"), (std::vector<std::string>{"pi"}));
  EXPECT_EQ(reader.children("/"), (std::vector<std::string>{"a"}));
  EXPECT_TRUE(reader.has("a/b"));
  EXPECT_FALSE(reader.has("a/c"));
}

TEST_F(RecordFile, KeepsArrays) {
  std::vector<double> doubles(3 * 70000);  // several chunks, the last one partly filled
  for (std::size_t k = 0; k < doubles.size(); ++k) doubles[k] = std::sin(0.1 * static_cast<double>(k));
  const std::vector<float> floats{1.5f, -0.0f, std::numeric_limits<float>::infinity(), 4, 5, 6};
  const std::vector<std::int32_t> integers{-1, 0, 2147483647};
  Writer writer(file(), kind);
  writer.array("data/doubles", std::span<const double>(doubles), {70000, 3});
  writer.array("data/floats", std::span<const float>(floats), {1, 2, 3});
  writer.array("data/integers", std::span<const std::int32_t>(integers));
  writer.array("data/none", std::span<const double>(), {0, 4});
  writer.texts("data/texts", {"one", "", "drei ist länger"});
  writer.texts("data/no_texts", {});
  writer.commit();
  const Reader reader(file(), kind);
  const Array<double> back = reader.doubles("data/doubles");
  EXPECT_EQ(back.values, doubles);
  EXPECT_EQ(back.shape, (std::vector<std::size_t>{70000, 3}));
  EXPECT_EQ(std::memcmp(reader.floats("data/floats").values.data(), floats.data(), 24), 0);
  EXPECT_EQ(reader.floats("data/floats").shape, (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(reader.integers("data/integers").values, integers);
  EXPECT_EQ(reader.doubles("data/none").shape, (std::vector<std::size_t>{0, 4}));
  EXPECT_EQ(reader.texts("data/texts"), (std::vector<std::string>{"one", "", "drei ist länger"}));
  EXPECT_TRUE(reader.texts("data/no_texts").empty());
}

TEST_F(RecordFile, KeepsTables) {
  Table table;
  table.columns = {{"time", "s"}, {"torque", "N m"}};
  for (int k = 0; k < 1000; ++k) table.append_row(std::vector<double>{0.01 * k, 1e5 * k});
  Writer writer(file(), kind);
  writer.table("signals", table);
  writer.table("bare", Table{});
  writer.commit();
  const Reader reader(file(), kind);
  const Table back = reader.table("signals");
  EXPECT_EQ(back.values, table.values);
  EXPECT_EQ(back.columns[1].unit, "N m");
  EXPECT_EQ(back.column("torque")[999], 999e5);
  EXPECT_EQ(reader.table("bare").rows(), 0u);
}

TEST_F(RecordFile, KeepsScalars) {
  Writer writer(file(), kind);
  writer.scalar("mass", 2.5);
  writer.describe("mass", "kg", "of a rock");
  writer.scalar("name", "drift é");
  writer.scalar("empty", "");
  writer.commit();
  const Reader reader(file(), kind);
  EXPECT_EQ(reader.doubles("mass").values, std::vector<double>{2.5});
  EXPECT_TRUE(reader.doubles("mass").shape.empty());
  EXPECT_EQ(reader.texts("name"), std::vector<std::string>{"drift é"});
  EXPECT_EQ(reader.texts("empty"), std::vector<std::string>{""});
}

// What Octave's `load` needs of a file: no text in data that says to be UTF-8, none of variable length, no
// compound. Attributes it does not look at.
TEST_F(RecordFile, TextInDataIsWhatOctaveLoads) {
  Writer writer(file(), kind);
  writer.texts("list", {"a", "µm"});
  writer.scalar("one", "µm");
  writer.commit();
  const hid_t read = H5Fopen(file().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  for (const char* name : {"list", "one"}) {
    const hid_t data = H5Dopen2(read, name, H5P_DEFAULT), type = H5Dget_type(data);
    EXPECT_EQ(H5Tget_class(type), H5T_STRING) << name;
    EXPECT_EQ(H5Tget_cset(type), H5T_CSET_ASCII) << name;
    EXPECT_EQ(H5Tis_variable_str(type), 0) << name;
    H5Tclose(type);
    H5Dclose(data);
  }
  H5Fclose(read);
}

// As programs wrote them until the texts of data were said to be ASCII, and as h5py writes a str.
TEST_F(RecordFile, ReadsTextsOfEitherKind) {
  Writer writer(file(), kind, Form::plain);
  writer.commit();
  const hid_t made = H5Fopen(file().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
  H5Tset_size(type, 3);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  for (const H5T_cset_t characters : {H5T_CSET_ASCII, H5T_CSET_UTF8}) {
    H5Tset_cset(type, characters);
    const char* name = characters == H5T_CSET_UTF8 ? "utf8" : "ascii";
    const hid_t data = H5Dcreate2(made, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t attribute = H5Acreate2(made, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, "abc"), 0);
    EXPECT_GE(H5Awrite(attribute, type, "def"), 0);
    H5Aclose(attribute);
    H5Dclose(data);
  }
  H5Sclose(space);
  H5Tclose(type);
  H5Fclose(made);
  const Reader reader(file(), kind, Form::plain);
  for (const char* name : {"utf8", "ascii"}) {
    EXPECT_EQ(reader.texts(name), std::vector<std::string>{"abc"}) << name;
    EXPECT_EQ(reader.text("/", name), "def") << name;
  }
}

TEST_F(RecordFile, ACheckThatFailsLeavesTheOldFile) {
  for (const double x : {1.0, 2.0}) {
    Writer writer(file(), kind);
    writer.number("/", "x", x);
    const auto check = [&](const fs::path& written) {
      EXPECT_EQ(Reader(written, kind).number("/", "x"), x);
      if (x == 2.0) throw std::runtime_error("not as it should be");
    };
    if (x == 1.0)
      writer.commit(check);
    else
      EXPECT_THROW(writer.commit(check), std::runtime_error);
    EXPECT_EQ(Reader(file(), kind).number("/", "x"), 1.0);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(file().parent_path()), {}), 1);
}

TEST_F(RecordFile, CompressesWhatRepeats) {
  const std::vector<double> zeros(100000, 0.0);
  Writer writer(file(), kind);
  writer.array("zeros", std::span<const double>(zeros));
  writer.commit();
  EXPECT_LT(fs::file_size(file()), 8 * zeros.size() / 20);
}

TEST_F(RecordFile, NothingAppearsWithoutACommit) {
  {
    Writer writer(file(), kind);
    writer.number("/", "x", 1);
  }
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(RecordFile, ReplacesAnOldFile) {
  for (double x : {1.0, 2.0}) {
    Writer writer(file(), kind);
    writer.number("/", "x", x);
    writer.commit();
    EXPECT_EQ(Reader(file(), kind).number("/", "x"), x);
  }
}

TEST_F(RecordFile, ThreadsEachWithTheirOwnFile) {
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      for (int turn = 0; turn < 5; ++turn) {
        const fs::path path = file(std::to_string(k) + ".h5");
        const std::vector<double> values(5000, k + 0.5 * turn);
        Writer writer(path, kind);
        writer.array("values", std::span<const double>(values));
        writer.commit();
        EXPECT_EQ(Reader(path, kind).doubles("values").values, values);
      }
    });
  for (std::thread& thread : threads) thread.join();
}

TEST_F(RecordFile, WrongUseIsNamed) {
  const std::vector<double> five(5, 1.0);
  Writer writer(file(), kind);
  writer.array("a", std::span<const double>(five));
  writer.number("g", "x", 1);
  EXPECT_THROW(writer.array("a", std::span<const double>(five)), std::invalid_argument);
  EXPECT_THROW(writer.array("b", std::span<const double>(five), {2, 3}), std::invalid_argument);
  EXPECT_THROW(writer.number("g", "x", 2), std::invalid_argument);
  EXPECT_THROW(writer.number("a", "x", 2), std::invalid_argument);  // "a" is data
  writer.commit();
  EXPECT_THROW(writer.number("g", "y", 1), std::invalid_argument);
  const Reader reader(file(), kind);
  EXPECT_THROW(reader.floats("a"), std::runtime_error);  // stored as double
  EXPECT_THROW(reader.doubles("g"), std::runtime_error);
  EXPECT_THROW(reader.doubles("missing"), std::runtime_error);
  EXPECT_THROW(reader.text("g", "x"), std::runtime_error);
}

TEST(RecordTable, ARowHasAValueAColumn) {
  Table table;
  table.columns = {{"time", "s"}, {"torque", "N m"}};
  EXPECT_THROW(table.append_row(std::vector<double>{1.0}), std::invalid_argument);
  table.append_row(std::vector<double>{1.0, 2.0});
  EXPECT_EQ(table.rows(), 1u);
  EXPECT_TRUE(table.has("time"));
  EXPECT_FALSE(table.has("speed"));
  EXPECT_THROW(table.column("speed"), std::invalid_argument);
}

}  // namespace
