// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/world/material.hpp>
#include <optional>
#include <string>
#include <string_view>

/// What the surfaces of the loading case do to each other: friction, rolling resistance, stiffness.
///
/// A coefficient belongs to the shapes and to the solver that it was found with. Rolling resistance is a
/// stand-in for shape, made for spheres. Convex polyhedra resist rolling by their corners: without any of it our rocks
/// already lie at 37 to 41 degrees, and with the 0.5 to 0.9 of Lindmark (2016), solved to convergence, they lock into a
/// wall that no bucket enters.
namespace drawpoint::engine::loading {

enum class SurfaceKind { rock, terrain, steel, tyre };  ///< rows of the material table
constexpr int surface_kinds = 4;

/// One material per pair of surfaces that can meet.
struct MineMaterials {
  engine::Material rock_rock, rock_terrain, rock_steel, rock_tyre, steel_terrain, tyre_terrain;
};

/// The default. No rolling and no spinning resistance. Friction, pair by pair (docs/measurements/materials.md has the
/// sources and the tests):
///   rock on rock   0.7   calibrated: bulk density, angle of repose and direct shear of blasted ore
///                        (docs/decisions/0019); piles lie at 36 degrees in the mean, where 35 to 42 are quoted
///   rock on floor  0.6   hard rock on hard rock, 0.55 to 0.70 (Barton and Choubey 1977)
///   rock on steel  0.35  rock fill on steel, 0.30 single-sized to 0.40 well graded (NAVFAC DM-7.02, 1986, table 1)
///   steel on floor 0.35  the same: a bucket slides on broken rock
///   rock on tyre   0.7   rubber on hard surfaces, 0.60 to 0.85
///   tyre on floor  0.65  coefficient of traction in a quarry pit (Caterpillar Performance Handbook)
/// The source's 1.0 of steel on floor took 121 to 139 of 300 to 330 kN of thrust. Stiffness 1e8 N/m, what the substeps
/// resolve (material.hpp): a rock that carries 100 kN of the bucket's edge is pressed in by 1 mm. Tyre as below.
MineMaterials calibrated_materials();

/// Tables 8 to 13 of Lindmark (2016): rolling resistance 0.5 between rocks and 0.9 against floor, steel and
/// tyre, friction 1.0 there. Young's moduli are read as stiffness per 0.1 m, not softer than 1e8 N/m; the
/// tyre is a spring of 2 MN/m, what a tyre of this size has, instead of the source's rigid one. The
/// coefficients need the loosely solved steps that they were used with (150 iterations of a step of 1/60 s
/// from a cold start): solved to convergence the bucket pushes the pile like a blade. For comparison, not for
/// answers. Spinning resistance is 0, as the source has none.
MineMaterials lindmark2016_materials();

/// By name: "calibrated" or "lindmark2016". Throws std::invalid_argument with the names there are.
MineMaterials materials_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> material_names = {"calibrated", "lindmark2016"};

/// The same with other coefficients [1], those given, on the four pairs that a rock takes part in.
MineMaterials with_resistance(MineMaterials materials, std::optional<double> rolling,
                              std::optional<double> spinning);

/// The same with the friction of those four pairs times `factor` [1], for what is uncertain in a mine.
MineMaterials with_rock_friction(MineMaterials materials, double factor);

/// The table that a World takes, which checks the coefficients; its rows are the kinds of surface.
engine::MaterialTable material_table(const MineMaterials& materials);

}  // namespace drawpoint::engine::loading
