// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Collision: one pair of rocks (axis, manifold, and FCL's two solvers on the same pairs), and find() on a bed
// of rocks that rest, shake and roll. Pairs touch or nearly touch: separations uniform in [-20, 10] mm.
#include <benchmark/benchmark.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>

#include <drawpoint/engine/contact/contact_finder.hpp>
#include <drawpoint/engine/contact/convex_contact.hpp>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <random>

namespace {

using namespace drawpoint::engine;
using contact::detail::AxisQuery;
using contact::detail::AxisSearch;
using contact::detail::CollisionHull;
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
  contact::detail::ConvexContactSearch search;
  std::size_t k = 0;
  double points = 0;
  for (auto _ : state) {
    const RockPair& p = pairs[k++ % pairs.size()];
    const auto contact =
        search.find({hulls()[p.a], hulls()[p.b], p.X_WA.inverse() * p.X_WB}, {0.011, 1e-4, {}});
    points += contact.count;
  }
  state.counters["points"] = benchmark::Counter(points, benchmark::Counter::kAvgIterations);
}
BENCHMARK(axis_and_manifold);

std::shared_ptr<fcl::Convexd> fcl_shape(const contact::ConvexPolyhedron& shape) {
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

// A bed of rocks of 0.40 and 0.45 m on a plane, at random turns on a grid of 0.3 m, so that each touches
// about six others.
class Bed {
 public:
  explicit Bed(int count) : rng_(3) {
    std::vector<std::shared_ptr<const contact::Shape>> shapes;
    for (const auto& rock : granular::rock_shapes())
      shapes.push_back(std::make_shared<contact::Shape>(rock.scaled(0.45)));
    for (const auto& rock : granular::rock_shapes())
      shapes.push_back(std::make_shared<contact::Shape>(rock.scaled(0.4)));
    finder_.add({std::make_shared<contact::Shape>(contact::HalfSpace{Vector3d::UnitZ(), 0}), -1, 0, 0, false,
                 Isometry3d::Identity()});
    const int side = 10;
    for (int k = 0; k < count; ++k) {
      const Vector3d cell(k % side, k / side % side, k / (side * side));
      poses_.push_back(random_pose(rng_, 0.3 * cell + Vector3d(0, 0, 0.14)));
      ids_.push_back(finder_.add(
          {shapes[static_cast<std::size_t>(k) % shapes.size()], k, 0, 0, true, Isometry3d::Identity()}));
      finder_.set_pose(ids_.back(), poses_.back());
    }
    finder_.find();
  }

  // Every rock moves by a step of this length [m] and turns by the angle [rad] in a random direction.
  void shake(double step, double angle) {
    std::normal_distribution<double> normal;
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      Isometry3d X = poses_[k];
      X.translation() += step * Vector3d(normal(rng_), normal(rng_), normal(rng_)).normalized();
      X.linear() = Eigen::AngleAxisd(angle, Vector3d(normal(rng_), normal(rng_), normal(rng_)).normalized()) *
                   X.linear();
      finder_.set_pose(ids_[k], X);
    }
  }
  contact::ContactFinder& finder() { return finder_; }

 private:
  std::mt19937 rng_;
  contact::ContactFinder finder_;
  std::vector<Isometry3d> poses_;
  std::vector<int> ids_;
};

// Arguments: rocks, step [µm], turn [µrad].
void find(benchmark::State& state) {
  Bed bed(static_cast<int>(state.range(0)));
  const double step = 1e-6 * static_cast<double>(state.range(1)),
               angle = 1e-6 * static_cast<double>(state.range(2));
  double points = 0, computed = 0, manifolds = 0, broad = 0, narrow = 0;
  for (auto _ : state) {
    state.PauseTiming();
    bed.shake(step, angle);
    state.ResumeTiming();
    const auto& found = bed.finder().find();
    manifolds += static_cast<double>(found.size());
    for (const auto& m : found) points += m.count;
    computed += bed.finder().times().computed;
    broad += 1e3 * bed.finder().times().broad;
    narrow += 1e3 * bed.finder().times().narrow;
  }
  const auto average = [](double sum) { return benchmark::Counter(sum, benchmark::Counter::kAvgIterations); };
  state.counters["pairs"] = bed.finder().times().pairs;
  state.counters["computed"] = average(computed);
  state.counters["manifolds"] = average(manifolds);
  state.counters["points"] = average(points);
  state.counters["broad_ms"] = average(broad);
  state.counters["narrow_ms"] = average(narrow);
}
BENCHMARK(find)
    ->ArgNames({"rocks", "um", "urad"})
    ->Args({500, 0, 0})
    ->Args({1000, 0, 0})
    ->Args({500, 20, 20})
    ->Args({1000, 20, 20})
    ->Args({500, 5000, 20000})
    ->Args({1000, 5000, 20000})
    ->Unit(benchmark::kMillisecond);

}  // namespace
