// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Same input, same bits: twice in a row, on any number of threads, and across saving and restoring in
// mid-run. The scene is a heap under a moving blade, so that contacts form, slide and part in every step.
#include <gtest/gtest.h>

#include <drawpoint/engine/world/state_hash.hpp>
#include <drawpoint/tests/support/blade_pile.hpp>

using namespace drawpoint::engine;
using drawpoint::support::BladePile;

namespace {

constexpr int rocks = 60, half = 150;

WorldOptions options(int threads = 1, Method method = Method::sequential) {
  WorldOptions o;
  o.solver.method = method;
  o.threads = threads;
  return o;
}

std::uint64_t hash_after(BladePile& pile, int steps) {
  pile.run(steps);
  return state_hash(pile.world());
}

class SameBits : public testing::TestWithParam<Method> {};

TEST_P(SameBits, TwiceInARowAndOnAnyNumberOfThreads) {
  BladePile first(rocks, options(1, GetParam()));
  const std::uint64_t expected = hash_after(first, 2 * half);
  EXPECT_GT(first.blade().coordinate(0), 0.5) << "the blade must have reached the rocks";
  EXPECT_GT(first.report().points, 200);
  for (int threads : {1, 2, 3, 8}) {
    BladePile again(rocks, options(threads, GetParam()));
    EXPECT_EQ(hash_after(again, 2 * half), expected) << threads << " threads";
  }
}

TEST_P(SameBits, AcrossSaveAndRestore) {
  BladePile original(rocks, options(1, GetParam()));
  original.run(half / 2);
  original.world().remove_rock(5);
  original.run(half / 2);
  const std::vector<std::byte> saved = original.world().save();
  const std::uint64_t middle = state_hash(original.world());
  const std::uint64_t end = hash_after(original, half);
  EXPECT_NE(middle, end);

  BladePile fresh(rocks, options(2, GetParam()));
  fresh.world().restore(saved);
  EXPECT_EQ(state_hash(fresh.world()), middle);
  EXPECT_EQ(fresh.world().save(), saved);
  EXPECT_EQ(hash_after(fresh, half), end);

  // Back in time, in the same world, with a rock that was removed since.
  original.world().remove_rock(6);
  original.world().restore(saved);
  EXPECT_EQ(hash_after(original, half), end);
}

// Between two steps rocks may be taken away and pushed: the pending changes are part of the state.
TEST_P(SameBits, AcrossSaveAndRestoreWithChangesPending) {
  BladePile original(rocks, options(1, GetParam()));
  original.run(half);
  original.world().remove_rock(11);
  original.world().set_rock_velocity(3, {1, 0, 2}, {0, 3, 0});
  original.blade().set_motor(0, -0.4);
  const std::vector<std::byte> saved = original.world().save();
  const std::uint64_t end = hash_after(original, half);
  BladePile fresh(rocks, options(1, GetParam()));
  fresh.world().restore(saved);
  EXPECT_EQ(hash_after(fresh, half), end);
}

INSTANTIATE_TEST_SUITE_P(Methods, SameBits, testing::Values(Method::sequential, Method::batched),
                         [](const auto& info) { return std::string(to_string(info.param)); });

// Solved by other options for a while: as a world that has had them from the start, and no trace of it once they are
// set back.
TEST(SetSolver, SolvesLaterStepsAndLeavesNoTrace) {
  WorldOptions other = options(1, Method::batched);
  other.solver.substeps = 4;
  other.solver.iterations = 3;
  BladePile pile(rocks, options()), from_the_start(rocks, other);
  const std::vector<std::byte> saved = pile.world().save();
  const std::uint64_t end = hash_after(pile, half);
  pile.world().restore(saved);
  pile.world().set_solver(other.solver);
  EXPECT_EQ(hash_after(pile, half), hash_after(from_the_start, half));
  EXPECT_EQ(pile.world().options().solver.substeps, 4);
  EXPECT_THROW(pile.world().restore(saved), std::runtime_error) << "a state of other options";
  pile.world().set_solver(options().solver);
  pile.world().restore(saved);
  EXPECT_EQ(hash_after(pile, half), end);
}

TEST(SetSolver, RefusesWhatCannotBeAndChangesNothing) {
  BladePile pile(3, options());
  const std::vector<std::byte> saved = pile.world().save();
  SolverOptions bad;
  bad.substeps = 0;
  EXPECT_THROW(pile.world().set_solver(bad), std::invalid_argument);
  EXPECT_EQ(pile.world().save(), saved);
}

// The hash must see any single bit of any rock.
TEST(StateHash, SeesOneBit) {
  BladePile a(3, options()), b(3, options());
  EXPECT_EQ(state_hash(a.world()), state_hash(b.world()));
  b.world().set_rock_velocity(2, {0, 0, -0.0}, {0, 0, 0});
  EXPECT_NE(state_hash(a.world()), state_hash(b.world()));
}

std::string refusal(BladePile& pile, const std::vector<std::byte>& state) {
  const std::uint64_t before = state_hash(pile.world());
  const std::vector<std::byte> all = pile.world().save();
  try {
    pile.world().restore(state);
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(state_hash(pile.world()), before);
    EXPECT_EQ(pile.world().save(), all);
    return error.what();
  }
  return "taken";
}

TEST(Restore, RefusesAnotherScene) {
  BladePile original(10, options());
  original.run(5);
  const std::vector<std::byte> saved = original.world().save();
  const auto told = [&](BladePile& pile) { return refusal(pile, saved); };

  WorldOptions finer = options();
  finer.step = 0.004;
  BladePile other_options(10, finer), more_rocks(11, options()), another_wall(10, options());
  another_wall.world().add_static(drawpoint::support::shared(box({1, 1, 1})), drawpoint::support::at(0, 0, 9),
                                  0);
  EXPECT_NE(told(other_options).find("other options"), std::string::npos) << told(other_options);
  EXPECT_NE(told(more_rocks).find("other rocks"), std::string::npos) << told(more_rocks);
  EXPECT_NE(told(another_wall).find("other fixed surroundings"), std::string::npos) << told(another_wall);
  BladePile right(10, options());
  EXPECT_EQ(told(right), "taken");
}

// Cut anywhere, or with any byte changed, a state is refused whole or gives a world that can be stepped: it
// never crashes, hangs or half-restores. (A change in a mantissa is a valid state; the file's checksum sees
// it.)
TEST(Restore, SurvivesCutAndFlippedBytes) {
  BladePile original(6, options());
  original.run(60);
  const std::vector<std::byte> saved = original.world().save();
  BladePile target(6, options());
  for (std::size_t length = 0; length < saved.size(); length += 1 + saved.size() / 199)
    EXPECT_NE(refusal(target, {saved.begin(), saved.begin() + static_cast<std::ptrdiff_t>(length)}), "taken");
  int taken = 0;
  for (std::size_t at = 0; at < saved.size(); at += 1 + saved.size() / 499) {
    BladePile world(6, options());
    std::vector<std::byte> flipped = saved;
    flipped[at] ^= std::byte{0x80};
    if (refusal(world, flipped) != "taken") continue;
    ++taken;
    try {
      world.run(2);
    } catch (const SolutionBroken&) {
    }
    for (const Rock& rock : world.world().rocks()) EXPECT_TRUE(rock.velocity.allFinite()) << at;
  }
  EXPECT_GT(taken, 100);
}

}  // namespace
