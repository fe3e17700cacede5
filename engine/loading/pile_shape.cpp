// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/pile_shape.hpp>
#include <stdexcept>

namespace drawpoint::engine::loading {

ColumnModel columns_of(std::span<const PosedRock> rocks, const Scenario& scenario, const Lhd& lhd) {
  ColumnGrid grid;
  grid.x_max = scenario.drift.length;
  grid.half_width = scenario.drift.width / 2;
  ColumnOptions options = scenario.columns;
  options.bucket_width = lhd.bucket_width;
  options.bucket_volume = lhd.bucket_volume;
  return column_model(rocks, grid, options);
}

double surface_angle(const ColumnModel& model, const Row& row) {
  constexpr double from = 0.2, to = 0.8;  // of the crest
  const std::vector<double> z = contour(model, row);
  double n = 0, sum_x = 0, sum_z = 0, sum_xx = 0, sum_xz = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double x = model.grid.x(static_cast<double>(i)) - row.front;
    if (x < 0 || z[i] < from * row.crest) continue;
    if (z[i] > to * row.crest) break;
    n += 1;
    sum_x += x;
    sum_z += z[i];
    sum_xx += x * x;
    sum_xz += x * z[i];
  }
  if (n < 2) return row.slope;
  return std::atan2(n * sum_xz - sum_x * sum_z, n * sum_xx - sum_x * sum_x);
}

PileShape pile_shape(const SettledPile& pile, const Scenario& scenario) {
  const granular::RockLibrary library(scenario.pile.density);
  std::vector<PosedRock> rocks;
  PileShape shape;
  for (const granular::PlacedRock& rock : pile.rocks) {
    const engine::RockBody body = library.body(rock.spec);  // the library keeps its shape
    rocks.push_back({&std::get<engine::ConvexPolyhedron>(*body.shape), rock.pose, body.mass});
    shape.mass += body.mass;
  }
  const ColumnModel model = columns_of(rocks, scenario, sandvik_lh621(scenario.machine));
  if (model.rows.empty())
    throw std::invalid_argument(
        "loading::pile_shape: the bucket fits nowhere before this pile; pour more rock");
  shape.surface = surface_angles(model);
  return shape;
}

SurfaceAngles surface_angles(const ColumnModel& model) {
  SurfaceAngles all{.least = M_PI};
  const double share = 1.0 / static_cast<double>(model.rows.size());
  for (const Row& row : model.rows) {
    const double angle = surface_angle(model, row);
    all.mean += share * angle;
    all.least = std::min(all.least, angle);
    all.most = std::max(all.most, angle);
    all.crest += share * row.crest;
    all.toe += share * row.front;
  }
  return all;
}

}  // namespace drawpoint::engine::loading
