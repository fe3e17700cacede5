// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/engine/loading/pile_shape.hpp>
#include <stdexcept>

namespace drawpoint::engine::loading {

ColumnGrid grid_over(const Drift& drift) {
  ColumnGrid grid;
  grid.x_max = drift.length;
  grid.half_width = drift.width / 2;
  return grid;
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
  return std::atan2(n * sum_xz - sum_x * sum_z, n * sum_xx - sum_x * sum_x);
}

PileShape pile_shape(const SettledPile& pile, const Scenario& scenario) {
  const granular::RockLibrary library(scenario.pile.density);
  std::vector<PosedRock> rocks;
  std::vector<contact::RockBody> bodies;  // keep the shapes alive
  PileShape shape;
  for (const granular::PlacedRock& rock : pile.rocks) {
    bodies.push_back(library.body(rock.spec));
    rocks.push_back(
        {&std::get<contact::ConvexPolyhedron>(*bodies.back().shape), rock.pose, bodies.back().mass});
    shape.mass += bodies.back().mass;
  }
  const ColumnModel model = column_model(rocks, grid_over(scenario.drift), scenario.columns);
  if (model.rows.empty())
    throw std::invalid_argument(
        "loading::pile_shape: the bucket fits nowhere before this pile; pour more rock");
  for (const Row& row : model.rows) {
    const double share = 1.0 / static_cast<double>(model.rows.size());
    shape.crest += share * row.crest;
    shape.toe += share * row.front;
    shape.angle += share * surface_angle(model, row);
  }
  return shape;
}

}  // namespace drawpoint::engine::loading
