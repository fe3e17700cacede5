// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A contact problem in a plain file is what docs/explanation/contact-solving.md promises to other programs, seen by the
// HDF5 library alone; what they write comes back as the same problem.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <drawpoint/tests/support/contact_problems.hpp>
#include <filesystem>
#include <fstream>
#include <map>

using namespace drawpoint;
using namespace drawpoint::engine::record;

namespace {

namespace fs = std::filesystem;

class PlainProblem : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file(const std::string& name) const { return folder_ / name; }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("drawpoint_plain_" + std::to_string(::getpid()));
};

// What other programs see of an array.
struct Seen {
  hid_t type = -1;  // H5T_IEEE_F64LE or H5T_STD_I32LE
  bool contiguous = false;
  std::vector<hsize_t> shape;
  std::string unit, description;
};

std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return "";
  const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT), type = H5Aget_type(attribute);
  std::string text(H5Tget_size(type), '\0');
  H5Aread(attribute, type, text.data());
  H5Tclose(type);
  H5Aclose(attribute);
  return text;
}

Seen seen(hid_t data) {
  Seen s;
  const hid_t type = H5Dget_type(data), space = H5Dget_space(data), list = H5Dget_create_plist(data);
  for (const hid_t known : {H5T_IEEE_F64LE, H5T_STD_I32LE})
    if (H5Tequal(type, known) > 0) s.type = known;
  s.contiguous = H5Pget_layout(list) == H5D_CONTIGUOUS && H5Pget_nfilters(list) == 0;
  s.shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, s.shape.data(), nullptr);
  s.unit = text_attribute(data, "unit");
  s.description = text_attribute(data, "description");
  H5Pclose(list);
  H5Sclose(space);
  H5Tclose(type);
  return s;
}

herr_t visit(hid_t root, const char* name, const H5O_info_t* info, void* found) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const hid_t data = H5Dopen2(root, name, H5P_DEFAULT);
  (*static_cast<std::map<std::string, Seen>*>(found))[name] = seen(data);
  H5Dclose(data);
  return 0;
}

std::map<std::string, Seen> arrays_of(const fs::path& path) {
  std::map<std::string, Seen> found;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, visit, &found, H5O_INFO_BASIC);
  H5Fclose(file);
  return found;
}

// A text as h5py stores a str.
void write_variable_text(const fs::path& path, const char* name, const char* text) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  H5Adelete(file, name);
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t attribute = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, &text);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
  H5Fclose(file);
}

void replace_by_floats(const fs::path& path, const char* name, hsize_t count) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
              space = H5Screate_simple(1, &count, nullptr);
  H5Ldelete(file, name, H5P_DEFAULT);
  H5Dclose(H5Dcreate2(file, name, H5T_IEEE_F32LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  H5Sclose(space);
  H5Fclose(file);
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

std::string complaint(const fs::path& path) {
  try {
    import_contact_problem(path);
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

}  // namespace

TEST_F(PlainProblem, ComesBackAsItWas) {
  const support::PushedStack scene;
  write_contact_problem(file("kept.h5"), scene.problem, "a note");
  export_contact_problem(file("plain.h5"), scene.problem, "a note");
  const RecordedProblem back = import_contact_problem(file("plain.h5"));
  EXPECT_EQ(problem_hash(back.problem), problem_hash(scene.problem));
  write_contact_problem(file("again.h5"), back.problem, back.note);
  EXPECT_TRUE(bytes_of(file("kept.h5")) == bytes_of(file("again.h5")));
}

// No chunks, filters, compound types or ragged rows; item first; every array says its unit and meaning.
TEST_F(PlainProblem, IsContiguousArraysOfTwoTypesWithUnits) {
  const support::PushedStack scene;
  export_contact_problem(file("plain.h5"), scene.problem);
  const auto arrays = arrays_of(file("plain.h5"));
  EXPECT_EQ(arrays.size(), 36u);  // 5 of bodies, 9 of pairs, 11 of points, 3 of the machine, 8 of its rows
  for (const auto& [name, array] : arrays) {
    EXPECT_TRUE(array.contiguous) << name;
    EXPECT_NE(array.type, -1) << name;
    EXPECT_NE(array.unit, "") << name;
    EXPECT_NE(array.description, "") << name;
  }
  const hsize_t bodies = scene.problem.bodies.size(), points = scene.problem.points.size();
  using Shape = std::vector<hsize_t>;
  EXPECT_EQ(arrays.at("bodies/inverse_inertia").shape, (Shape{bodies, 3, 3}));
  EXPECT_EQ(arrays.at("points/normal").shape, (Shape{points, 3}));
  EXPECT_EQ(arrays.at("points/gap").shape, (Shape{points}));
  EXPECT_EQ(arrays.at("machine/part_maps").shape, (Shape{2, 6, 2}));
  EXPECT_EQ(arrays.at("points/gap").type, H5T_IEEE_F64LE);
  EXPECT_EQ(arrays.at("pairs/first").type, H5T_STD_I32LE);
  EXPECT_EQ(arrays.at("points/stiffness").unit, "N/m");
}

TEST_F(PlainProblem, TextsOfVariableLengthAreRead) {
  const support::PushedStack scene;
  export_contact_problem(file("plain.h5"), scene.problem, "a note");
  write_variable_text(file("plain.h5"), "format", "drawpoint contact problem");
  write_variable_text(file("plain.h5"), "note", "from Python, with 5 µm");
  EXPECT_EQ(import_contact_problem(file("plain.h5")).note, "from Python, with 5 µm");
}

// A plain file is no checked one, and what other programs get wrong is told by name.
TEST_F(PlainProblem, WrongOnesAreRefused) {
  const support::PushedStack scene;
  export_contact_problem(file("plain.h5"), scene.problem);
  EXPECT_THROW(read_contact_problem(file("plain.h5")), std::runtime_error);
  replace_by_floats(file("plain.h5"), "points/gap", scene.problem.points.size());
  EXPECT_NE(complaint(file("plain.h5")).find("holds float32 at \"/points/gap\", not float64"),
            std::string::npos)
      << complaint(file("plain.h5"));
  std::ofstream(file("text.h5")) << "no HDF5";
  EXPECT_NE(complaint(file("text.h5")).find("cannot be opened by HDF5"), std::string::npos);
  EXPECT_NE(complaint(file("absent.h5")), "");
}

// The hash follows every field: another number anywhere is another problem.
TEST_F(PlainProblem, AnotherNumberIsAnotherHash) {
  support::PushedStack scene;
  const std::uint64_t hash = problem_hash(scene.problem);
  const auto changes = [&](double& number) {
    const double kept = number;
    number += 1e-12 + 1e-12 * std::abs(number);
    const bool seen = problem_hash(scene.problem) != hash;
    number = kept;
    return seen;
  };
  EXPECT_TRUE(changes(scene.problem.step));
  EXPECT_TRUE(changes(scene.problem.bodies[1].inverse_inertia(2, 1)));
  EXPECT_TRUE(changes(scene.problem.points.back().start.z()));
  EXPECT_TRUE(changes(scene.problem.points[0].restitution));
  EXPECT_TRUE(changes(scene.sled.part_maps[1](5, 1)));
  EXPECT_TRUE(changes(scene.sled.rows[1].start));
  EXPECT_EQ(problem_hash(scene.problem), hash);
  scene.problem.pairs[0].collider_a ^= 1;
  EXPECT_NE(problem_hash(scene.problem), hash);
}
