// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/size_distribution.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::granular {
namespace {

// splitmix64 (Steele, Lea, Flood 2014), used as a function of a counter.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

double uniform(std::uint64_t seed, std::uint64_t counter) {
  return static_cast<double>(mix(mix(seed) + counter) >> 11) * 0x1p-53;
}

double cubed(double x) { return x * x * x; }

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("granular::RockSampler: " + what);
}

void check(double density, const SizeDistribution& sizes) {
  if (!(density > 0) || !std::isfinite(density))
    refuse("density is " + std::to_string(density) +
           " kg/m3; give a positive number, rock has 2000 to 5000 kg/m3");
  double sum = 0;
  for (const SizeClass& size : sizes) {
    if (!(size.length > 0) || !(size.mass_share > 0))
      refuse("a size has length " + std::to_string(size.length) + " m and mass share " +
             std::to_string(size.mass_share) + "; give positive values");
    sum += size.mass_share;
  }
  if (!(std::abs(sum - 1) < 1e-9))
    refuse("the mass shares sum to " + std::to_string(sum) + "; make them sum to 1");
}

double mean_unit_volume() {
  double sum = 0;
  for (const engine::ConvexPolyhedron& shape : rock_shapes()) sum += shape.volume();
  return sum / static_cast<double>(rock_shapes().size());
}

}  // namespace

SizeDistribution sizes_named(const std::string& name) {
  if (name == size_names[0]) return blasted_ore;
  if (name == size_names[1]) return blasted_ore_with_fines;
  if (name == size_names[2]) return blasted_ore_with_small_fines;
  if (name == size_names[3]) return well_broken_ore;
  throw std::invalid_argument("granular::sizes_named: \"" + name +
                              "\"; choose mine, mine_with_fines, mine_with_small_fines or well_broken");
}

double rocks_per_mass(const SizeDistribution& sizes) {
  double sum = 0;
  for (const SizeClass& size : sizes) sum += size.mass_share / cubed(size.length);
  return sum;
}

std::array<double, 4> number_shares(const SizeDistribution& sizes) {
  std::array<double, 4> shares{};
  const double all = rocks_per_mass(sizes);
  for (std::size_t i = 0; i < sizes.size(); ++i)
    shares[i] = sizes[i].mass_share / cubed(sizes[i].length) / all;
  return shares;
}

RockSampler::RockSampler(std::uint64_t seed, double density, const SizeDistribution& sizes)
    : seed_(seed), density_(density), sizes_(sizes) {
  check(density, sizes);
  const std::array<double, 4> shares = number_shares(sizes);
  const double unit_mass = density * mean_unit_volume();
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    mean_mass_[i] = unit_mass * cubed(sizes[i].length);
    mean_of_all_ += shares[i] * mean_mass_[i];
  }
}

int RockSampler::draw_size(double u) const {
  double total = mean_of_all_;
  for (double mass : state_.mass) total += mass;
  std::array<double, 4> weights{};
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    sum += weights[i] = std::max(0.0, sizes_[i].mass_share * total - state_.mass[i]) / mean_mass_[i];
  double rest = u * sum;
  int last = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0) continue;
    last = static_cast<int>(i);
    if (rest < weights[i]) break;
    rest -= weights[i];
  }
  return last;
}

RockDraw RockSampler::next() {
  const std::uint64_t counter = 2 * state_.drawn;
  const int size = draw_size(uniform(seed_, counter));
  const std::size_t shape =
      static_cast<std::size_t>(uniform(seed_, counter + 1) * static_cast<double>(rock_shapes().size()));
  const double length = sizes_[static_cast<std::size_t>(size)].length;
  const double mass = density_ * rock_shapes()[shape].volume() * cubed(length);
  ++state_.drawn;
  state_.mass[static_cast<std::size_t>(size)] += mass;
  return {size, static_cast<int>(shape), length, mass};
}

}  // namespace drawpoint::engine::granular
