// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <drawpoint/engine/contact/sweep_order.hpp>

namespace drawpoint::engine::contact::detail {

bool is_fixed(const SolverBody& body) { return body.inverse_mass == 0 && body.inverse_inertia.isZero(0); }

namespace {

constexpr int slabs = 256;  // among whose borders those of the zones are chosen
constexpr int colours_a_group = 64;

// Sorts by a key of 0 .. keys-1, stably, in linear time; numbers whose key is negative are left out.
template <class Key>
std::vector<int> sorted(int count, int keys, const Key& key) {
  std::vector<int> starts(keys + 1, 0);
  for (int k = 0; k < count; ++k)
    if (key(k) >= 0) ++starts[key(k) + 1];
  for (int k = 0; k < keys; ++k) starts[k + 1] += starts[k];
  std::vector<int> result(starts[keys]);
  for (int k = 0; k < count; ++k)
    if (key(k) >= 0) result[starts[key(k)]++] = k;
  return result;
}

bool in_order(const ContactPair& pair) { return pair.a >= 0 && pair.b >= 0 && pair.count > 0; }

// Calls visit(body, centre) for each moving side of each pair.
template <class Visit>
void each_side(const ContactProblem& problem, const Visit& visit) {
  for (const ContactPair& pair : problem.pairs) {
    if (!in_order(pair)) continue;
    const ContactPoint& point = problem.points[pair.first];
    if (!is_fixed(problem.bodies[pair.a])) visit(pair.a, point.position - point.arm_a);
    if (!is_fixed(problem.bodies[pair.b])) visit(pair.b, point.position - point.arm_b);
  }
}

// The slab of each body along the axis of the largest spread. The slabs fill 2.5 standard deviations on
// either side of the mean, those at the ends hold what is beyond: a stray rock does not widen them.
std::vector<int> slabs_of(const ContactProblem& problem) {
  std::vector<int> result(problem.bodies.size(), 0);
  Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();
  double sides = 0;
  each_side(problem, [&](int, const Eigen::Vector3d& centre) {
    sum += centre.array(), squares += centre.array().square(), ++sides;
  });
  if (sides == 0) return result;
  const Eigen::Array3d mean = sum / sides;
  int axis = 0;
  const double variance = (squares / sides - mean.square()).maxCoeff(&axis);
  if (!(variance > 0)) return result;
  const double width = 5 * std::sqrt(variance) / slabs, low = mean[axis] - 0.5 * slabs * width;
  each_side(problem, [&](int body, const Eigen::Vector3d& centre) {
    const double slab = (centre[axis] - low) / width;
    result[body] = static_cast<int>(std::min(std::max(0.0, slab), slabs - 1.0));  // NaN: 0
  });
  return result;
}

// Which zone each body is in. Zones hold about as many sides of pairs each; their number is a power of two,
// so that two, four or eight threads have as many each.
class Zones {
 public:
  Zones(const ContactProblem& problem, const std::vector<int>& slab_of, int least) : slab_of_(slab_of) {
    const std::size_t pairs = std::count_if(problem.pairs.begin(), problem.pairs.end(), in_order);
    count_ = static_cast<int>(std::bit_floor(std::max<std::size_t>(1, pairs / least)));
    std::vector<double> sides(slabs, 0);
    each_side(problem, [&](int body, const Eigen::Vector3d&) { ++sides[slab_of[body]]; });
    double total = 0, passed = 0;
    for (const double n : sides) total += n;
    for (int slab = 0; slab < slabs; ++slab) {
      zone_of_slab_[slab] = std::min(count_ - 1, static_cast<int>(count_ * passed / std::max(total, 1.0)));
      passed += sides[slab];
    }
  }

  int count() const { return count_; }
  int of(int body) const { return zone_of_slab_[slab_of_[body]]; }

 private:
  int count_;
  const std::vector<int>& slab_of_;
  int zone_of_slab_[slabs];
};

// The parts in their order: beyond neighbours, borders after even zones, after odd ones, zones.
class Parts {
 public:
  explicit Parts(int zones) : zones_(zones) {}

  int of(int zone, int other) const {
    const int low = std::min(zone, other), apart = std::abs(zone - other);
    if (apart == 0) return zones_ + low;
    if (apart > 1) return 0;
    return low % 2 == 0 ? 1 + low / 2 : 1 + zones_ / 2 + low / 2;
  }
  int count() const { return 2 * zones_; }
  std::vector<int> last_of_stages() const { return {0, zones_ / 2, zones_ - 1, count() - 1}; }

 private:
  int zones_;
};

// Colours the pairs of one group after another: a part's, first those without and then those with the world.
class Colourer {
 public:
  Colourer(const ContactProblem& problem, const std::vector<int>& group_of, int groups)
      : colour_of(problem.pairs.size(), -1), problem_(problem), taken_(problem.bodies.size(), 0) {
    const int pairs = static_cast<int>(problem.pairs.size());
    const std::vector<int> order = sorted(pairs, groups, [&](int k) { return group_of[k]; });
    for (auto group = order.begin(); group != order.end();) {
      const auto end =
          std::find_if(group, order.end(), [&](int k) { return group_of[k] != group_of[*group]; });
      for (auto pair = group; pair != end; ++pair) add(*pair);
      for (const int pair : alone_) colour_of[pair] = count++;
      alone_.clear();
      for (auto pair = group; pair != end; ++pair)
        taken_[problem.pairs[*pair].a] = taken_[problem.pairs[*pair].b] = 0;
      base_ = count;
      group = end;
    }
  }

  std::vector<int> colour_of;  // of each pair, numbered on from group to group; -1 for the machine's
  int count = 0;

 private:
  void add(int index) {
    const ContactPair& pair = problem_.pairs[index];
    const bool fixed_a = is_fixed(problem_.bodies[pair.a]), fixed_b = is_fixed(problem_.bodies[pair.b]);
    const std::uint64_t taken = (fixed_a ? 0 : taken_[pair.a]) | (fixed_b ? 0 : taken_[pair.b]);
    const int colour = std::countr_one(taken);
    if (colour == colours_a_group) {
      alone_.push_back(index);
      return;
    }
    const std::uint64_t bit = std::uint64_t{1} << colour;
    taken_[pair.a] |= bit;
    taken_[pair.b] |= bit;
    colour_of[index] = base_ + colour;
    count = std::max(count, base_ + colour + 1);
  }

  const ContactProblem& problem_;
  std::vector<std::uint64_t> taken_;
  std::vector<int> alone_;
  int base_ = 0;
};

// Twice the part of each pair, and one for pairs with the world; -1 for the machine's.
std::vector<int> groups_of(const ContactProblem& problem, const Zones& zones, const Parts& parts) {
  std::vector<int> result(problem.pairs.size(), -1);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const ContactPair& pair = problem.pairs[k];
    if (pair.a < 0 || pair.b < 0) continue;
    const bool fixed_a = is_fixed(problem.bodies[pair.a]), fixed_b = is_fixed(problem.bodies[pair.b]);
    const int part = parts.of(zones.of(fixed_a ? pair.b : pair.a), zones.of(fixed_b ? pair.a : pair.b));
    result[k] = 2 * part + (fixed_a || fixed_b);
  }
  return result;
}

}  // namespace

SweepOrder sweep_order(const ContactProblem& problem, int most, int least_a_zone) {
  const std::vector<int> slab_of = slabs_of(problem);
  const Zones zones(problem, slab_of, least_a_zone);
  const Parts parts(zones.count());
  const std::vector<int> group_of = groups_of(problem, zones, parts);
  const Colourer colourer(problem, group_of, 2 * parts.count());
  int points = 0;
  for (const ContactPair& pair : problem.pairs) points = std::max(points, pair.count);
  const std::vector<int> pairs =
      sorted(static_cast<int>(problem.pairs.size()), colourer.count * (points + 1), [&](int k) {
        const int colour = colourer.colour_of[k];
        return colour < 0 ? -1 : colour * (points + 1) + points - problem.pairs[k].count;
      });

  SweepOrder order{.bodies = sorted(static_cast<int>(problem.bodies.size()), slabs,
                                    [&](int body) { return slab_of[body]; }),
                   .pairs = pairs,
                   .batches = {0},
                   .parts = {0},
                   .stages = {0}};
  const auto colour_of = [&](int at) { return colourer.colour_of[pairs[at]]; };
  const auto part_of = [&](int at) { return group_of[pairs[at]] / 2; };
  const int size = static_cast<int>(pairs.size());
  int at = 0;
  for (const int last_part : parts.last_of_stages()) {
    while (at < size && part_of(at) <= last_part) {
      const int part = part_of(at);
      for (int begin = at; at < size && part_of(at) == part; begin = at) {
        while (at < size && at - begin < most && colour_of(at) == colour_of(begin)) ++at;
        order.batches.push_back(at);
      }
      order.parts.push_back(static_cast<int>(order.batches.size()) - 1);
    }
    order.stages.push_back(static_cast<int>(order.parts.size()) - 1);
  }
  return order;
}

}  // namespace drawpoint::engine::contact::detail
