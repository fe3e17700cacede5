// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <drawpoint/engine/world/kinematic_body.hpp>
#include <drawpoint/tests/support/rocks.hpp>
#include <drawpoint/tests/validation/energy_ledger.hpp>
#include <drawpoint/tests/validation/heaps.hpp>
#include <numeric>

using namespace drawpoint;
using namespace drawpoint::engine;
using validation::record;

namespace {

const validation::Problem silo{
    "silo", validation::Group::granular, "Silo against Janssen",
    "The floor under 225 and 450 rocks of 0.3 m (μ = 0.9) in a square silo of 1.2 m with walls of μ = "
    "0.5 sinks at 2 cm/s; loads are means over 2 s (default settings)."};

constexpr double D = 1.2, size = 0.3, wall_friction = 0.5, g = 9.81;
constexpr int slices = 40;  // of one rock size up the walls

struct Loads {
  double weight, floor, height;                  // [N], [N], [m]
  std::array<double, slices> normal{}, shear{};  // on the walls, upwards, by height [N]
  double momentum_rate;                          // change of vertical momentum over the window / 2 s [N]
  double largest_rise, recoverable;
  double sum(const std::array<double, slices>& a) const { return std::accumulate(a.begin(), a.end(), 0.0); }
};

// Adds a step's forces between rocks and walls, by height.
void add_wall_forces(const World& world, Loads& loads) {
  for (const auto& pair : world.problem().pairs) {
    if (pair.a != 0 && pair.b != 0) continue;  // body 0: the walls
    for (int i = pair.first; i < pair.first + pair.count; ++i) {
      const auto& p = world.problem().points[i];
      const int slice = std::clamp(static_cast<int>(p.position.z() / size), 0, slices - 1);
      const Eigen::Vector3d force = p.impulse / world.options().step;
      loads.normal[slice] += std::abs(force.dot(p.normal));
      loads.shear[slice] += pair.a == 0 ? force.z() : -force.z();
    }
  }
}

double vertical_momentum(const World& world) {
  double sum = 0;
  for (const auto& rock : world.rocks()) sum += rock.body.mass * rock.velocity.z();
  return sum;
}

Loads fill_and_lower(const Material& rough, int rocks, std::uint64_t seed) {
  MaterialTable table(2);  // rocks and floor; walls
  table.set(0, 0, rough);
  table.set(0, 1, {.friction = wall_friction});
  World world({}, table);
  for (const Eigen::Vector3d& inward : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0),
                                        Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)})
    world.add_static(support::shared(HalfSpace{inward, -D / 2}), Eigen::Isometry3d::Identity(), 1);
  KinematicBody floor(support::at(0, 0, -0.25));
  world.attach(&floor);
  world.add_part_shape(0, support::shared(box({D / 2 - 0.005, D / 2 - 0.005, 0.25})),
                       Eigen::Isometry3d::Identity(), 0);
  validation::EnergyLedger ledger(world);
  const auto note = [&] { ledger.note(floor.work()); };
  validation::pour(world, {.rocks = rocks, .size = size, .nx = 4, .ny = 4, .interval = 0.25, .seed = seed},
                   note);
  floor.set_velocity({0, 0, -0.02});
  validation::settle(world, 1.0, note);
  Loads loads{};
  int steps = 0;
  const double momentum = vertical_momentum(world);
  validation::settle(world, 2.0, [&] {
    note();
    add_wall_forces(world, loads);
    loads.floor -= floor.contact_wrench().force.z();
    ++steps;
  });
  for (double& f : loads.normal) f /= steps;
  for (double& f : loads.shear) f /= steps;
  loads.floor /= steps;
  loads.momentum_rate = (vertical_momentum(world) - momentum) / (steps * world.options().step);
  for (const auto& rock : world.rocks()) loads.weight += rock.body.mass * g;
  loads.height = validation::mean_height(world, {-D / 2, D / 2, -D / 2, D / 2}) -
                 floor.part_pose(0).translation().z() - 0.25;
  loads.largest_rise = ledger.largest_rise();
  loads.recoverable = ledger.recoverable();
  return loads;
}

// Janssen (1895): dσ/dz = ρ g − σ / λ with λ = A / (U μ K), so floor load / weight = λ/H (1 − exp(−H/λ)).
double floor_share(double lambda, double height) {
  return lambda / height * (1 - std::exp(-height / lambda));
}

double lambda_of(double share, double height) {
  double low = 1e-3, high = 1e3;
  while (high - low > 1e-9)
    (floor_share(0.5 * (low + high), height) < share ? low : high) = 0.5 * (low + high);
  return low;
}

// K = mean wall pressure over mean vertical stress. The stress at a height is what lies above less what the
// walls carry above, over the section.
double stress_ratio(const Loads& loads) {
  const double per_metre = loads.weight / loads.height;
  double above = 0, carried = 0, stress_area = 0;
  for (int k = slices - 1; k >= 0; --k) {
    const double dz = std::clamp(loads.height - k * size, 0.0, size);
    stress_area += (above + 0.5 * per_metre * dz - carried - 0.5 * loads.shear[k]) / (D * D) * 4 * D * dz;
    above += per_metre * dz;
    carried += loads.shear[k];
  }
  return loads.sum(loads.normal) / stress_area;
}

// Means over the seeds, recorded.
void compare_with_janssen(const Material& rough, const std::vector<std::uint64_t>& seeds) {
  const std::string name = ", " + validation::name_of(rough);
  double carried = 0, share = 0, predicted = 0, from_walls = 0;
  for (std::uint64_t seed : seeds) {
    const Loads low = fill_and_lower(rough, 225, seed), high = fill_and_lower(rough, 450, seed);
    const double n = static_cast<double>(seeds.size());
    carried += (high.floor + high.sum(high.shear) - high.momentum_rate) / high.weight / n;
    share += high.floor / high.weight / n;
    predicted += floor_share(lambda_of(low.floor / low.weight, low.height), high.height) / n;
    const double friction = high.sum(high.shear) / high.sum(high.normal);
    from_walls += floor_share(D / (4 * friction * stress_ratio(high)), high.height) / n;
    validation::record_energy(silo, "450 rocks" + name + ", seed " + std::to_string(seed), high.largest_rise,
                              high.recoverable);
  }
  record(silo,
         {.quantity = "(floor load + wall friction − change of momentum) / weight" + name,
          .expected = 1,
          .source = "balance of impulses",
          .measured = carried,
          .budget = 1e-5,
          .budget_reason =
              "Impulses pass through single precision, 6e-8 each; 200 steps and 16 substeps may add their "
              "roundings up to a hundredfold."});
  const std::string model =
      "A model for a continuum: known no better than one rock in the silo's width, d/D = 1/4 of the load.";
  record(silo, {.quantity = "floor load / weight, predicted from half the fill" + name,
                .expected = predicted,
                .source = "Janssen with λ from the floor load of 225 rocks",
                .measured = share,
                .budget = predicted * size / D,
                .budget_reason = model,
                .headline = true});
  record(silo, {.quantity = "floor load / weight, predicted from the walls" + name,
                .expected = from_walls,
                .source = "Janssen with K and μ measured on the walls",
                .measured = share,
                .budget = from_walls * size / D,
                .budget_reason = model,
                .headline = true});
}

}  // namespace

// Three relations, two silos and two seeds. Statics: floor and walls carry the weight. Saturation: the short
// silo's floor load gives λ, and λ predicts the long silo's floor. Cause: λ = A/(U μ K) with K and the
// mobilised μ = shear / normal measured on the walls of the long silo gives the same floor load. Limits: four
// rocks across; the walls' friction is fully mobilised only below the top two sizes, so the measured ratio
// stands for μ, not the material's.
TEST(Silo, FloorLoadFollowsJanssen) { compare_with_janssen({.friction = 0.9, .rolling = 0.1}, {1, 2}); }

// K and μ are measured in the same silo, so that the relations hold whatever keeps the rocks from rolling.
TEST(Silo, FloorLoadFollowsJanssenByShapeAlone) { compare_with_janssen({.friction = 0.9}, {1}); }
