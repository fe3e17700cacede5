// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Every number that goes into a world is looked at first: what is not finite or out of its range is refused
// with its place, value and range, and the world is left as it was, bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/world/state_hash.hpp>
#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/support/told.hpp>
#include <functional>
#include <limits>
#include <memory>
#include <random>

using namespace drawpoint::engine;
using drawpoint::support::at;
using drawpoint::support::box_body;
using drawpoint::support::expect_told;
using drawpoint::support::one_material;
using drawpoint::support::shared;
using Eigen::Vector3d;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();

/// A body as the world knows machines, with one part at the origin; its speed comes out as it is told.
class OnePart final : public ArticulatedBody {
 public:
  double speed = 0;
  int advanced = 0;
  bool fails = false;

  int parts() const override { return 1; }
  Eigen::Isometry3d part_pose(int) const override { return at(0, 0, 50); }
  const SuperBody& linearise(double, const Vector3d&) override {
    super_.velocity_before = super_.velocity = Eigen::VectorXd::Constant(1, speed);
    super_.part_maps = {SpatialMap::Zero(6, 1)};
    super_.part_maps[0](3, 0) = 1;
    super_.origins = {Vector3d(0, 0, 50)};
    return super_;
  }
  void advance(const SuperBodySolution&) override {
    if (fails) throw std::runtime_error("OnePart cannot move");
    ++advanced;
  }
  std::vector<double> state() const override { return {static_cast<double>(advanced)}; }
  void set_state(const std::vector<double>& state) override { advanced = static_cast<int>(state.at(0)); }

 private:
  SuperBody super_;
};

class BadInput : public testing::Test {
 protected:
  void SetUp() override {
    drawpoint::support::add_floor(world);
    world.add_rock(box_body({0.2, 0.2, 0.2}), at(0, 0, 0.2));
    world.add_rock(box_body({0.2, 0.2, 0.2}), at(2, 0, 0.2));
    world.step();
    world.remove_rock(1);
    before = world.save();
  }
  void TearDown() override { EXPECT_EQ(world.save(), before) << "a refused call must change nothing"; }

  World world{{}, one_material({.friction = 0.5})};
  std::vector<std::byte> before;
};

TEST_F(BadInput, Poses) {
  const RockBody rock = box_body({0.1, 0.1, 0.1});
  for (double x : {nan, infinity, -infinity, 1e9}) {
    expect_told([&] { world.add_rock(rock, at(0, x, 0)); },
                {"World::add_rock", "position", "-100000 to 100000 m"});
    expect_told([&] { world.add_static(rock.shape, at(0, x, 0), 0); }, {"World::add_static", "position"});
  }
  for (double x : {nan, infinity, 0.0, -1.0, 2.0}) {
    Eigen::Isometry3d skewed = at(0, 0, 1);
    skewed.linear()(1, 1) = x;  // not finite, singular, a reflection, stretched
    expect_told([&] { world.add_rock(rock, skewed); },
                {"World::add_rock", "no rotation matrix", "below 1e-6"});
  }
}

TEST_F(BadInput, Velocities) {
  for (double x : {nan, infinity, 1001.0}) {
    expect_told(
        [&] {
          world.add_rock(box_body({0.1, 0.1, 0.1}), at(0, 0, 1), {0, x, 0});
        },
        {"World::add_rock", "speed", "0 to 1000 m/s"});
    expect_told(
        [&] {
          world.set_rock_velocity(0, {x, 0, 0}, {0, 0, 0});
        },
        {"set_rock_velocity", "speed", "m/s"});
    expect_told(
        [&] {
          world.set_rock_velocity(0, {0, 0, 0}, {0, 0, 10 * x});
        },
        {"set_rock_velocity", "angular speed", "0 to 10000 rad/s"});
  }
}

TEST_F(BadInput, RockBodies) {
  const auto add = [&](const std::function<void(RockBody&)>& spoil) {
    return [this, spoil] {
      RockBody body = box_body({0.1, 0.1, 0.1});
      spoil(body);
      world.add_rock(body, at(0, 0, 1));
    };
  };
  for (double x : {nan, infinity, 0.0, -1.0}) {
    expect_told(add([&](RockBody& b) { b.mass = x; }), {"add_rock", "mass", "kg"});
    expect_told(add([&](RockBody& b) { b.inertia[1] = x; }), {"add_rock", "moment of inertia", "kg m^2"});
  }
  expect_told(add([](RockBody& b) { b.inertia = {1, 1, 3}; }), {"no rigid body", "(1, 1, 3)"});
  expect_told(add([](RockBody& b) { b.shape = nullptr; }), {"has no shape"});
  expect_told(add([](RockBody& b) { b.shape = shared(HalfSpace{Vector3d::UnitZ(), 0}); }), {"half-space"});
  expect_told(add([](RockBody& b) { b.material = 1; }), {"no material 1", "0 to 0"});
  expect_told(
      [&] {
        world.add_static(shared(box({1, 1, 1})), at(0, 0, 0), -1);
      },
      {"add_static", "no material -1"});
  expect_told([&] { world.add_static(nullptr, at(0, 0, 0), 0); }, {"no shape"});
  expect_told(
      [&] {
        world.add_static(shared(HalfSpace{Vector3d(0, 0, nan), 0}), at(0, 0, 0), 0);
      },
      {"unit normal"});
  expect_told([&] { world.add_static(shared(Cylinder{nan, 1}), at(0, 0, 0), 0); }, {"cylinder", "nan"});
}

TEST_F(BadInput, RocksThatAreNotThere) {
  for (int rock : {-1, 2, 1000}) {
    expect_told([&] { world.remove_rock(rock); }, {"remove_rock", "no rock " + std::to_string(rock)});
    expect_told(
        [&] {
          world.set_rock_velocity(rock, {0, 0, 0}, {0, 0, 0});
        },
        {"set_rock_velocity", "no rock"});
  }
  expect_told([&] { world.remove_rock(1); }, {"remove_rock", "rock 1 was removed"});
  expect_told([&] { world.set_rock_velocity(1, {0, 0, 0}, {0, 0, 0}); }, {"rock 1 was removed"});
  expect_told(
      [&] {
        world.add_part_shape(0, shared(box({1, 1, 1})), at(0, 0, 0), 0);
      },
      {"no part 0", "has 0"});
}

TEST_F(BadInput, StepsThatAreTooShortOrTooLong) {
  for (double h : {0.0, 5e-324, 9e-10, 0.11, -0.01, nan, infinity})
    expect_told([&] { world.step(h); }, {"World::step", "step is", "1e-09 to 0.1 s"});
}

// A box falls on the floor and lies there, in steps of any lengths. What overlaps is pushed apart at 1 m/s at most, so
// it never has more energy than it fell with and that. An impact that a short step ends is no load for a long step that
// follows.
TEST(Steps, OfAnyLengthsMakeNoEnergy) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> power(-9, -1), height(0, 0.5);
  for (int trial = 0; trial < 50; ++trial) {
    World world({}, one_material({.friction = 0.5}));
    drawpoint::support::add_floor(world);
    const double above = height(rng);
    const int box = world.add_rock(box_body({0.2, 0.2, 0.2}), at(0, 0, 0.2 + above));
    for (int k = 0; k < 200; ++k) {
      world.step(std::pow(10.0, power(rng)));
      const double energy = world.kinetic_energy() / world.rock(box).body.mass +
                            9.81 * (world.rock(box).pose.translation().z() - 0.2);
      ASSERT_LT(energy, 9.81 * above + 0.5 * 1.0 * 1.0) << "trial " << trial << ", step " << k;
    }
  }
}

TEST(BadOptions, AreRefusedByName) {
  struct Case {
    const char* words;
    std::function<void(WorldOptions&, double)> set;
  };
  const std::vector<Case> cases{
      {"step", [](WorldOptions& o, double x) { o.step = x; }},
      {"gravity", [](WorldOptions& o, double x) { o.gravity.y() = x; }},
      {"warm_start", [](WorldOptions& o, double x) { o.warm_start = x; }},
      {"tolerance", [](WorldOptions& o, double x) { o.solver.tolerance = x; }},
      {"margin", [](WorldOptions& o, double x) { o.contacts.margin = x; }},
      {"slack", [](WorldOptions& o, double x) { o.contacts.slack = x; }},
      {"reuse_distance", [](WorldOptions& o, double x) { o.contacts.reuse_distance = x; }},
      {"reuse_angle", [](WorldOptions& o, double x) { o.contacts.reuse_angle = x; }},
      {"hysteresis", [](WorldOptions& o, double x) { o.contacts.hysteresis = x; }}};
  for (const Case& c : cases)
    for (double x : {nan, infinity, -infinity, 1e300}) {
      WorldOptions options;
      c.set(options, x);
      expect_told([&] { World(options, MaterialTable()); }, {c.words});
    }
  for (int x : {0, -1, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    const std::vector<std::pair<const char*, std::function<void(WorldOptions&)>>> counts{
        {"iterations", [x](WorldOptions& o) { o.solver.iterations = x; }},
        {"substeps", [x](WorldOptions& o) { o.solver.substeps = x; }},
        {"threads", [x](WorldOptions& o) { o.threads = x; }}};
    for (const auto& [name, set] : counts) {
      WorldOptions options;
      set(options);
      expect_told([&] { World(options, MaterialTable()); }, {name});
    }
  }
}

TEST(BadMaterials, AreRefusedByName) {
  using Set = void (*)(Material&, double);
  const std::vector<std::pair<const char*, Set>> cases{
      {"friction", [](Material& m, double x) { m.friction = x; }},
      {"rolling", [](Material& m, double x) { m.rolling = x; }},
      {"spinning", [](Material& m, double x) { m.spinning = x; }},
      {"stiffness", [](Material& m, double x) { m.stiffness = x; }},
      {"damping", [](Material& m, double x) { m.damping_time = x; }},
      {"restitution", [](Material& m, double x) { m.restitution = x; }}};
  for (const auto& [name, set] : cases)
    for (double x : {nan, infinity, -1.0}) {
      MaterialTable table(2);
      Material material{.friction = 0.5};
      set(material, x);
      table.set(0, 1, material);
      expect_told([&] { World({}, table); }, {"kinds 0 and 1", name});
    }
  MaterialTable table(2);
  expect_told([&] { table.set(0, 2, {}); }, {"no kinds 0 and 2", "0 to 1"});
  expect_told([] { MaterialTable(0); }, {"0 kinds"});
}

TEST(BadMachines, AreRefusedOrDetached) {
  World world({}, one_material({.friction = 0}));
  OnePart machine;
  world.attach(&machine);
  expect_told(
      [&] {
        world.add_part_shape(1, shared(box({1, 1, 1})), at(0, 0, 0), 0);
      },
      {"no part 1", "has 1"});
  expect_told([&] { world.add_part_shape(0, nullptr, at(0, 0, 0), 0); }, {"part 0", "no shape"});
  expect_told([&] { world.add_part_shape(0, shared(box({1, 1, 1})), at(nan, 0, 0), 0); }, {"position"});
  world.add_part_shape(0, shared(box({1, 1, 1})), at(0, 0, 0), 0);
  world.step();
  world.attach(nullptr);
  world.step();
  EXPECT_EQ(machine.advanced, 1);
}

// A solution that comes out not finite is told before anything has moved, and the world can go on.
TEST(BrokenSolution, IsToldAndMovesNothing) {
  World world({}, one_material({.friction = 0}));
  OnePart machine;
  world.attach(&machine);
  world.add_part_shape(0, shared(box({1, 1, 1})), at(0, 0, 0), 0);
  world.add_rock(box_body({0.2, 0.2, 0.2}), at(0, 0, 0.2));
  world.step();
  for (double bad : {nan, infinity}) {
    machine.speed = bad;
    const std::uint64_t before = state_hash(world);
    try {
      world.step();
      FAIL() << "a machine's speed of " << bad << " went through";
    } catch (const SolutionBroken& error) {
      EXPECT_NE(std::string(error.what()).find("step 2 at t = 0.01"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("machine"), std::string::npos) << error.what();
    }
    EXPECT_EQ(state_hash(world), before);
  }
  machine.speed = 0;
  world.step();
  EXPECT_EQ(machine.advanced, 2);
}

// A machine that cannot move has moved nothing else, and the step that follows starts from what the last one
// left, not from the impulses of the step that failed: a world that never failed goes on with the same bits.
TEST(BrokenSolution, OfAMachineThatCannotMoveIsForgotten) {
  OnePart machine, other;
  WorldOptions options;
  options.solver.iteration_budget = 0;  // so few iterations that what they start from shows
  World world(options, one_material({.friction = 0.5})), untouched(options, one_material({.friction = 0.5}));
  const auto set_up = [](World& w, OnePart& m) {
    w.attach(&m);
    drawpoint::support::add_floor(w);
    w.add_rock(box_body({0.2, 0.2, 0.2}), at(0, 0, 0.2), {0.3, 0.1, -0.02});
    for (int k = 0; k < 3; ++k) w.step();
  };
  set_up(world, machine);
  set_up(untouched, other);
  machine.fails = true;
  const std::uint64_t before = state_hash(world);
  EXPECT_THROW(world.step(), std::runtime_error);
  EXPECT_EQ(state_hash(world), before);
  machine.fails = false;
  world.step();
  untouched.step();
  EXPECT_EQ(state_hash(world), state_hash(untouched));
}

// The problem of the last step is the world's: it stays what it was whatever becomes of the machine, whose
// super-body is valid until it advances.
TEST(BadMachines, LeaveTheProblemOfTheLastStepWhole) {
  World world({}, one_material({.friction = 0}));
  auto machine = std::make_unique<OnePart>();
  machine->speed = 3;
  world.attach(machine.get());
  world.add_part_shape(0, shared(box({1, 1, 1})), at(0, 0, 0), 0);
  world.step();
  const auto expect_as_solved = [&] {
    ASSERT_NE(world.problem().machine, nullptr);
    EXPECT_EQ(world.problem().machine->velocity, Eigen::VectorXd::Constant(1, 3.0));
    EXPECT_EQ(world.problem().machine->part_maps.size(), 1u);
  };
  machine->speed = 5;
  machine->linearise(0.01, {0, 0, 0});
  expect_as_solved();
  world.attach(nullptr);
  machine.reset();
  expect_as_solved();
  world.step();
  EXPECT_EQ(world.problem().machine, nullptr);
}

}  // namespace
