// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/drift.hpp>
#include <drawpoint/engine/loading/lhd_driver.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <memory>

/// The machine alone on a floor, put there but not yet on its tyres.
namespace drawpoint::support {

struct Yard {
  explicit Yard(const engine::loading::LhdOptions& options = {}, const engine::WorldOptions& solved = {},
                const engine::loading::MineMaterials& materials = engine::loading::calibrated_materials())
      : lhd(engine::loading::sandvik_lh621(options)),
        machine(lhd.spec),
        world(solved, engine::loading::material_table(materials)),
        driver(lhd, machine) {
    world.add_static(std::make_shared<const engine::Shape>(engine::HalfSpace{Eigen::Vector3d::UnitZ(), 0}),
                     Eigen::Isometry3d::Identity(), static_cast<int>(engine::loading::SurfaceKind::terrain));
    driver.place(0, 0);
    engine::loading::add_machine(world, lhd, machine);
  }

  void stand(double seconds) {
    for (double t = 0; t < seconds; t += world.options().step) world.step();
  }

  engine::loading::Lhd lhd;
  engine::machine::Machine machine;
  engine::World world;
  engine::loading::LhdDriver driver;
};

}  // namespace drawpoint::support
