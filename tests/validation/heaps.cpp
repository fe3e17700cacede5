// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/tests/support/rocks.hpp>
#include <drawpoint/tests/validation/heaps.hpp>
#include <numeric>

namespace drawpoint::validation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using engine::Rock;

bool free_place(const engine::World& world, const Vector3d& place, double size) {
  return std::none_of(world.rocks().begin(), world.rocks().end(), [&](const Rock& rock) {
    return rock.present && (rock.pose.translation() - place).norm() < size;
  });
}

}  // namespace

std::string name_of(const engine::Material& material) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "μ = %g, μ_r = %g", material.friction, material.rolling);
  return text.data();
}

double highest_rock(const engine::World& world, double slower_than) {
  double top = 0;
  for (const Rock& rock : world.rocks())
    if (rock.present && rock.velocity.norm() < slower_than) top = std::max(top, rock.pose.translation().z());
  return top;
}

int let_go_layer(engine::World& world, const Pour& options, int most) {
  engine::CounterRandom turns(options.seed, 4 * world.rocks().size());
  const double z = std::max(options.lowest, highest_rock(world, 0.9 * options.speed) + options.clearance);
  int born = 0;
  for (int i = 0; i < options.nx; ++i)
    for (int j = 0; j < options.ny && born < most; ++j) {
      const Vector2d offset(i - 0.5 * (options.nx - 1), j - 0.5 * (options.ny - 1));
      Eigen::Isometry3d pose(turns.rotation());
      pose.translation() << options.centre + options.size * offset, z;
      if (!free_place(world, pose.translation(), options.size)) continue;
      ++born;
      world.add_rock(
          support::rock_body(static_cast<int>(world.rocks().size() % 6), options.size, options.density), pose,
          Vector3d(0, 0, -options.speed));
    }
  return born;
}

Estimate estimate(const std::vector<double>& sample) {
  const double n = static_cast<double>(sample.size());
  const double mean = std::accumulate(sample.begin(), sample.end(), 0.0) / n;
  double squares = 0;
  for (double x : sample) squares += (x - mean) * (x - mean);
  return {mean, std::sqrt(squares / (n - 1) / n)};
}

}  // namespace drawpoint::validation
