// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/base/prefetch.h>
#include <drawpoint/engine/solver/batch/pair_batches.h>
#include <drawpoint/engine/solver/contact_frame.h>
#include <drawpoint/engine/solver/contact_law_scalar.h>
#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void put(const Vector3d& v, Lanes (&lanes)[3], int lane) {
  for (int k = 0; k < 3; ++k) lanes[k][lane] = static_cast<float>(v[k]);
}
Vector3d get(const Lanes (&lanes)[3], int lane) { return {lanes[0][lane], lanes[1][lane], lanes[2][lane]}; }

// Sorts pairs, given by their index, by falling number of points.
struct FallingPoints {
  const ContactProblem& problem;
  bool operator()(int k, int j) const { return problem.pairs[k].count > problem.pairs[j].count; }
};

[[maybe_unused]] bool no_row_twice(const PairBatch& batch) {
  std::array<std::int32_t, 2 * batch_lanes> rows;
  std::copy_n(batch.b, batch_lanes, std::copy_n(batch.a, batch_lanes, rows.begin()));
  std::sort(rows.begin(), rows.end());
  return std::adjacent_find(rows.begin(), rows.end()) == rows.end();
}

template <class T>
void grow(std::vector<T>& buffer, std::size_t size) {
  if (buffer.size() < size) buffer.resize(size);
}

}  // namespace

void PairBatches::fill(const ContactProblem& problem, IterationOrder order, int substeps,
                       const ThreadPool& pool) {
  order_ = std::move(order);
  plan(problem);
  fill_bodies(problem, pool);
  pool.blocks(count(), batches_per_block, [&](int first, int last) {
    for (int batch = first; batch < last; ++batch) fill_batch(problem, batch, substeps);
  });
  begin = bodies;
  corrections.assign(bodies.size(), BodyRow());
}

int PairBatches::own_rows(const ContactProblem& problem, const int* members, int pairs) const {
  int rows = 2 * (batch_lanes - pairs);
  for (int k = 0; k < pairs; ++k) {
    const ContactPair& pair = problem.pairs[members[k]];
    rows += order_.fixed[pair.a] + order_.fixed[pair.b];
  }
  return rows;
}

void PairBatches::plan(const ContactProblem& problem) {
  plans_.clear();
  rows_ = static_cast<int>(problem.bodies.size());
  point_batches_ = 0;
  for (std::size_t k = 0; k + 1 < order_.batches.size(); ++k) {
    const int* members = order_.pairs.data() + order_.batches[k];
    const int pairs = order_.batches[k + 1] - order_.batches[k];
    assert(pairs <= batch_lanes && "a lane for each pair of a batch");
    assert(std::is_sorted(members, members + pairs, FallingPoints{problem}) && "most points first");
    const int points = problem.pairs[members[0]].count;
    plans_.push_back({members, pairs, points, point_batches_, rows_});
    point_batches_ += points;
    rows_ += own_rows(problem, members, pairs);
  }
  grow(pairs_, plans_.size());
  sums_.assign(plans_.size(), BatchSums());
  grow(points_, static_cast<std::size_t>(point_batches_));
}

void PairBatches::fill_bodies(const ContactProblem& problem, const ThreadPool& pool) {
  bodies.assign(static_cast<std::size_t>(rows_), BodyRow());
  responses_.assign(static_cast<std::size_t>(rows_), BodyResponse());
  row_of.resize(problem.bodies.size());
  pool.blocks(static_cast<int>(problem.bodies.size()), bodies_per_block, [&](int first, int last) {
    for (int row = first; row < last; ++row) {
      row_of[order_.bodies[row]] = row;
      fill_row(row, problem.bodies[order_.bodies[row]]);
    }
  });
}

void PairBatches::fill_row(int row, const SolverBody& body) {
  for (int k = 0; k < 3; ++k) {
    bodies[row].velocity[k] = static_cast<float>(body.velocity[k]);
    bodies[row].angular_velocity[k] = static_cast<float>(body.angular_velocity[k]);
  }
  const Matrix3d& I = body.inverse_inertia;
  const double inertia[4] = {I(0, 0), I(0, 1), I(0, 2), I(1, 1)};
  const double rest[3] = {I(1, 2), I(2, 2), body.inverse_mass};
  std::copy_n(inertia, 4, responses_[row].inertia);
  std::copy_n(rest, 3, responses_[row].rest);
}

// The pair in this lane of the batch after the next, and the points of the one in the next: pairs of a batch
// lie far apart in a problem. Storing takes 0.4 of the time.
[[gnu::always_inline]] inline void PairBatches::prefetch_ahead(const ContactProblem& problem, int index,
                                                               int lane) const {
  if (index + 2 < count() && lane < plans_[index + 2].pairs)
    prefetch(&problem.pairs[plans_[index + 2].members[lane]], sizeof(ContactPair));
  if (index + 1 >= count() || lane >= plans_[index + 1].pairs) return;
  const ContactPair& next = problem.pairs[plans_[index + 1].members[lane]];
  prefetch(&problem.points[next.first], sizeof(ContactPoint) * static_cast<std::size_t>(next.count));
}

void PairBatches::fill_batch(const ContactProblem& problem, int index, int substeps) {
  const Plan& plan = plans_[index];
  PairBatch& batch = pairs_[index];
  batch = PairBatch{};
  batch.first = plan.first_point;
  batch.points = plan.points;
  for (int k = 0; k < plan.points; ++k) {
    PointBatch& p = points_[plan.first_point + k];
    p = PointBatch{};
    std::fill(std::begin(p.gap), std::end(p.gap), no_gap);
  }
  int own_row = plan.first_row;
  const auto place = [&](int body) {
    if (!order_.fixed[body]) return row_of[body];
    fill_row(own_row, problem.bodies[body]);
    return own_row++;
  };
  for (int lane = 0; lane < plan.pairs; ++lane) {
    prefetch_ahead(problem, index, lane);
    const ContactPair& pair = problem.pairs[plan.members[lane]];
    batch.a[lane] = place(pair.a);
    batch.b[lane] = place(pair.b);
    fill_lane(problem, batch, lane, pair, substeps);
  }
  for (int lane = plan.pairs; lane < batch_lanes; ++lane) {
    batch.a[lane] = own_row++;
    batch.b[lane] = own_row++;
  }
  assert(own_row == plan.first_row + own_rows(problem, plan.members, plan.pairs) && "own rows as planned");
  assert(no_row_twice(batch) && "lanes that run side by side never write the same row");
}

void PairBatches::fill_lane(const ContactProblem& problem, PairBatch& batch, int lane,
                            const ContactPair& pair, int substeps) {
  const ContactPoint& first = problem.points[pair.first];
  const Matrix3d frame = contact_frame(first.normal);
  put(first.normal, batch.normal, lane);
  put(frame.row(1), batch.tangent, lane);
  put(first.arm_b - first.arm_a, batch.offset, lane);
  batch.friction[lane] = static_cast<float>(first.friction);
  batch.rolling_arm[lane] = static_cast<float>(pair.rolling_arm);
  batch.spinning_arm[lane] = static_cast<float>(pair.spinning_arm);
  batch.resists |= pair.rolling_arm > 0 || pair.spinning_arm > 0;
  put(frame * pair.start / substeps, batch.moment, lane);
  for (int k = 0; k < pair.count; ++k) {
    const ContactPoint& point = problem.points[pair.first + k];
    PointBatch& p = points_[batch.first + k];
    const SpookTerms terms = law::spook_terms(point, problem.step, substeps);
    put(point.arm_a, p.arm, lane);
    p.gap[lane] = static_cast<float>(point.gap);
    p.upsilon[lane] = static_cast<float>(terms.upsilon);
    p.sigma[lane] = static_cast<float>(terms.sigma);
    put(start_impulse(point, frame, first.friction, substeps), p.impulse, lane);
  }
}

double PairBatches::change() const {
  assert(sums_.size() == plans_.size() && "sums for each batch of this solve");
  double sum = 0;
  for (const BatchSums& batch : sums_) sum += batch.change;
  return sum;
}

double PairBatches::normal_load() const {
  double sum = 0;
  for (const BatchSums& batch : sums_) sum += batch.normal_load;
  return sum;
}

ResidualSums PairBatches::residual_sums() const {
  ResidualSums sum;
  for (int batch = 0; batch < count(); ++batch)
    for (int lane = 0; lane < batch_lanes; ++lane) {
      sum.normal += pairs_[batch].normal_miss[lane];
      sum.tangent += pairs_[batch].tangent_miss[lane];
      sum.load += pairs_[batch].load[lane];
    }
  return sum;
}

void PairBatches::store(ContactProblem& problem, int substeps, const ThreadPool& pool) const {
  pool.blocks(count(), batches_per_block, [&](int first, int last) {
    for (int batch = first; batch < last; ++batch) {
      for (int lane = 0; lane < plans_[batch].pairs; ++lane) {
        prefetch_ahead(problem, batch, lane);
        store_lane(problem, pairs_[batch], lane, problem.pairs[plans_[batch].members[lane]], substeps);
      }
    }
  });
}

void PairBatches::store_lane(ContactProblem& problem, const PairBatch& batch, int lane, ContactPair& pair,
                             int substeps) const {
  assert(pair.count <= batch.points && "a point batch for each point of the pair");
  const Matrix3d to_world = contact_frame(problem.points[pair.first].normal).transpose();
  const Vector3d moment = get(batch.moment, lane);
  pair.start = substeps * (to_world * moment);
  pair.impulse = to_world * (get(batch.moment_total, lane) + moment);
  for (int i = 0; i < pair.count; ++i) {
    const PointBatch& p = points_[batch.first + i];
    ContactPoint& point = problem.points[pair.first + i];
    const Vector3d impulse = get(p.impulse, lane);
    point.start = substeps * (to_world * impulse);
    const double load = law::kept_load<double>(impulse[0], p.initial_impulse[lane], p.inverse_nn[lane]);
    point.warm_start_fraction = law::warm_start_fraction(impulse[0], load);
    point.impulse = to_world * (get(p.total, lane) + impulse);
  }
}

}  // namespace drawpoint::engine::detail
