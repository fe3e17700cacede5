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

// Where a body is, as its first pair has it, and of how many pairs it is a moving side.
struct Place {
  bool fixed;
  int sides = 0;
  Eigen::Array3d centre = Eigen::Array3d::Zero();
};

std::vector<Place> places_of(const ContactProblem& problem) {
  std::vector<Place> places;
  places.reserve(problem.bodies.size());
  for (const SolverBody& body : problem.bodies) places.push_back({is_fixed(body)});
  const auto visit = [&](int body, const ContactPoint& point, const Eigen::Vector3d& arm) {
    Place& place = places[body];
    if (!place.fixed && place.sides++ == 0) place.centre = point.position - arm;
  };
  for (const ContactPair& pair : problem.pairs) {
    if (!in_order(pair)) continue;
    const ContactPoint& point = problem.points[pair.first];
    visit(pair.a, point, point.arm_a);
    visit(pair.b, point, point.arm_b);
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

// Which zone each body is in. Zones hold about as many sides of pairs each; their number is a power of two,
// so that two, four or eight threads have as many each.
class Zones {
 public:
  Zones(std::size_t pairs, const std::vector<Place>& places, const std::vector<int>& slab_of, int least)
      : slab_of_(slab_of) {
    count_ = static_cast<int>(std::bit_floor(std::max<std::size_t>(1, pairs / least)));
    std::vector<double> sides(slabs, 0);
    for (std::size_t body = 0; body < places.size(); ++body) sides[slab_of[body]] += places[body].sides;
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
  Colourer(const ContactProblem& problem, const std::vector<Place>& places, const std::vector<int>& group_of,
           int groups)
      : colour_of(problem.pairs.size(), -1), problem_(problem), places_(places), taken_(places.size(), 0) {
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
    const std::uint64_t taken =
        (places_[pair.a].fixed ? 0 : taken_[pair.a]) | (places_[pair.b].fixed ? 0 : taken_[pair.b]);
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
  const std::vector<Place>& places_;
  std::vector<std::uint64_t> taken_;
  std::vector<int> alone_;
  int base_ = 0;
};

// Twice the part of each pair, and one for pairs with the world; -1 for the machine's.
std::vector<int> groups_of(const ContactProblem& problem, const std::vector<Place>& places,
                           const Zones& zones, const Parts& parts) {
  std::vector<int> result(problem.pairs.size(), -1);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const ContactPair& pair = problem.pairs[k];
    if (pair.a < 0 || pair.b < 0) continue;
    const bool fixed_a = places[pair.a].fixed, fixed_b = places[pair.b].fixed;
    const int part = parts.of(zones.of(fixed_a ? pair.b : pair.a), zones.of(fixed_b ? pair.a : pair.b));
    result[k] = 2 * part + (fixed_a || fixed_b);
  }
  return result;
}

// Colour after colour; within one by falling number of points.
std::vector<int> by_colour(const ContactProblem& problem, const Colourer& colourer) {
  int points = 0;
  for (const ContactPair& pair : problem.pairs) points = std::max(points, pair.count);
  return sorted(static_cast<int>(problem.pairs.size()), colourer.count * (points + 1), [&](int k) {
    const int colour = colourer.colour_of[k];
    return colour < 0 ? -1 : colour * (points + 1) + points - problem.pairs[k].count;
  });
}

// Cuts the pairs of an order into batches of one colour and at most `most` pairs, these into parts and
// stages.
template <class Colour, class Part>
void cut(SweepOrder& order, int most, const std::vector<int>& last_of_stages, const Colour& colour_of,
         const Part& part_of) {
  const int size = static_cast<int>(order.pairs.size());
  int at = 0;
  for (const int last_part : last_of_stages) {
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
}

}  // namespace

SweepOrder sweep_order(const ContactProblem& problem, int most, int least_a_zone) {
  const std::vector<Place> places = places_of(problem);
  const std::vector<int> slab_of = slabs_of(places);
  const Zones zones(std::count_if(problem.pairs.begin(), problem.pairs.end(), in_order), places, slab_of,
                    least_a_zone);
  const Parts parts(zones.count());
  const std::vector<int> group_of = groups_of(problem, places, zones, parts);
  const Colourer colourer(problem, places, group_of, 2 * parts.count());
  SweepOrder order{
      .bodies = sorted(static_cast<int>(places.size()), slabs, [&](int body) { return slab_of[body]; }),
      .pairs = by_colour(problem, colourer),
      .batches = {0},
      .parts = {0},
      .stages = {0}};
  cut(
      order, most, parts.last_of_stages(), [&](int at) { return colourer.colour_of[order.pairs[at]]; },
      [&](int at) { return group_of[order.pairs[at]] / 2; });
  return order;
}

}  // namespace drawpoint::engine::contact::detail
