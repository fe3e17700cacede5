// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/loading/mine_materials.hpp>
#include <drawpoint/engine/world/world.hpp>

using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

constexpr int rock = static_cast<int>(SurfaceKind::rock), terrain = static_cast<int>(SurfaceKind::terrain),
              steel = static_cast<int>(SurfaceKind::steel), tyre = static_cast<int>(SurfaceKind::tyre);

}  // namespace

// The tables of the source, pair by pair: rolling resistance, friction.
TEST(MineMaterials, Lindmark2016HasTheTablesOfTheSource) {
  const MaterialTable table = material_table(materials_named("lindmark2016"));
  struct Row {
    int a, b;
    double rolling, friction;
  };
  for (const Row& r :
       {Row{rock, steel, 0.9, 1.0}, Row{terrain, steel, 0.9, 1.0}, Row{rock, tyre, 0.9, 1.0},
        Row{rock, terrain, 0.9, 1.0}, Row{tyre, terrain, 0.0, 0.8}, Row{rock, rock, 0.5, 0.9}}) {
    EXPECT_EQ(table.of(r.a, r.b).rolling, r.rolling) << r.a << " on " << r.b;
    EXPECT_EQ(table.of(r.b, r.a).friction, r.friction) << r.a << " on " << r.b;
    EXPECT_EQ(table.of(r.a, r.b).spinning, 0) << "the source has no spinning resistance";
    EXPECT_EQ(table.of(r.a, r.b).restitution, 0);
  }
}

TEST(MineMaterials, ResistanceIsOfTheRocksAlone) {
  const MineMaterials before = calibrated_materials(), after = with_resistance(before, 0.3, 0.2);
  for (const auto pair : {&MineMaterials::rock_rock, &MineMaterials::rock_terrain, &MineMaterials::rock_steel,
                          &MineMaterials::rock_tyre}) {
    EXPECT_EQ((before.*pair).rolling, 0);
    EXPECT_EQ((before.*pair).spinning, 0);
    EXPECT_EQ((after.*pair).rolling, 0.3);
    EXPECT_EQ((after.*pair).spinning, 0.2);
    EXPECT_EQ((after.*pair).friction, (before.*pair).friction);
  }
  EXPECT_EQ(after.tyre_terrain.rolling, before.tyre_terrain.rolling);
  EXPECT_EQ(after.steel_terrain.rolling, before.steel_terrain.rolling);
  const MineMaterials source = with_resistance(lindmark2016_materials(), {}, 0.2);
  EXPECT_EQ(source.rock_rock.rolling, 0.5);
  EXPECT_EQ(source.rock_steel.rolling, 0.9);
  EXPECT_EQ(source.rock_steel.spinning, 0.2);
}

TEST(MineMaterials, AnUnknownNameIsRefusedWithTheNamesThereAre) {
  for (const std::string_view name : material_names) EXPECT_NO_THROW(materials_named(std::string(name)));
  try {
    materials_named("gravel");
    FAIL() << "gravel was found";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(
        error.what(),
        "loading::materials_named: there are no materials \"gravel\"; choose calibrated or lindmark2016");
  }
}

// A coefficient that makes no sense is refused by the world that would use it.
TEST(MineMaterials, AWorldChecksTheCoefficients) {
  MineMaterials materials = calibrated_materials();
  materials.rock_steel.friction = -1;
  EXPECT_THROW(World({}, material_table(materials)), std::invalid_argument);
}
