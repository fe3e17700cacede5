// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/solver/batch/iteration_order.h>
#include <algorithm>
#include <cstring>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/solver/solver.hpp>
#include <random>
#include <set>

using namespace drawpoint::engine;
using detail::IterationOrder;
using Eigen::Vector3d;

namespace {

bool is_fixed(const SolverBody& body) { return body.inverse_mass == 0 && body.inverse_inertia.isZero(0); }

constexpr int batch = 16;
constexpr int lattice[3] = {64, 10, 10};

int body_at(int x, int y, int z) { return 1 + x + lattice[0] * (y + lattice[1] * z); }

class Beam {
 public:
  Beam() {
    problem.step = 0.01;
    problem.bodies.emplace_back();  // the fixed world
    for (int k = 0; k < lattice[0] * lattice[1] * lattice[2]; ++k) add_body();
    for (int z = 0; z < lattice[2]; ++z)
      for (int y = 0; y < lattice[1]; ++y)
        for (int x = 0; x < lattice[0]; ++x) link(x, y, z);
    add_body();  // in no pair
  }

  void add_pair(int a, int b, const Vector3d& place_a, const Vector3d& place_b) {
    ContactPair pair;
    pair.a = a, pair.b = b;
    pair.first = static_cast<int>(problem.points.size()),
    pair.count = 1 + static_cast<int>(problem.pairs.size() % 3);
    pair.rolling_arm = problem.pairs.size() % 2 == 0 ? 0.01 : 0;
    const Vector3d normal = (place_b - place_a).normalized();
    for (int k = 0; k < pair.count; ++k) {
      ContactPoint point;
      point.position = 0.5 * (place_a + place_b) + 0.1 * Vector3d(uniform(), uniform(), uniform());
      point.arm_a = point.position - place_a, point.arm_b = point.position - place_b;
      point.normal = normal;
      point.gap = 1e-4 * uniform(), point.stiffness = 1e7, point.friction = 0.5;
      problem.points.push_back(point);
    }
    problem.pairs.push_back(pair);
  }

  ContactProblem problem;

 private:
  double uniform() { return 2e-6 * static_cast<double>(random_() % 1000001) - 1; }

  void add_body() {
    SolverBody body;
    body.velocity = 0.1 * Vector3d(uniform(), uniform(), uniform());
    body.external_velocity_change = {0, 0, -0.0981};
    body.inverse_mass = 1e-3, body.inverse_inertia = 0.025 * Eigen::Matrix3d::Identity();
    problem.bodies.push_back(body);
  }

  // With the next one along each axis, and the lowest ones with the world.
  void link(int x, int y, int z) {
    const Vector3d here(x, y, z);
    if (z == 0) add_pair(0, body_at(x, y, 0), here - Vector3d::UnitZ(), here);
    if (x + 1 < lattice[0]) add_pair(body_at(x, y, z), body_at(x + 1, y, z), here, here + Vector3d::UnitX());
    if (y + 1 < lattice[1]) add_pair(body_at(x, y, z), body_at(x, y + 1, z), here, here + Vector3d::UnitY());
    if (z + 1 < lattice[2]) add_pair(body_at(x, y, z), body_at(x, y, z + 1), here, here + Vector3d::UnitZ());
  }

  std::mt19937_64 random_{7};
};

std::vector<int> moving_bodies(const ContactProblem& problem, const IterationOrder& order, int first,
                               int last) {
  std::vector<int> bodies;
  for (int k = first; k < last; ++k)
    for (const int body : {problem.pairs[order.pairs[k]].a, problem.pairs[order.pairs[k]].b})
      if (!is_fixed(problem.bodies[body])) bodies.push_back(body);
  return bodies;
}

void check_batch(const ContactProblem& problem, const IterationOrder& order, int first, int last) {
  ASSERT_TRUE(first < last && last <= first + batch);
  const std::vector<int> bodies = moving_bodies(problem, order, first, last);
  EXPECT_EQ(std::set<int>(bodies.begin(), bodies.end()).size(), bodies.size()) << "batch at pair " << first;
  for (int i = first + 1; i < last; ++i)
    EXPECT_GE(problem.pairs[order.pairs[i - 1]].count, problem.pairs[order.pairs[i]].count);
}

// What is solved at the same time must not share a moving body: the pairs of a batch, the tasks of a stage.
void check(const ContactProblem& problem, const IterationOrder& order) {
  for (std::size_t k = 0; k + 1 < order.batches.size(); ++k)
    check_batch(problem, order, order.batches[k], order.batches[k + 1]);
  for (std::size_t stage = 0; stage + 1 < order.stages.size(); ++stage) {
    std::set<int> taken;
    for (int task = order.stages[stage]; task < order.stages[stage + 1]; ++task) {
      const std::vector<int> all = moving_bodies(problem, order, order.batches[order.tasks[task]],
                                                 order.batches[order.tasks[task + 1]]);
      for (const int body : std::set<int>(all.begin(), all.end()))
        EXPECT_TRUE(taken.insert(body).second) << "body " << body << " is in two tasks of stage " << stage;
    }
  }
}

bool is_permutation(std::vector<int> numbers, int count) {
  std::sort(numbers.begin(), numbers.end());
  for (int k = 0; k < count; ++k)
    if (numbers[k] != k) return false;
  return static_cast<int>(numbers.size()) == count;
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

}  // namespace

TEST(IterationOrder, PartsAndBatchesShareNoMovingBody) {
  Beam beam;
  beam.add_pair(body_at(0, 0, 0), body_at(63, 9, 9), Vector3d(0, 0, 0), Vector3d(63, 9, 9));
  const int ordinary = static_cast<int>(beam.problem.pairs.size());
  beam.add_pair(machine_part(0), body_at(5, 5, 9), Vector3d(5, 5, 10), Vector3d(5, 5, 9));
  const ContactProblem& problem = beam.problem;
  for (const int least : {100, 900, 1800, 100000}) {  // subdomains thinner than a body, sixteen, eight, one
    const IterationOrder order = detail::iteration_order(problem, batch, least);
    check(problem, order);
    EXPECT_TRUE(is_permutation(order.pairs, ordinary));
    EXPECT_TRUE(is_permutation(order.bodies, static_cast<int>(problem.bodies.size())));
  }
  const IterationOrder eight = detail::iteration_order(problem, batch, 1800);
  EXPECT_EQ(eight.tasks.size() - 1, 1u + 7u + 8u);  // beyond neighbours, borders, subdomains
}

TEST(IterationOrder, NumbersThatAreNoneStayInBounds) {
  Beam beam;
  beam.problem.points[7].position.setConstant(std::nan(""));
  check(beam.problem, detail::iteration_order(beam.problem, batch));
}

// Sixteen subdomains on 1, 2, 3 and 8 threads, without and with iterations added while the beam is not
// solved.
TEST(IterationOrder, ThreadsChangeNoBit) {
  for (const int iteration_budget : {0, 100000}) {
    ContactProblem alone = Beam().problem;
    const SolverOptions options{.substeps = 4, .iteration_budget = iteration_budget};
    const SolverReport report = solve(alone, options);
    EXPECT_GT(report.complementarity, 0);
    for (const int threads : {2, 3, 8}) {
      ContactProblem shared = Beam().problem;
      const auto pool = std::make_shared<const ThreadPool>(threads);
      EXPECT_EQ(solve(shared, options, pool).complementarity, report.complementarity);
      for (std::size_t k = 0; k < alone.bodies.size(); ++k)
        ASSERT_TRUE(same_bits(alone.bodies[k].velocity, shared.bodies[k].velocity) &&
                    same_bits(alone.bodies[k].rotation_vector, shared.bodies[k].rotation_vector))
            << "body " << k << ", " << threads << " threads";
      for (std::size_t k = 0; k < alone.points.size(); ++k)
        ASSERT_TRUE(same_bits(alone.points[k].impulse, shared.points[k].impulse)) << "point " << k;
    }
  }
}
