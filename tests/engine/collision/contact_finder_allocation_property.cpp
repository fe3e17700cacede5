// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/tests/support/contact_pairs.hpp>
#include <drawpoint/tests/support/exact_contact.hpp>
#include <new>

namespace {

long allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

using namespace drawpoint;
using Eigen::Vector3d;
using engine::ContactFinder;

// A heap that shakes about one place: after the first round every buffer has its size and find() asks for no
// memory, neither where manifolds are reused nor where they are computed anew.
TEST(ContactFinder, AsksForNoMemoryOnceItRuns) {
  std::mt19937 rng(4);
  ContactFinder finder;
  finder.add(support::collider_of(support::share(engine::HalfSpace{Vector3d::UnitZ(), 0}), -1, false));
  std::vector<Eigen::Isometry3d> poses;
  for (int k = 0; k < 64; ++k) {
    const Vector3d cell(k % 4, k / 4 % 4, k / 16);
    poses.push_back(support::pose_at(0.36 * cell + Vector3d(0, 0, 0.2), support::random_rotation(rng)));
    finder.add(support::collider_of(support::share(engine::granular::rock_shapes()[k % 6].scaled(0.45)), k));
  }
  int computed = 0;
  const auto round = [&] {
    for (double step : {0.0, 1e-4, 3e-3, 0.03, 0.0})
      for (const Vector3d& along : {Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(0, 0, 1)}) {
        for (int k = 0; k < 64; ++k) {
          Eigen::Isometry3d X = poses[static_cast<std::size_t>(k)];
          X.translation() += (k % 2 == 0 ? step : -step) * along;
          finder.set_pose(k + 1, X);
        }
        finder.find();
        computed += finder.times().computed;
      }
  };
  round();
  round();
  computed = 0;
  allocations = 0;
  round();
  EXPECT_EQ(allocations, 0);
  EXPECT_GT(computed, 100);  // pairs apart are settled without a search
}
