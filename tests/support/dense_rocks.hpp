// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <drawpoint/engine/granular/size_distribution.hpp>
#include <drawpoint/tests/support/rocks.hpp>
#include <map>
#include <vector>

/// A pile of the six rocks with blasted sizes in a box, as recorded motion: for tests and benchmarks of the
/// contact finder that want the poses of a real pile and not its dynamics.
///
/// The box grows with the count so that the depth of the pile is that of 3000 rocks in 7 m x 6 m. The rocks
/// fall from a loose grid and settle; `rest` is what follows. Then the wall at +x is taken away; `slide` is
/// the avalanche, rocks at up to some metres per second. Steps of 10 ms, same arguments, same bits. Cost:
/// about 10 ms per step and 1000 rocks.
namespace drawpoint::support {

struct RockPile {
  using Frame = std::vector<Eigen::Isometry3d>;  ///< a pose per rock
  std::vector<std::shared_ptr<const engine::Shape>> shapes, walls;
  std::vector<Frame> rest, slide;
};

/// Floor first, the wall at +x last.
inline std::vector<std::shared_ptr<const engine::Shape>> pile_walls(double length, double width) {
  using engine::HalfSpace;
  return {shared(HalfSpace{Vector3d::UnitZ(), 0}), shared(HalfSpace{Vector3d::UnitY(), 0}),
          shared(HalfSpace{-Vector3d::UnitY(), -width}), shared(HalfSpace{Vector3d::UnitX(), 0}),
          shared(HalfSpace{-Vector3d::UnitX(), -length})};
}

inline engine::World pile_world(const RockPile& pile, std::size_t walls) {
  engine::WorldOptions options;
  options.step = 0.01;
  engine::World world(options, one_material({.friction = 0.9, .rolling = 0.05}));
  for (std::size_t k = 0; k < walls; ++k) world.add_static(pile.walls[k], Eigen::Isometry3d::Identity(), 0);
  return world;
}

inline RockPile::Frame poses_of(const engine::World& world) {
  RockPile::Frame frame;
  for (const auto& rock : world.rocks()) frame.push_back(rock.pose);
  return frame;
}

inline RockPile record_pile(int count, int settling_steps, int rest_steps, int slide_steps) {
  constexpr double density = 4500, spacing = 0.85;
  RockPile pile;
  const double scale = std::sqrt(count / 3000.0), length = 7 * scale, width = 6 * scale;
  pile.walls = pile_walls(length, width);
  engine::granular::RockSampler sampler(1, density);
  const int along = std::max(1, static_cast<int>(length / spacing)),
            across = std::max(1, static_cast<int>(width / spacing));
  std::map<std::pair<int, int>, engine::RockBody> bodies;  // equal rocks share their shape
  std::vector<engine::RockBody> rocks;
  auto world = pile_world(pile, 5);
  for (int k = 0; k < count; ++k) {
    const auto draw = sampler.next();
    auto& body = bodies[{draw.size, draw.shape}];
    if (!body.shape) body = rock_body(draw.shape, draw.length, density);
    rocks.push_back(body);
    pile.shapes.push_back(body.shape);
    const Vector3d cell(k % along, k / along % across, k / (along * across));
    const Eigen::AngleAxisd turn(0.7 * k, Vector3d(std::sin(k), std::cos(k), 0.5).normalized());
    world.add_rock(body, Eigen::Translation3d(
                             Vector3d(0.5 * length / along, 0.5 * width / across, 0.5) +
                             cell.cwiseProduct(Vector3d(length / along, width / across, 0.5 * spacing))) *
                             turn);
  }
  for (int k = 0; k < settling_steps; ++k) world.step();
  for (int k = 0; k < rest_steps; ++k) {
    world.step();
    pile.rest.push_back(poses_of(world));
  }
  auto open = pile_world(pile, 4);
  for (std::size_t k = 0; k < rocks.size(); ++k) open.add_rock(rocks[k], world.rocks()[k].pose);
  for (int k = 0; k < 60; ++k) open.step();  // until it flows
  for (int k = 0; k < slide_steps; ++k) {
    open.step();
    pile.slide.push_back(poses_of(open));
  }
  return pile;
}

}  // namespace drawpoint::support
