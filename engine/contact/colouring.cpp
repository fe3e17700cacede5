// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstdint>
#include <drawpoint/engine/contact/colouring.hpp>

namespace drawpoint::engine::contact::detail {
namespace {

// Colours the given pairs from `first_colour` on; returns the number of colours used so far.
class Colourer {
 public:
  Colourer(const ContactProblem& problem, std::vector<std::vector<int>>& colours)
      : problem_(problem), colours_(colours), taken_(problem.bodies.size(), 0) {}

  void add(int index) {
    const ContactPair& pair = problem_.pairs[index];
    const bool fixed_a = is_fixed(problem_.bodies[pair.a]), fixed_b = is_fixed(problem_.bodies[pair.b]);
    const std::uint64_t taken = (fixed_a ? 0 : taken_[pair.a]) | (fixed_b ? 0 : taken_[pair.b]);
    const int colour = std::countr_one(taken);
    if (colour == 64) {
      alone_.push_back(index);
      return;
    }
    const std::uint64_t bit = std::uint64_t{1} << colour;
    if (!fixed_a) taken_[pair.a] |= bit;
    if (!fixed_b) taken_[pair.b] |= bit;
    if (base_ + colour >= colours_.size()) colours_.resize(base_ + colour + 1);
    colours_[base_ + colour].push_back(index);
  }

  // What follows gets colours of its own.
  void close() {
    for (const int index : alone_) colours_.push_back({index});
    alone_.clear();
    base_ = colours_.size();
    std::fill(taken_.begin(), taken_.end(), 0);
  }

 private:
  const ContactProblem& problem_;
  std::vector<std::vector<int>>& colours_;
  std::vector<std::uint64_t> taken_;
  std::vector<int> alone_;
  std::size_t base_ = 0;
};

}  // namespace

bool is_fixed(const SolverBody& body) { return body.inverse_mass == 0 && body.inverse_inertia.isZero(0); }

Colouring colour(const ContactProblem& problem) {
  std::vector<std::vector<int>> colours;
  Colourer colourer(problem, colours);
  const auto with_world = [&](const ContactPair& p) {
    return is_fixed(problem.bodies[p.a]) || is_fixed(problem.bodies[p.b]);
  };
  for (const bool world : {false, true}) {
    for (std::size_t k = 0; k < problem.pairs.size(); ++k) {
      const ContactPair& pair = problem.pairs[k];
      if (pair.a >= 0 && pair.b >= 0 && with_world(pair) == world) colourer.add(static_cast<int>(k));
    }
    colourer.close();
  }
  Colouring result;
  for (std::vector<int>& members : colours) {
    std::stable_sort(members.begin(), members.end(),
                     [&](int x, int y) { return problem.pairs[x].count > problem.pairs[y].count; });
    result.starts.push_back(static_cast<int>(result.pairs.size()));
    result.pairs.insert(result.pairs.end(), members.begin(), members.end());
  }
  result.starts.push_back(static_cast<int>(result.pairs.size()));
  return result;
}

}  // namespace drawpoint::engine::contact::detail
