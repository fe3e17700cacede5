// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <drawpoint/engine/contact/contact_frame.hpp>
#include <drawpoint/engine/contact/contact_law.hpp>
#include <drawpoint/engine/contact/pair_batches.hpp>

namespace drawpoint::engine::contact::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void put(const Vector3d& v, Lanes (&lanes)[3], int lane) {
  for (int k = 0; k < 3; ++k) lanes[k][lane] = static_cast<float>(v[k]);
}
Vector3d get(const Lanes (&lanes)[3], int lane) { return {lanes[0][lane], lanes[1][lane], lanes[2][lane]}; }

}  // namespace

PairBatches::PairBatches(const ContactProblem& problem, const Colouring& colouring, int substeps) {
  const std::size_t batches = colouring.pairs.size() / batch_lanes + colouring.starts.size();
  pairs_.reserve(batches);
  points_.reserve(4 * batches);
  members_.reserve(batches * batch_lanes);
  bodies.reserve(problem.bodies.size() + batches * batch_lanes);
  responses_.reserve(bodies.capacity());
  for (const SolverBody& body : problem.bodies) add_row(body);
  for (std::size_t c = 0; c + 1 < colouring.starts.size(); ++c) {
    const int first = count();
    for (int k = colouring.starts[c]; k < colouring.starts[c + 1]; k += batch_lanes)
      add_batch(problem, colouring.pairs.data() + k, std::min(batch_lanes, colouring.starts[c + 1] - k),
                substeps);
    if (count() > first) colours_.push_back({first, count()});
  }
  end = begin = bodies;
}

void PairBatches::add_row(const SolverBody& body) {
  BodyRow row;
  BodyResponse response;
  for (int k = 0; k < 3; ++k) {
    row.velocity[k] = static_cast<float>(body.velocity[k]);
    row.angular_velocity[k] = static_cast<float>(body.angular_velocity[k]);
  }
  const Matrix3d& I = body.inverse_inertia;
  const double inertia[4] = {I(0, 0), I(0, 1), I(0, 2), I(1, 1)},
               rest[3] = {I(1, 2), I(2, 2), body.inverse_mass};
  std::copy_n(inertia, 4, response.inertia);
  std::copy_n(rest, 3, response.rest);
  bodies.push_back(row);
  responses_.push_back(response);
}

// Fixed bodies get a row a lane.
int PairBatches::row_of(const ContactProblem& problem, int body) {
  if (!is_fixed(problem.bodies[body])) return body;
  add_row(problem.bodies[body]);
  return static_cast<int>(bodies.size()) - 1;
}

void PairBatches::add_batch(const ContactProblem& problem, const int* members, int count, int substeps) {
  PairBatch batch{};
  batch.first = static_cast<int>(points_.size());
  batch.points = problem.pairs[members[0]].count;  // the most: sorted so
  batch.pairs = count;
  PointBatch empty{};
  std::fill(std::begin(empty.gap), std::end(empty.gap), no_gap);
  points_.resize(points_.size() + batch.points, empty);
  for (int lane = 0; lane < count; ++lane) add_pair(problem, batch, lane, members[lane], substeps);
  for (int lane = count; lane < batch_lanes; ++lane) {
    bodies.resize(bodies.size() + 2);
    responses_.resize(bodies.size());
    batch.a[lane] = static_cast<int>(bodies.size()) - 2;
    batch.b[lane] = static_cast<int>(bodies.size()) - 1;
    members_.push_back(-1);
  }
  pairs_.push_back(batch);
}

void PairBatches::add_pair(const ContactProblem& problem, PairBatch& batch, int lane, int index,
                           int substeps) {
  const ContactPair& pair = problem.pairs[index];
  const ContactPoint& first = problem.points[pair.first];
  const Matrix3d frame = contact_frame(first.normal);
  members_.push_back(index);
  batch.a[lane] = row_of(problem, pair.a);
  batch.b[lane] = row_of(problem, pair.b);
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
    const SpookTerms law =
        spook(point.stiffness, std::max(point.damping_time, 2 * problem.step), problem.step / substeps);
    put(point.arm_a, p.arm, lane);
    p.gap[lane] = static_cast<float>(point.gap);
    p.upsilon[lane] = static_cast<float>(law.upsilon);
    p.sigma[lane] = static_cast<float>(law.sigma);
    put(start_impulse(point, frame, substeps), p.impulse, lane);
  }
}

double PairBatches::change() const {
  double sum = 0;
  for (const PairBatch& batch : pairs_)
    for (const float change : batch.change) sum += change;
  return sum;
}

double PairBatches::normal_load() const {
  double sum = 0;
  for (const PointBatch& p : points_)
    for (const float impulse : p.impulse[0]) sum += impulse;
  return sum;
}

void PairBatches::store(ContactProblem& problem, int substeps) const {
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (members_[k] < 0) continue;
    ContactPair& pair = problem.pairs[members_[k]];
    const PairBatch& batch = pairs_[k / batch_lanes];
    const int lane = static_cast<int>(k % batch_lanes);
    const Matrix3d to_world = contact_frame(problem.points[pair.first].normal).transpose();
    const Vector3d moment = get(batch.moment, lane);
    pair.start = substeps * (to_world * moment);
    pair.impulse = to_world * (get(batch.moment_total, lane) + moment);
    for (int i = 0; i < pair.count; ++i) {
      const PointBatch& p = points_[batch.first + i];
      const Vector3d impulse = get(p.impulse, lane);
      problem.points[pair.first + i].start = substeps * (to_world * impulse);
      problem.points[pair.first + i].impulse = to_world * (get(p.total, lane) + impulse);
    }
  }
}

}  // namespace drawpoint::engine::contact::detail
