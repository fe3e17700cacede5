// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "rock_tests.hpp"

#include <drawpoint/engine/granular/calibration/bulk_density.hpp>
#include <drawpoint/engine/granular/calibration/direct_shear.hpp>
#include <drawpoint/engine/granular/calibration/edge_penetration.hpp>
#include <drawpoint/engine/granular/calibration/plate_penetration.hpp>
#include <drawpoint/engine/granular/calibration/repose.hpp>
#include <drawpoint/engine/granular/calibration/tilting_box.hpp>
#include <limits>
#include <stdexcept>

namespace drawpoint::benchmarks {
namespace {

using namespace engine::granular;

template <class Options>
Options options_of(const RockTestOptions& o) {
  Options options;
  static_cast<RunOptions&>(options) = o.run;
  return options;
}

RockTestRun run_repose(const RockSample& sample, const RockTestOptions& o) {
  auto options = options_of<PouredHeapOptions>(o);
  options.rocks = o.rocks;
  const PouredHeap heap = poured_heap(sample, options);
  return {heap.status, heap.rocks, {heap.angle, heap.height}};
}

RockTestRun run_ledge(const RockSample& sample, const RockTestOptions& o) {
  const DrainedBank bank = drained_bank(sample, options_of<DrainedBankOptions>(o));
  return {bank.status, bank.rocks, {bank.angle, bank.crest}};
}

RockTestRun run_tilt(const RockSample& sample, const RockTestOptions& o) {
  const TiltResult t = tilting_box(sample, options_of<TiltingBoxOptions>(o));
  return {t.status, t.rocks, {t.start}};
}

RockTestRun run_density(const RockSample& sample, const RockTestOptions& o) {
  const BulkDensity b = bulk_density(sample, options_of<BulkDensityOptions>(o));
  return {b.status, b.rocks, {1e-3 * b.density, 100 * b.porosity, 100 * b.swell, 100 * b.porosity_whole}};
}

RockTestRun run_shear(const RockSample& sample, const RockTestOptions& o) {
  auto options = options_of<ShearOptions>(o);
  options.stress = o.stress;
  const ShearResult s = direct_shear(sample, options);
  return {s.status, s.rocks, {s.peak, s.large, s.dilation, 1e-3 * s.normal_stress}};
}

RockTestRun run_penetration(const RockSample& sample, const RockTestOptions& o) {
  const PenetrationResult p = plate_penetration(sample, options_of<PenetrationOptions>(o));
  return {p.status, p.rocks, {1e-3 * p.mean_force, 1e-3 * p.work, 1e-3 * p.pressure}};
}

RockTestRun run_edge(const RockSample& sample, const RockTestOptions& o) {
  auto options = options_of<EdgeOptions>(o);
  options.rough_walls = o.rough_walls;
  options.edge_friction = o.edge_friction;
  const EdgeResult e = edge_penetration(sample, options);
  return {e.status,
          e.rocks,
          {e.slope, 1e-3 * e.early_force, 1e-3 * e.mean_force, 1e-3 * e.line_force, 1e-3 * e.work}};
}

std::vector<RockTest> made_tests() {
  return {
      {"repose",
       "a heap poured slowly on a rough floor: angle of repose",
       {{"angle_deg", "angle deg", 1, 35, 42,
         "blasted hard rock (recalled); dumped coarse waste rock 34 to 40 (read)"},
        {"height_m", "height m", 2}},
       run_repose},
      {"ledge",
       "the bank that is left on a ledge when the end of a bin is taken away",
       {{"angle_deg", "angle deg", 1, 35, std::numeric_limits<double>::infinity(),
         "the poured heap's and more: iron-ore pellets 41 drained, 26 poured (Lommen et al. 2019, read)"},
        {"crest_m", "crest m", 2}},
       run_ledge},
      {"tilt",
       "a filled box tilted by one degree per second until its bed slides",
       {{"start_deg", "starts deg", 1, 35, std::numeric_limits<double>::infinity(),
         "at least the poured heap's (recalled)"}},
       run_tilt},
      {"density",
       "rock filled loosely into a rough box: bulk density, porosity, swell",
       {{"density_t_m3", "density t/m3", 3},
        {"porosity_percent", "porosity %", 1, 33, 43,
         "swell of 50 % (blasted rock) to 75 % (what ore buckets are designed for), n = swell/(1 + swell) "
         "(read)"},
        {"swell_percent", "swell %", 0, 50, 75, "the same"},
        {"porosity_whole_percent", "whole box %", 1}},
       run_density},
      {"shear",
       "large direct shear under a set normal stress: angle of internal friction",
       {{"peak_deg", "peak deg", 1, 40, 50,
         "rockfill like that of mine rock piles (Leps 1970, as quoted; read); Barton and Kjaernsli 1981 "
         "with R 4 to 6, S/sigma 600 to 1200, basic friction 27 to 32: 38 to 50 (recalled)"},
        {"large_deg", "large deg", 1},
        {"dilation_deg", "dilation deg", 1},
        {"normal_kpa", "N/A kPa", 1}},
       run_shear},
      {"penetration",
       "an upright plate pushed down into a loose bed by two largest rocks",
       {{"force_kn", "force kN", 1}, {"work_kj", "work kJ", 2}, {"pressure_kpa", "pressure kPa", 0}},
       run_penetration},
      {"edge",
       "a level edge five largest rocks wide, driven along the floor two of them deep into a bank",
       {{"slope_deg", "slope deg", 1, 35, 42, "as for repose"},
        {"early_force_kn", "first half kN", 1},
        {"force_kn", "second half kN", 1},
        {"line_force_kn_m", "kN/m", 1},
        {"work_kj", "work kJ", 2}},
       run_edge}};
}

}  // namespace

const std::vector<RockTest>& rock_tests() {
  static const std::vector<RockTest> tests = made_tests();
  return tests;
}

const RockTest& rock_test_named(const std::string& name) {
  for (const RockTest& test : rock_tests())
    if (test.name == name) return test;
  throw std::invalid_argument("there is no test \"" + name +
                              "\"; choose repose, ledge, tilt, density, shear or penetration");
}

}  // namespace drawpoint::benchmarks
