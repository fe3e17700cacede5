// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A contact problem that went through a file is solved to the same bits; damaged and unsound ones are
// refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <drawpoint/engine/record/file.hpp>
#include <drawpoint/engine/solver/solver.hpp>
#include <drawpoint/tests/support/contact_problems.hpp>
#include <fstream>
#include <functional>

using namespace drawpoint;
using namespace drawpoint::engine;
using engine::record::problem_hash;
using engine::record::read_contact_problem;
using engine::record::RecordedProblem;
using engine::record::write_contact_problem;

namespace {

namespace fs = std::filesystem;

class ContactProblemFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file(const std::string& name = "problem.h5") const { return folder_ / name; }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("drawpoint_problem_" + std::to_string(::getpid()));
};

using Scene = support::PushedStack;

template <class M>
bool same(const M& a, const M& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(*a.data())) == 0;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

std::string complaint(const fs::path& path) {
  try {
    read_contact_problem(path);
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

// One body and a machine of one part and two freedoms, without contacts, as the version writes it. Up to version
// 2 matrices are stored by columns, one row of numbers per item.
void write_one_body(const fs::path& path, int version, const std::string& external, double step) {
  engine::record::Writer writer(path, {"drawpoint contact problem", version});
  writer.text("/", "note", "one body");
  writer.number("/", "step", step);
  const auto doubles = [&](const std::string& at, const std::vector<double>& values, std::size_t width) {
    writer.array(at, std::span<const double>(values), {values.size() / width, width});
  };
  const auto no_numbers = [&](const std::string& group, const std::vector<std::string>& names) {
    for (const std::string& name : names) writer.array(group + name, std::span<const double>());
  };
  const auto no_integers = [&](const std::string& group, const std::vector<std::string>& names) {
    for (const std::string& name : names) writer.array(group + name, std::span<const std::int32_t>());
  };
  doubles("bodies/velocity", {1, 0, 0}, 3);
  doubles("bodies/angular_velocity", {0, 2, 0}, 3);
  doubles("bodies/" + external, {0, 0, -0.0981}, 3);
  if (version < 3)
    doubles("bodies/inverse_inertia", std::vector<double>(9, 0), 9);
  else
    writer.array("bodies/inverse_inertia", std::vector<double>(9, 0), {1, 3, 3});
  const std::vector<double> inverse_mass{0.5};
  writer.array("bodies/inverse_mass", std::span<const double>(inverse_mass));
  no_integers("pairs/", {"a", "b", "collider_a", "collider_b", "first", "count"});
  no_numbers("pairs/", {"rolling_arm", "spinning_arm"});
  doubles("pairs/start", {}, 3);
  no_integers("points/", {"feature"});
  no_numbers("points/", {"gap", "stiffness", "damping_time", "friction", "restitution"});
  for (const char* name : {"position", "arm_a", "arm_b", "normal", "start"})
    doubles(std::string("points/") + name, {}, 3);
  doubles("machine/velocities", {1, 2, 3, 4}, 2);
  doubles("machine/origins", {7, 8, 9}, 3);
  const std::vector<double> by_columns{0, 1, 2, 3, 4, 5, 10, 11, 12, 13, 14, 15},
      by_rows{0, 10, 1, 11, 2, 12, 3, 13, 4, 14, 5, 15};
  writer.array("machine/part_maps", version < 3 ? by_columns : by_rows,
               version < 3 ? std::vector<std::size_t>{1, 12} : std::vector<std::size_t>{1, 6, 2});
  doubles("machine/rows/jacobian", {}, 2);
  no_integers("machine/rows/", {"kind"});
  no_numbers("machine/rows/", {"target", "gap", "recovery", "lower", "upper", "start"});
  writer.commit();
}

}  // namespace

// Version 1 says push for the external velocity change; versions 1 and 2 store matrices by columns.
TEST_F(ContactProblemFile, OldAndNewVersionsAreRead) {
  write_one_body(file("1.h5"), 1, "push", 0.01);
  write_one_body(file("2.h5"), 2, "external_velocity_change", 0.01);
  write_one_body(file("3.h5"), 3, "external_velocity_change", 0.01);
  const std::uint64_t hash = problem_hash(read_contact_problem(file("3.h5")).problem);
  for (const char* name : {"1.h5", "2.h5", "3.h5"}) {
    const RecordedProblem read = read_contact_problem(file(name));
    ASSERT_EQ(read.problem.bodies.size(), 1u) << name;
    EXPECT_EQ(read.problem.bodies[0].external_velocity_change, Eigen::Vector3d(0, 0, -0.0981)) << name;
    const SpatialMap& map = read.problem.machine->part_maps.at(0);
    for (int row = 0; row < 6; ++row)
      EXPECT_TRUE(map(row, 0) == row && map(row, 1) == 10 + row) << name << ":\n" << map;
    EXPECT_EQ(problem_hash(read.problem), hash) << name;
    write_contact_problem(file("again.h5"), read.problem);
    const engine::record::Reader again(file("again.h5"), {"drawpoint contact problem", 3});
    EXPECT_TRUE(again.has("bodies/external_velocity_change") && !again.has("bodies/push")) << name;
  }
  write_one_body(file("newer.h5"), 4, "external_velocity_change", 0.01);
  EXPECT_NE(complaint(file("newer.h5")).find("has version 4 of its format, not 1 to 3"), std::string::npos);
}

TEST_F(ContactProblemFile, IsSolvedToTheSameBits) {
  Scene scene;
  ASSERT_GT(scene.problem.points.size(), 10u);
  write_contact_problem(file(), scene.problem, "six boxes and a sled");
  const RecordedProblem stored = read_contact_problem(file());
  RecordedProblem read = stored;  // a copy stays whole
  EXPECT_EQ(read.note, "six boxes and a sled");
  const SolverOptions options{.substeps = 3, .iterations = 7};
  const SolverReport a = solve(scene.problem, options), b = solve(read.problem, options);
  EXPECT_TRUE(same(a.machine.velocity, b.machine.velocity));
  EXPECT_TRUE(same(a.machine.row_impulses, b.machine.row_impulses));
  for (std::size_t k = 0; k < scene.problem.bodies.size(); ++k) {
    EXPECT_TRUE(same(scene.problem.bodies[k].velocity, read.problem.bodies[k].velocity));
    EXPECT_TRUE(same(scene.problem.bodies[k].rotation_vector, read.problem.bodies[k].rotation_vector));
  }
  for (std::size_t k = 0; k < scene.problem.points.size(); ++k)
    EXPECT_TRUE(same(scene.problem.points[k].impulse, read.problem.points[k].impulse));
}

// What the solve does not read comes back, too: written again, the file is the same, byte for byte.
TEST_F(ContactProblemFile, IsTheSameFileWhenWrittenAgain) {
  const Scene scene;
  write_contact_problem(file(), scene.problem, "again");
  const RecordedProblem read = read_contact_problem(file());
  EXPECT_EQ(read.problem.points.back().feature, 0xfedcba98u);
  EXPECT_EQ(read.problem.pairs[1].collider_b, scene.problem.pairs[1].collider_b);
  write_contact_problem(file("again.h5"), read.problem, read.note);
  EXPECT_TRUE(bytes_of(file()) == bytes_of(file("again.h5")));
}

TEST_F(ContactProblemFile, MayBeEmpty) {
  ContactProblem nothing;
  nothing.step = 0.01;
  write_contact_problem(file(), nothing);
  const RecordedProblem read = read_contact_problem(file());
  EXPECT_EQ(read.problem.step, 0.01);
  EXPECT_TRUE(read.problem.points.empty() && read.problem.bodies.empty() && !read.problem.machine);
}

TEST_F(ContactProblemFile, DamageIsRefused) {
  const Scene scene;
  write_contact_problem(file(), scene.problem);
  const std::string whole = bytes_of(file());
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 61) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    std::ofstream(file("flipped.h5"), std::ios::binary) << flipped;
    EXPECT_NE(complaint(file("flipped.h5")), "") << "byte " << at;
    std::ofstream(file("short.h5"), std::ios::binary) << whole.substr(0, at);
    EXPECT_NE(complaint(file("short.h5")), "") << "length " << at;
  }
  EXPECT_NE(complaint(file("absent.h5")), "");
}

// Each unsound problem is named by its field and refused before anything is written.
TEST_F(ContactProblemFile, UnsoundProblemsAreRefused) {
  struct Case {
    std::string words;
    std::function<void(Scene&)> spoil;
  };
  const double nan = std::nan("");
  const std::vector<Case> cases{
      {"root/step of row 0 is -0.005", [](Scene& s) { s.problem.step = -0.005; }},
      {"bodies/velocity of row 2 is not finite", [&](Scene& s) { s.problem.bodies[2].velocity.x() = nan; }},
      {"bodies/inverse_mass of row 1 is -1", [](Scene& s) { s.problem.bodies[1].inverse_mass = -1; }},
      {"pairs/b of row 0 is 99", [](Scene& s) { s.problem.pairs[0].b = 99; }},
      {"pairs/a of row 0 is -3", [](Scene& s) { s.problem.pairs[0].a = -3; }},
      {"pairs/first of row 1", [](Scene& s) { s.problem.pairs[1].first = 0; }},
      {"pairs/count of row 0 is 0", [](Scene& s) { s.problem.pairs[0].count = 0; }},
      {"all points belong to a pair", [](Scene& s) { s.problem.pairs.pop_back(); }},
      {"points/normal of row 3 is of length 2", [](Scene& s) { s.problem.points[3].normal *= 2; }},
      {"points/stiffness of row 0 is 0", [](Scene& s) { s.problem.points[0].stiffness = 0; }},
      {"points/friction of row 1 is 0.3", [](Scene& s) { s.problem.points[1].friction = 0.3; }},
      {"points/normal of row 1 is (1, 0, 0)",
       [](Scene& s) { s.problem.points[1].normal = Eigen::Vector3d::UnitX(); }},
      {"points/restitution of row 1 is 1.5", [](Scene& s) { s.problem.points[1].restitution = 1.5; }},
      {"machine/rows/lower of row 1 is 900", [](Scene& s) { s.sled.rows[1].lower = 900; }},
      {"machine/part_maps of row 1", [](Scene& s) { s.sled.part_maps[1] = SpatialMap::Zero(6, 3); }},
      {"machine/rows/jacobian of row 0",
       [](Scene& s) { s.sled.rows[0].jacobian = Eigen::Vector3d::Zero(); }}};
  for (const Case& c : cases) {
    Scene scene;
    c.spoil(scene);
    try {
      write_contact_problem(file(), scene.problem);
      ADD_FAILURE() << "accepted; expected: " << c.words;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(c.words), std::string::npos) << error.what();
    }
    EXPECT_FALSE(fs::exists(file()));
  }
}

// A sound file of the right kind with an unsound problem: the reader checks what it read.
TEST_F(ContactProblemFile, UnsoundFilesAreRefused) {
  write_one_body(file(), 3, "external_velocity_change", 0);
  EXPECT_NE(complaint(file()).find("problem.h5"), std::string::npos) << complaint(file());
}
