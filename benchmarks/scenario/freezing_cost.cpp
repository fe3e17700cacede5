// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "freezing_cost.hpp"

#include <ctime>
#include <drawpoint/tests/support/pile_world.hpp>
#include <stdexcept>

namespace drawpoint::benchmarks {
namespace {

using namespace engine;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double apart = 20, phase_time = 1;  // [m], [s]

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// The floor is common; walls are boxes, since half-spaces would cut the other box off.
class TwoBoxes {
 public:
  TwoBoxes(const CostScene& scene, const WorldOptions& options)
      : near_(support::rock_pile(scene.moving, scene.seed, scene.material)),
        blade_(Isometry3d(Eigen::Translation3d(near_.blade.start))),
        world_(options, support::pile_materials(near_.material)) {
    add_static(HalfSpace{Vector3d::UnitZ(), 0}, Vector3d::Zero());
    for (const double x : {0.0, apart}) {
      const Vector3d along(0.5, 4, 10), across(4, 0.5, 10);
      for (const double side : {-1.0, 1.0}) {
        add_static(box(along), Vector3d(x + side * (0.5 * support::RockPile::length + along.x()), 0, 10));
        add_static(box(across), Vector3d(x, side * (0.5 * support::RockPile::width + across.y()), 10));
      }
    }
    world_.attach(&blade_);
    world_.add_part_shape(0, std::make_shared<const Shape>(box(near_.blade.half)), Isometry3d::Identity(), 0);
    if (scene.bed > 0) add(support::rock_pile(scene.bed, scene.seed + 1), apart);
  }
  TwoBoxes(const TwoBoxes&) = delete;

  void let_go() { add(near_, 0); }
  void dig() { blade_.set_velocity({near_.blade.speed, 0, 0}); }
  World& world() { return world_; }
  int frozen() const {
    int count = 0;
    for (std::size_t k = 0; k < world_.rocks().size(); ++k) count += world_.frozen(static_cast<int>(k));
    return count;
  }

 private:
  void add_static(Shape shape, const Vector3d& place) {
    world_.add_static(std::make_shared<const Shape>(std::move(shape)),
                      Isometry3d(Eigen::Translation3d(place)), 0);
  }
  void add(const support::RockPile& pile, double x) {
    std::vector<RockBody> bodies;
    for (const support::PileHull& hull : pile.hulls)
      bodies.push_back({std::make_shared<const Shape>(hull.hull), hull.mass, hull.inertia, 0});
    for (const support::PileRock& rock : pile.rocks) {
      Isometry3d pose = rock.start;
      pose.translation().x() += x;
      world_.add_rock(bodies[static_cast<std::size_t>(rock.hull)], pose);
    }
  }

  support::RockPile near_;
  KinematicBody blade_;
  World world_;
};

void settle_bed(TwoBoxes& scene) {
  const int rocks = static_cast<int>(scene.world().rocks().size());
  while (scene.frozen() < rocks) {
    if (scene.world().time() > 20)
      throw std::runtime_error("freezing_cost: " + std::to_string(rocks - scene.frozen()) + " of " +
                               std::to_string(rocks) +
                               " rocks of the bed still move after 20 s; take another seed");
    scene.world().step();
  }
}

// Mean processor time of a step.
double timed(World& world, int steps, double& awake, int& again) {
  const double start = processor_ms();
  for (int k = 0; k < steps; ++k) {
    const StepReport report = world.step();
    awake += static_cast<double>(report.awake) / steps;
    again += report.solves - 1;
  }
  return (processor_ms() - start) / steps;
}

}  // namespace

FreezingCost freezing_cost(const CostScene& scene, WorldOptions options) {
  options.freezing.on = scene.freeze;
  TwoBoxes boxes(scene, options);
  FreezingCost cost;
  if (scene.bed > 0) settle_bed(boxes);
  cost.frozen = boxes.frozen();
  const int steps = static_cast<int>(std::lround(phase_time / options.step));
  double none = 0;
  cost.still_ms = timed(boxes.world(), steps, none, cost.solved_again);
  boxes.let_go();
  cost.fall_ms = timed(boxes.world(), steps, cost.fall_awake, cost.solved_again);
  boxes.dig();
  cost.dig_ms = timed(boxes.world(), steps, cost.dig_awake, cost.solved_again);
  return cost;
}

}  // namespace drawpoint::benchmarks
