// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstdint>
#include <drawpoint/engine/contact/sweep_order.hpp>

namespace drawpoint::engine::contact::detail {
namespace {

constexpr int slabs = 256;          // among whose borders those of the zones are chosen
constexpr int pairs_a_zone = 1800;  // at least: a dozen colours of them fill most of their batches
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

// The slab of each body: those of its contacts' centres, counted along the longest side of the points' box.
std::vector<int> slabs_of(const ContactProblem& problem) {
  std::vector<int> result(problem.bodies.size(), 0);
  Eigen::AlignedBox3d box;
  for (const ContactPoint& point : problem.points) box.extend(point.position);
  int axis = 0;
  const double length = box.isEmpty() ? 0 : box.diagonal().maxCoeff(&axis);
  if (length <= 0) return result;
  const auto at = [&](const Eigen::Vector3d& centre) {
    return static_cast<int>(std::clamp(slabs * (centre[axis] - box.min()[axis]) / length, 0.0, slabs - 1.0));
  };
  for (const ContactPair& pair : problem.pairs) {
    if (pair.count == 0) continue;
    const ContactPoint& point = problem.points[pair.first];
    if (pair.a >= 0) result[pair.a] = at(point.position - point.arm_a);
    if (pair.b >= 0) result[pair.b] = at(point.position - point.arm_b);
  }
  return result;
}

// A power of two, so that two, four or eight threads have as many each.
int zones_of(std::size_t pairs) {
  return static_cast<int>(std::bit_floor(std::max<std::size_t>(1, pairs / pairs_a_zone)));
}

// Which zone each body is in. Zones hold about as many sides of pairs each.
class Zones {
 public:
  Zones(const ContactProblem& problem, const std::vector<int>& slab_of)
      : count(zones_of(problem.pairs.size())), slab_of_(slab_of) {
    std::vector<double> sides(slabs, 0);
    for (const ContactPair& pair : problem.pairs)
      for (const int body : {pair.a, pair.b})
        if (body >= 0 && !is_fixed(problem.bodies[body])) ++sides[slab_of[body]];
    double total = 0, passed = 0;
    for (const double n : sides) total += n;
    for (int slab = 0; slab < slabs; ++slab) {
      zone_of_slab_[slab] = std::min(count - 1, static_cast<int>(count * passed / std::max(total, 1.0)));
      passed += sides[slab];
    }
  }

  int of(int body) const { return zone_of_slab_[slab_of_[body]]; }

  int count;

 private:
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

bool is_fixed(const SolverBody& body) { return body.inverse_mass == 0 && body.inverse_inertia.isZero(0); }

SweepOrder sweep_order(const ContactProblem& problem, int most) {
  const std::vector<int> slab_of = slabs_of(problem);
  const Zones zones(problem, slab_of);
  const Parts parts(zones.count);
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
