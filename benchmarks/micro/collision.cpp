// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Collision: one pair of rocks (axis, manifold, and FCL's two solvers on the same pairs), and steps of a
// recorded pile at rest and sliding. Pairs touch or nearly touch: separations uniform in [-20, 10] mm.
#include <benchmark/benchmark.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>

#include <drawpoint/engine/collision/fcl_axis.h>
#include <drawpoint/engine/geometry/convex_contact.h>
#include <drawpoint/engine/collision/contact_finder.hpp>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/tests/support/dense_rocks.hpp>
#include <map>
#include <random>

namespace {

using namespace drawpoint::engine;
namespace support = drawpoint::support;
using detail::AxisQuery;
using detail::AxisSearch;
using detail::CollisionHull;
using Eigen::Isometry3d;
using Eigen::Vector3d;

struct RockPair {
  int a, b;
  Isometry3d X_WA, X_WB;
};

Isometry3d random_pose(std::mt19937& rng, const Vector3d& position) {
  std::normal_distribution<double> normal;
  Isometry3d X = Isometry3d::Identity();
  X.linear() =
      Eigen::Quaterniond(normal(rng), normal(rng), normal(rng), normal(rng)).normalized().toRotationMatrix();
  X.translation() = position;
  return X;
}

const std::vector<CollisionHull>& hulls() {
  static const std::vector<CollisionHull> result(granular::rock_shapes().begin(),
                                                 granular::rock_shapes().end());
  return result;
}

std::vector<RockPair> rock_pairs() {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> gap(-0.02, 0.01);
  std::normal_distribution<double> normal;
  AxisSearch search;
  std::vector<RockPair> pairs;
  for (int k = 0; k < 1000; ++k) {
    const Vector3d along = Vector3d(normal(rng), normal(rng), normal(rng)).normalized();
    RockPair pair{k % 6, (k / 6) % 6, random_pose(rng, Vector3d::Zero()), random_pose(rng, along)};
    const double wanted = gap(rng);
    for (int step = 0; step < 30;
         ++step) {  // move B along the line of centres until the separation is the wanted one
      const auto axis =
          search.find({hulls()[pair.a], hulls()[pair.b], pair.X_WA.inverse() * pair.X_WB}, {10.0, 0, {}});
      pair.X_WB.translation() += (wanted - axis.separation) * along;
    }
    pairs.push_back(pair);
  }
  return pairs;
}

void separating_axis(benchmark::State& state) {
  const auto pairs = rock_pairs();
  AxisSearch search;
  std::size_t k = 0;
  for (auto _ : state) {
    const RockPair& p = pairs[k++ % pairs.size()];
    benchmark::DoNotOptimize(
        search.find({hulls()[p.a], hulls()[p.b], p.X_WA.inverse() * p.X_WB}, {0.011, 1e-4, {}}));
  }
}
BENCHMARK(separating_axis);

void axis_and_manifold(benchmark::State& state) {
  const auto pairs = rock_pairs();
  detail::ConvexContactSearch search;
  detail::ConvexContact contact;
  std::size_t k = 0;
  double points = 0;
  for (auto _ : state) {
    const RockPair& p = pairs[k++ % pairs.size()];
    search.find({hulls()[p.a], hulls()[p.b], p.X_WA.inverse() * p.X_WB}, {0.011, 1e-4, {}}, contact);
    points += contact.count;
  }
  state.counters["points"] = benchmark::Counter(points, benchmark::Counter::kAvgIterations);
}
BENCHMARK(axis_and_manifold);

std::shared_ptr<fcl::Convexd> fcl_shape(const ConvexPolyhedron& shape) {
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& face : shape.faces()) {
    faces->push_back(static_cast<int>(face.size()));
    faces->insert(faces->end(), face.begin(), face.end());
  }
  auto vertices = std::make_shared<std::vector<Vector3d>>(shape.vertices());
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(shape.faces().size()), faces);
}

// FCL's own answer to the same pairs, and how often it is wrong: a missed overlap, or a depth off by over 1
// mm.
void fcl_collide(benchmark::State& state, fcl::GJKSolverType solver) {
  const auto pairs = rock_pairs();
  std::vector<std::shared_ptr<fcl::Convexd>> shapes;
  for (const auto& shape : granular::rock_shapes()) shapes.push_back(fcl_shape(shape));
  const auto ask = [&](const RockPair& p, fcl::CollisionResultd& result) {
    fcl::CollisionRequestd request(1, true);
    request.gjk_solver_type = solver;
    fcl::collide(shapes[p.a].get(), p.X_WA, shapes[p.b].get(), p.X_WB, request, result);
  };
  std::size_t k = 0;
  for (auto _ : state) {
    fcl::CollisionResultd result;
    ask(pairs[k++ % pairs.size()], result);
    benchmark::DoNotOptimize(result);
  }
  AxisSearch search;
  int overlapping = 0, missed = 0, wrong = 0;
  for (const RockPair& p : pairs) {
    const double separation =
        search.find({hulls()[p.a], hulls()[p.b], p.X_WA.inverse() * p.X_WB}, {10.0, 0, {}}).separation;
    if (separation >= 0) continue;
    fcl::CollisionResultd result;
    ask(p, result);
    ++overlapping;
    if (!result.isCollision())
      ++missed;
    else if (std::abs(std::abs(result.getContact(0).penetration_depth) + separation) > 1e-3)
      ++wrong;
  }
  state.counters["overlapping"] = overlapping;
  state.counters["missed"] = missed;
  state.counters["depth_off_1mm"] = wrong;
}
BENCHMARK_CAPTURE(fcl_collide, libccd, fcl::GST_LIBCCD);
BENCHMARK_CAPTURE(fcl_collide, indep, fcl::GST_INDEP);

// FCL's axis checked, with the engine's manifold, as NarrowMethod has it; fcl_failures counts more.
void fcl_checked(benchmark::State& state, NarrowMethod method) {
  const auto pairs = rock_pairs();
  detail::FclAxes fcl(method);
  for (std::size_t k = 0; k < hulls().size(); ++k) fcl.add(static_cast<int>(k), &hulls()[k]);
  detail::ConvexContactSearch search;
  std::size_t k = 0;
  double refused = 0;
  for (auto _ : state) {
    const RockPair& p = pairs[k++ % pairs.size()];
    detail::ConvexContact contact;
    const bool used =
        detail::find_by_fcl(fcl, p.a, p.b, {hulls()[p.a], hulls()[p.b], p.X_WA.inverse() * p.X_WB},
                            {0.011, 1e-4, {}}, search, contact);
    refused += used ? 0 : 1;
  }
  state.counters["refused"] = benchmark::Counter(refused, benchmark::Counter::kAvgIterations);
}
BENCHMARK_CAPTURE(fcl_checked, libccd, NarrowMethod::fcl_libccd);
BENCHMARK_CAPTURE(fcl_checked, indep, NarrowMethod::fcl_indep);

// A finder that is shown a recorded motion of a pile, to and fro.
class Replay {
 public:
  Replay(const support::RockPile& pile, const std::vector<support::RockPile::Frame>& frames,
         const ContactFinderOptions& options = {})
      : frames_(frames), finder_(options) {
    for (const auto& wall : pile.walls) finder_.add({wall, -1, 0, false, Isometry3d::Identity()});
    for (std::size_t k = 0; k < pile.shapes.size(); ++k)
      ids_.push_back(finder_.add({pile.shapes[k], static_cast<int>(k), 0, true, Isometry3d::Identity()}));
    place();
    finder_.find();
  }

  void advance() {
    if (frame_ + 1 == frames_.size()) forward_ = false;
    if (frame_ == 0) forward_ = true;
    frame_ += forward_ ? 1 : -1;
    place();
  }
  ContactFinder& finder() { return finder_; }

 private:
  void place() {
    for (std::size_t k = 0; k < ids_.size(); ++k) finder_.set_pose(ids_[k], frames_[frame_][k]);
  }

  const std::vector<support::RockPile::Frame>& frames_;
  ContactFinder finder_;
  std::vector<int> ids_;
  std::size_t frame_ = 0;
  bool forward_ = true;
};

const support::RockPile& pile_of(int count) {
  static std::map<int, support::RockPile> piles;
  const auto known = piles.find(count);
  return known != piles.end() ? known->second
                              : piles.emplace(count, support::record_pile(count, 600, 12, 12)).first->second;
}

// set_pose() of all rocks and find(), per step. Arguments: rocks; 0 at rest, 1 sliding.
void find_in_pile(benchmark::State& state) {
  const auto& pile = pile_of(static_cast<int>(state.range(0)));
  Replay replay(pile, state.range(1) == 0 ? pile.rest : pile.slide);
  double points = 0, computed = 0, manifolds = 0, broad = 0, narrow = 0;
  for (auto _ : state) {
    replay.advance();
    const auto& found = replay.finder().find();
    manifolds += static_cast<double>(found.size());
    for (const auto& m : found) points += m.count;
    computed += replay.finder().times().computed;
    broad += 1e6 * replay.finder().times().broad;
    narrow += 1e6 * replay.finder().times().narrow;
  }
  const auto average = [](double sum) { return benchmark::Counter(sum, benchmark::Counter::kAvgIterations); };
  state.counters["pairs"] = replay.finder().times().pairs;
  state.counters["computed"] = average(computed);
  state.counters["manifolds"] = average(manifolds);
  state.counters["points"] = average(points);
  state.counters["broad_us"] = average(broad);
  state.counters["narrow_us"] = average(narrow);
}
BENCHMARK(find_in_pile)
    ->ArgNames({"rocks", "slides"})
    ->Args({300, 0})
    ->Args({300, 1})
    ->Args({1000, 0})
    ->Args({1000, 1})
    ->Args({3000, 0})
    ->Args({3000, 1})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
