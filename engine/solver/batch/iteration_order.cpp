// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/batch/iteration_order.h>
#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <drawpoint/engine/base/constants.hpp>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

namespace drawpoint::engine::detail {

namespace {

using constants::slabs;

bool is_fixed(const SolverBody& body) {
  return body.inverse_mass == 0 && body.inverse_inertia.isZero(0) && body.velocity.isZero(0) &&
         body.angular_velocity.isZero(0) && body.external_velocity_change.isZero(0);
}

// Sorts by a key of 0 .. keys-1, stably, in linear time; numbers whose key is negative are left out.
template <class Key>
std::vector<int> sorted(const std::vector<int>& numbers, int keys, const Key& key) {
  std::vector<int> starts(keys + 1, 0);
  for (const int k : numbers)
    if (key(k) >= 0) ++starts[key(k) + 1];
  for (int k = 0; k < keys; ++k) starts[k + 1] += starts[k];
  std::vector<int> result(starts[keys]);
  for (const int k : numbers)
    if (key(k) >= 0) result[starts[key(k)]++] = k;
  return result;
}

std::vector<int> below(std::size_t count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// What the order needs to know of a pair, close together: it is gone through several times.
struct Ends {
  int a, b, points;
  bool in_order() const { return a >= 0 && b >= 0 && points > 0; }  // has points, and none of the machine's
};

std::vector<Ends> ends_of(const ContactProblem& problem) {
  std::vector<Ends> ends;
  ends.reserve(problem.pairs.size());
  for (const ContactPair& pair : problem.pairs) ends.push_back({pair.a, pair.b, pair.count});
  return ends;
}

// Where a body is, as its first pair has it, and of how many pairs it is a moving side.
struct Place {
  bool fixed;
  int sides = 0;
  Eigen::Array3d centre = Eigen::Array3d::Zero();
};

std::vector<Place> places_of(const ContactProblem& problem, const std::vector<Ends>& ends) {
  std::vector<Place> places;
  places.reserve(problem.bodies.size());
  for (const SolverBody& body : problem.bodies) places.push_back({is_fixed(body)});
  const auto visit = [&](int body, const ContactPoint& point, const Eigen::Vector3d& arm) {
    Place& place = places[body];
    if (!place.fixed && place.sides++ == 0) place.centre = point.position - arm;
  };
  for (std::size_t k = 0; k < ends.size(); ++k) {
    if (!ends[k].in_order()) continue;
    const ContactPoint& point = problem.points[problem.pairs[k].first];
    visit(ends[k].a, point, point.arm_a);
    visit(ends[k].b, point, point.arm_b);
  }
  return places;
}

// The slab of each body along the axis of the largest spread. The slabs fill 2.5 standard deviations on
// either side of the mean, those at the ends hold what is beyond: a stray rock does not widen them.
std::vector<int> slabs_of(const std::vector<Place>& places) {
  std::vector<int> result(places.size(), 0);
  Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();
  double sides = 0;
  for (const Place& place : places)
    sum += place.sides * place.centre, squares += place.sides * place.centre.square(), sides += place.sides;
  if (sides == 0) return result;
  const Eigen::Array3d mean = sum / sides;
  int axis = 0;
  const double variance = (squares / sides - mean.square()).maxCoeff(&axis);
  if (!(variance > 0)) return result;
  const double width = 5 * std::sqrt(variance) / slabs, low = mean[axis] - 0.5 * slabs * width;
  for (std::size_t body = 0; body < places.size(); ++body) {
    const double slab = (places[body].centre[axis] - low) / width;
    result[body] = static_cast<int>(std::min(std::max(0.0, slab), slabs - 1.0));  // NaN: 0
  }
  return result;
}

// Which subdomain each body is in. Subdomains hold about as many sides of pairs each; their number is a power
// of two, so that two, four or eight threads have as many each.
class Subdomains {
 public:
  Subdomains(std::size_t pairs, const std::vector<Place>& places, const std::vector<int>& slab_of, int least)
      : slab_of_(slab_of) {
    count_ = static_cast<int>(std::bit_floor(std::max<std::size_t>(1, pairs / least)));
    std::vector<double> sides(slabs, 0);
    for (std::size_t body = 0; body < places.size(); ++body) sides[slab_of[body]] += places[body].sides;
    double total = 0, passed = 0;
    for (const double n : sides) total += n;
    for (int slab = 0; slab < slabs; ++slab) {
      subdomain_of_slab_[slab] =
          std::min(count_ - 1, static_cast<int>(count_ * passed / std::max(total, 1.0)));
      passed += sides[slab];
    }
  }

  int count() const { return count_; }
  int of(int body) const { return subdomain_of_slab_[slab_of_[body]]; }

 private:
  int count_;
  const std::vector<int>& slab_of_;
  int subdomain_of_slab_[slabs];
};

// The tasks in their order: beyond neighbours, borders after even subdomains, after odd ones, subdomains.
class Tasks {
 public:
  explicit Tasks(int subdomains) : subdomains_(subdomains) {}

  int of(int subdomain, int other) const {
    const int low = std::min(subdomain, other), apart = std::abs(subdomain - other);
    if (apart == 0) return subdomains_ + low;
    if (apart > 1) return 0;
    return low % 2 == 0 ? 1 + low / 2 : 1 + subdomains_ / 2 + low / 2;
  }
  int count() const { return 2 * subdomains_; }
  std::vector<int> last_of_stages() const { return {0, subdomains_ / 2, subdomains_ - 1, count() - 1}; }

 private:
  int subdomains_;
};

// Assigns pairs to batches: each to the first open batch that none of its moving bodies is in, or to a new
// one. Full batches are closed.
class BatchAssigner {
 public:
  BatchAssigner(const std::vector<Ends>& ends, const std::vector<Place>& places, int most)
      : ends_(ends), places_(places), most_(most), open_in_(places.size(), 0) {}

  std::vector<int> sizes;  // of the batches, in the order in which they were opened

  // Returns the batch.
  int assign(int index) {
    const Ends& pair = ends_[index];
    const std::uint64_t room = open_ & ~(batches_of(pair.a) | batches_of(pair.b));
    if (room == 0 && ~open_ == 0) return put(open_batch());  // alone
    const int slot = room != 0 ? std::countr_zero(room) : std::countr_one(open_);
    if (room == 0) batch_in_[slot] = open_batch(), open_ |= bit(slot);
    const int batch = put(batch_in_[slot]);
    members_[slot].push_back(index);
    open_in_[pair.a] |= bit(slot);
    open_in_[pair.b] |= bit(slot);
    if (static_cast<int>(members_[slot].size()) == most_) close(slot);
    return batch;
  }

  void close_all() {
    for (int slot = 0; slot < slots; ++slot) close(slot);
  }

 private:
  static constexpr int slots = 64;  // for open batches
  static std::uint64_t bit(int slot) { return std::uint64_t{1} << slot; }
  std::uint64_t batches_of(int body) const { return places_[body].fixed ? 0 : open_in_[body]; }

  int open_batch() {
    sizes.push_back(0);
    return static_cast<int>(sizes.size()) - 1;
  }

  int put(int batch) {
    ++sizes[batch];
    assert(sizes[batch] <= most_ && "a batch holds no more pairs than lanes");
    return batch;
  }

  void close(int slot) {
    for (const int index : members_[slot]) {
      open_in_[ends_[index].a] &= ~bit(slot);
      open_in_[ends_[index].b] &= ~bit(slot);
    }
    members_[slot].clear();
    open_ &= ~bit(slot);
  }

  const std::vector<Ends>& ends_;
  const std::vector<Place>& places_;
  int most_;
  std::vector<std::uint64_t> open_in_;  // of each body: the slots whose batches it is in
  std::uint64_t open_ = 0;              // the slots that hold a batch
  std::vector<int> members_[slots];
  int batch_in_[slots] = {};
};

// Twice the task of each pair, and one for pairs with the world; -1 for those that are not in the order.
std::vector<int> groups_of(const std::vector<Ends>& ends, const std::vector<Place>& places,
                           const Subdomains& subdomains, const Tasks& tasks) {
  std::vector<int> result(ends.size(), -1);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const auto& [a, b, points] = ends[k];
    if (!ends[k].in_order()) continue;
    const bool fixed_a = places[a].fixed, fixed_b = places[b].fixed;
    const int task = tasks.of(subdomains.of(fixed_a ? b : a), subdomains.of(fixed_b ? a : b));
    result[k] = 2 * task + (fixed_a || fixed_b);
  }
  return result;
}

// The pairs in the order in which they are assigned: group after group, in each by falling number of points.
std::vector<int> queue_of(const std::vector<Ends>& ends, const std::vector<int>& group_of, int groups) {
  int most = 0;
  for (const Ends& pair : ends) most = std::max(most, pair.points);
  return sorted(below(ends.size()), groups * (most + 1), [&](int k) {
    return group_of[k] < 0 ? -1 : group_of[k] * (most + 1) + most - ends[k].points;
  });
}

// The pairs of a task, batch after batch, and how many each batch has.
struct AssignedTask {
  std::vector<int> pairs, sizes;
};

AssignedTask assign_task(std::span<const int> queue, const std::vector<int>& group_of,
                         BatchAssigner assigner) {
  std::vector<int> batch_of(queue.size());
  for (std::size_t k = 0; k < queue.size(); ++k) {
    if (k > 0 && group_of[queue[k]] != group_of[queue[k - 1]]) assigner.close_all();
    batch_of[k] = assigner.assign(queue[k]);
  }
  AssignedTask task;
  task.sizes = std::move(assigner.sizes);
  task.pairs =
      sorted(below(queue.size()), static_cast<int>(task.sizes.size()), [&](int k) { return batch_of[k]; });
  for (int& place : task.pairs) place = queue[place];
  return task;
}

// Tasks share nothing: threads assign them side by side.
std::vector<AssignedTask> assign_tasks(const std::vector<int>& queue, const std::vector<int>& group_of,
                                       const BatchAssigner& assigner, int tasks, const ThreadPool& pool) {
  const auto first_of = [&](int task) {
    return std::partition_point(queue.begin(), queue.end(), [&](int k) { return group_of[k] < 2 * task; });
  };
  std::vector<AssignedTask> assigned(static_cast<std::size_t>(tasks));
  pool.run(tasks, pool.threads(), [&](int task) {
    const std::span<const int> own(first_of(task), first_of(task + 1));
    if (!own.empty()) assigned[task] = assign_task(own, group_of, assigner);
  });
  return assigned;
}

}  // namespace

IterationOrder iteration_order(const ContactProblem& problem, int most, int least_per_subdomain,
                               const ThreadPool& pool) {
  const std::vector<Ends> ends = ends_of(problem);
  const std::vector<Place> places = places_of(problem, ends);
  const std::vector<int> slab_of = slabs_of(places);
  const Subdomains subdomains(std::count_if(ends.begin(), ends.end(), std::mem_fn(&Ends::in_order)), places,
                              slab_of, least_per_subdomain);
  const Tasks tasks(subdomains.count());
  const std::vector<int> group_of = groups_of(ends, places, subdomains, tasks);
  const std::vector<int> queue = queue_of(ends, group_of, 2 * tasks.count());

  IterationOrder order;
  order.bodies = sorted(below(places.size()), slabs, [&](int body) { return slab_of[body]; });
  for (const Place& place : places) order.fixed.push_back(place.fixed);
  order.pairs.reserve(queue.size());
  order.batches = order.tasks = order.stages = {0};
  int task = 0;
  const std::vector<int> last_of_stages = tasks.last_of_stages();
  auto last = last_of_stages.begin();
  for (const AssignedTask& assigned :
       assign_tasks(queue, group_of, {ends, places, most}, tasks.count(), pool)) {
    order.pairs.insert(order.pairs.end(), assigned.pairs.begin(), assigned.pairs.end());
    for (const int size : assigned.sizes) order.batches.push_back(order.batches.back() + size);
    if (!assigned.sizes.empty()) order.tasks.push_back(static_cast<int>(order.batches.size()) - 1);
    for (; last != last_of_stages.end() && *last == task; ++last)
      order.stages.push_back(static_cast<int>(order.tasks.size()) - 1);
    ++task;
  }
  assert(last == last_of_stages.end() && "every stage has ended");
  assert(order.pairs.size() == queue.size() && "each pair is in one batch");
  assert(order.batches.back() == static_cast<int>(order.pairs.size()) &&
         order.tasks.back() == static_cast<int>(order.batches.size()) - 1 &&
         order.stages.back() == static_cast<int>(order.tasks.size()) - 1 &&
         "batches, tasks and stages end where their contents do");
  return order;
}

}  // namespace drawpoint::engine::detail
