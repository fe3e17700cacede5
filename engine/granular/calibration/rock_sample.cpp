// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/calibration/rock_sample.hpp>

#include <algorithm>
#include <drawpoint/engine/granular/rock_shapes.hpp>

namespace drawpoint::engine::granular {

SizeDistribution single_size(double length) {
  SizeDistribution sizes;
  sizes.fill({length, 1.0 / static_cast<double>(sizes.size())});
  return sizes;
}

double largest(const SizeDistribution& sizes) {
  double length = 0;
  for (const SizeClass& size : sizes) length = std::max(length, size.length);
  return length;
}

double mean_length(const SizeDistribution& sizes) {
  double length = 0;
  for (const SizeClass& size : sizes) length += size.mass_share * size.length;
  return length;
}

double mean_mass(const RockSample& sample) {
  double unit = 0, cube = 0;
  for (const engine::ConvexPolyhedron& shape : rock_shapes())
    unit += shape.volume() / static_cast<double>(rock_shapes().size());
  const auto shares = number_shares(sample.sizes);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double length = sample.sizes[i].length;
    cube += shares[i] * length * length * length;
  }
  return sample.density * unit * cube;
}

std::string_view to_string(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return "completed";
    case RunStatus::moving:
      return "moving";
    case RunStatus::stopped:
      return "stopped";
  }
  return "unknown";
}

}  // namespace drawpoint::engine::granular
