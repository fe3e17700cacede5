// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstdint>
#include <drawpoint/engine/contact/colouring.hpp>

namespace drawpoint::engine::contact::detail {
namespace {

constexpr int slabs = 128;  // that the scene is cut into

// The colour of each pair, -1 for the machine's, and the number of colours.
class Colourer {
 public:
  explicit Colourer(const ContactProblem& problem)
      : colour_of(problem.pairs.size(), -1), problem_(problem), taken_(problem.bodies.size(), 0) {
    for (const SolverBody& body : problem.bodies) fixed_.push_back(is_fixed(body));
    for (const bool world : {false, true}) add_all(world);
  }

  std::vector<int> colour_of;
  int count = 0;

 private:
  void add_all(bool world) {
    for (std::size_t k = 0; k < problem_.pairs.size(); ++k) {
      const ContactPair& pair = problem_.pairs[k];
      if (pair.a >= 0 && pair.b >= 0 && (fixed_[pair.a] || fixed_[pair.b]) == world)
        add(static_cast<int>(k), pair);
    }
    for (const int pair : alone_) colour_of[pair] = count++;
    alone_.clear();
    base_ = count;
    std::fill(taken_.begin(), taken_.end(), 0);
  }

  void add(int index, const ContactPair& pair) {
    const std::uint64_t taken = (fixed_[pair.a] ? 0 : taken_[pair.a]) | (fixed_[pair.b] ? 0 : taken_[pair.b]);
    const int colour = std::countr_one(taken);
    if (colour == 64) {
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
  std::vector<char> fixed_;
  std::vector<int> alone_;
  int base_ = 0;
};

// The slab of each pair, counted along the longest side of the points' box.
std::vector<int> slabs_of(const ContactProblem& problem) {
  Eigen::AlignedBox3d box;
  for (const ContactPoint& point : problem.points) box.extend(point.position);
  std::vector<int> result(problem.pairs.size(), 0);
  if (box.isEmpty() || box.diagonal().maxCoeff() <= 0) return result;
  int axis = 0;
  const double length = box.diagonal().maxCoeff(&axis);
  for (std::size_t k = 0; k < result.size(); ++k) {
    if (problem.pairs[k].count == 0) continue;
    const double at = problem.points[problem.pairs[k].first].position[axis] - box.min()[axis];
    result[k] = std::min(slabs - 1, static_cast<int>(slabs * at / length));
  }
  return result;
}

// Sorts by a key of 0 .. keys-1, stably, in linear time; numbers whose key is negative are left out.
template <class Key>
std::vector<int> sorted(const std::vector<int>& numbers, int keys, const Key& key) {
  std::vector<int> starts(keys + 1, 0);
  for (const int number : numbers)
    if (key(number) >= 0) ++starts[key(number) + 1];
  for (int k = 0; k < keys; ++k) starts[k + 1] += starts[k];
  std::vector<int> result(starts[keys]);
  for (const int number : numbers)
    if (key(number) >= 0) result[starts[key(number)]++] = number;
  return result;
}

std::vector<int> first_numbers(int count) {
  std::vector<int> result(count);
  for (int k = 0; k < count; ++k) result[k] = k;
  return result;
}

// Cuts the pairs of a colour into batches and puts these in order of place.
void cut(std::vector<int>::const_iterator begin, std::vector<int>::const_iterator end, int most,
         const std::vector<int>& slab_of, Colouring& result) {
  const int size = static_cast<int>(end - begin), count = (size + most - 1) / most;
  const std::vector<int> batches =
      sorted(first_numbers(count), slabs, [&](int batch) { return slab_of[begin[batch * most]]; });
  for (const int batch : batches) {
    const int last = std::min(size, (batch + 1) * most);
    result.pairs.insert(result.pairs.end(), begin + batch * most, begin + last);
    result.batches.push_back(static_cast<int>(result.pairs.size()));
  }
  result.colours.push_back(static_cast<int>(result.batches.size()) - 1);
}

}  // namespace

bool is_fixed(const SolverBody& body) { return body.inverse_mass == 0 && body.inverse_inertia.isZero(0); }

Colouring colour(const ContactProblem& problem, int most) {
  const Colourer colourer(problem);
  const std::vector<int> slab_of = slabs_of(problem);
  int points = 0;
  for (const ContactPair& pair : problem.pairs) points = std::max(points, pair.count);
  const auto key = [&](int k) {
    return colourer.colour_of[k] * (points + 1) + (points - problem.pairs[k].count);
  };
  const std::vector<int> by_place =
      sorted(first_numbers(static_cast<int>(problem.pairs.size())), slabs, [&](int k) { return slab_of[k]; });
  const std::vector<int> pairs = sorted(by_place, colourer.count * (points + 1), key);

  Colouring result{{}, {0}, {0}};
  for (auto colour = pairs.begin(); colour != pairs.end();) {
    const auto end = std::find_if(
        colour, pairs.end(), [&](int k) { return colourer.colour_of[k] != colourer.colour_of[*colour]; });
    cut(colour, end, most, slab_of, result);
    colour = end;
  }
  return result;
}

}  // namespace drawpoint::engine::contact::detail
