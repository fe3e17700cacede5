// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <drawpoint/engine/loading/mine_materials.hpp>
#include <stdexcept>

namespace drawpoint::engine::loading {
namespace {

// Young's moduli of the source's tables times 0.1 m, but not softer than 1e8 N/m.
constexpr double rock_stiffness = 1e9, soft_stiffness = 1e8;  // rock on rock; on floor, steel and tyre [N/m]

// A tyre's damping ratio is about 0.1: τ = 2 ζ √(m/k) with a quarter of the machine on each.
engine::Material tyre_on_floor() {
  constexpr double stiffness = 2e6, quarter = 14e3;
  return {.friction = 0.8, .stiffness = stiffness, .damping_time = 0.2 * std::sqrt(quarter / stiffness)};
}

std::array<engine::Material*, 4> pairs_of_rock(MineMaterials& m) {
  return {&m.rock_rock, &m.rock_terrain, &m.rock_steel, &m.rock_tyre};
}

}  // namespace

MineMaterials lindmark2016_materials() {
  const engine::Material on_others{.friction = 1.0, .rolling = 0.9, .stiffness = soft_stiffness};
  return {.rock_rock = {.friction = 0.9, .rolling = 0.5, .stiffness = rock_stiffness},
          .rock_terrain = on_others,
          .rock_steel = on_others,
          .rock_tyre = on_others,
          .steel_terrain = on_others,
          .tyre_terrain = tyre_on_floor()};
}

MineMaterials calibrated_materials() {
  MineMaterials m = with_resistance(lindmark2016_materials(), 0, 0);
  m.rock_rock.stiffness = soft_stiffness;
  m.rock_rock.friction = 0.7;
  m.rock_terrain.friction = 0.6;
  m.rock_steel.friction = 0.35;
  m.rock_tyre.friction = 0.7;
  m.steel_terrain.friction = 0.35;
  m.steel_terrain.rolling = 0;
  m.tyre_terrain.friction = 0.65;
  return m;
}

MineMaterials materials_named(const std::string& name) {
  if (name == "calibrated") return calibrated_materials();
  if (name == "lindmark2016") return lindmark2016_materials();
  throw std::invalid_argument("loading::materials_named: there are no materials \"" + name +
                              "\"; choose calibrated or lindmark2016");
}

MineMaterials with_resistance(MineMaterials m, std::optional<double> rolling,
                              std::optional<double> spinning) {
  for (engine::Material* pair : pairs_of_rock(m)) {
    pair->rolling = rolling.value_or(pair->rolling);
    pair->spinning = spinning.value_or(pair->spinning);
  }
  return m;
}

MineMaterials with_rock_friction(MineMaterials m, double factor) {
  for (engine::Material* pair : pairs_of_rock(m)) pair->friction *= factor;
  return m;
}

engine::MaterialTable material_table(const MineMaterials& m) {
  constexpr int rock = static_cast<int>(SurfaceKind::rock), terrain = static_cast<int>(SurfaceKind::terrain),
                steel = static_cast<int>(SurfaceKind::steel), tyre = static_cast<int>(SurfaceKind::tyre);
  engine::MaterialTable table(surface_kinds);
  table.set(rock, rock, m.rock_rock);
  table.set(rock, terrain, m.rock_terrain);
  table.set(rock, steel, m.rock_steel);
  table.set(rock, tyre, m.rock_tyre);
  table.set(terrain, steel, m.steel_terrain);
  table.set(terrain, tyre, m.tyre_terrain);
  return table;
}

}  // namespace drawpoint::engine::loading
