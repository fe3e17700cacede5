// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <drawpoint/engine/loading/drift.hpp>
#include <drawpoint/engine/loading/lhd_driver.hpp>

/// One step of the loader alone: what Simbody and the super-body cost, and with the tyres' contacts.
using namespace drawpoint::engine;

namespace {

void machine_linearise(benchmark::State& state) {
  const loading::Lhd lhd = loading::sandvik_lh621();
  machine::Machine machine(lhd.spec);
  for (auto _ : state) benchmark::DoNotOptimize(machine.linearise(0.005, {0, 0, -9.81}).velocity);
}

void machine_on_its_tyres(benchmark::State& state) {
  const loading::Lhd lhd = loading::sandvik_lh621();
  machine::Machine machine(lhd.spec);
  World world({}, loading::material_table(loading::calibrated_materials()));
  loading::LhdDriver driver(lhd, machine);
  driver.place(0, 0);
  world.attach(&machine);
  world.add_static(std::make_shared<const Shape>(HalfSpace{Eigen::Vector3d::UnitZ(), 0}),
                   Eigen::Isometry3d::Identity(), static_cast<int>(loading::SurfaceKind::terrain));
  for (const auto& s : lhd.surfaces)
    if (s.touches)
      world.add_part_shape(s.body, std::make_shared<const Shape>(s.shape), Eigen::Isometry3d::Identity(),
                           static_cast<int>(s.kind));
  for (auto _ : state) {
    driver.command({0, 0, 0});
    benchmark::DoNotOptimize(world.step());
  }
}

}  // namespace

BENCHMARK(machine_linearise)->Unit(benchmark::kMicrosecond);
BENCHMARK(machine_on_its_tyres)->Unit(benchmark::kMicrosecond);
