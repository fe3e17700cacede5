// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/tests/support/rocks.hpp>
#include <drawpoint/tests/validation/heaps.hpp>
#include <limits>
#include <numeric>

namespace drawpoint::validation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using engine::ConvexPolyhedron;
using engine::Rock;

// Height at which the vertical line over `place` leaves the rock; −∞ where it misses it.
double exit_height(const Rock& rock, const ConvexPolyhedron& shape, const Vector2d& place) {
  const Vector3d offset(place.x() - rock.pose.translation().x(), place.y() - rock.pose.translation().y(), 0);
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t f = 0; f < shape.faces().size(); ++f) {
    const Vector3d n = rock.pose.linear() * shape.face_normals()[f];
    const double room = shape.face_normals()[f].dot(shape.vertices()[shape.faces()[f][0]]) - n.dot(offset);
    if (n.z() > 1e-12)
      high = std::min(high, room / n.z());
    else if (n.z() < -1e-12)
      low = std::max(low, room / n.z());
    else if (room < 0)
      return -std::numeric_limits<double>::infinity();
  }
  return low <= high ? rock.pose.translation().z() + high : -std::numeric_limits<double>::infinity();
}

bool free_place(const engine::World& world, const Vector3d& place, double size) {
  return std::none_of(world.rocks().begin(), world.rocks().end(), [&](const Rock& rock) {
    return rock.present && (rock.pose.translation() - place).norm() < size;
  });
}

// [m²]
double area_above(const std::vector<double>& heights, double z) {
  return place_spacing * place_spacing *
         static_cast<double>(std::count_if(heights.begin(), heights.end(), [z](double h) { return h > z; }));
}

// Slope of the least-squares line through (x, y).
double fitted_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    sx += x[k];
    sy += y[k];
    sxx += x[k] * x[k];
    sxy += x[k] * y[k];
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

// Of a surface that goes back by -retreat for a metre up.
double degrees_of(double retreat) { return std::atan2(1.0, -retreat) * 180 / M_PI; }

}  // namespace

std::string name_of(const engine::Material& material) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "μ = %g, μ_r = %g", material.friction, material.rolling);
  return text.data();
}

double highest_rock(const engine::World& world, double slower_than) {
  double top = 0;
  for (const Rock& rock : world.rocks())
    if (rock.present && rock.velocity.norm() < slower_than) top = std::max(top, rock.pose.translation().z());
  return top;
}

int let_go_layer(engine::World& world, const Pour& options, int most) {
  engine::CounterRandom turns(options.seed, 4 * world.rocks().size());
  const double z = std::max(options.lowest, highest_rock(world, 0.9 * options.speed) + options.clearance);
  int born = 0;
  for (int i = 0; i < options.nx; ++i)
    for (int j = 0; j < options.ny && born < most; ++j) {
      const Vector2d offset(i - 0.5 * (options.nx - 1), j - 0.5 * (options.ny - 1));
      Eigen::Isometry3d pose(turns.rotation());
      pose.translation() << options.centre + options.size * offset, z;
      if (!free_place(world, pose.translation(), options.size)) continue;
      ++born;
      world.add_rock(
          support::rock_body(static_cast<int>(world.rocks().size() % 6), options.size, options.density), pose,
          Vector3d(0, 0, -options.speed));
    }
  return born;
}

std::vector<double> surface_heights(const engine::World& world, const Area& area) {
  std::vector<Vector2d> places;
  for (double x = area.x0 + place_spacing / 2; x < area.x1; x += place_spacing)
    for (double y = area.y0 + place_spacing / 2; y < area.y1; y += place_spacing) places.emplace_back(x, y);
  std::vector<double> heights(places.size(), 0);
  for (const Rock& rock : world.rocks()) {
    if (!rock.present) continue;
    const auto& shape = std::get<ConvexPolyhedron>(*rock.body.shape);
    const Vector2d centre = rock.pose.translation().head<2>();
    for (std::size_t k = 0; k < places.size(); ++k)
      if ((places[k] - centre).squaredNorm() < shape.radius() * shape.radius())
        heights[k] = std::max(heights[k], exit_height(rock, shape, places[k]));
  }
  return heights;
}

double mean_height(const engine::World& world, const Area& area) {
  const auto heights = surface_heights(world, area);
  return std::accumulate(heights.begin(), heights.end(), 0.0) / static_cast<double>(heights.size());
}

double angle_of_cone(const engine::World& world, double size) {
  Area area{0, 0, 0, 0};
  for (const Rock& rock : world.rocks()) {
    const Vector3d p = rock.pose.translation();
    area = {std::min(area.x0, p.x() - size), std::max(area.x1, p.x() + size), std::min(area.y0, p.y() - size),
            std::max(area.y1, p.y() + size)};
  }
  const auto heights = surface_heights(world, area);
  std::vector<double> levels, radii;
  for (double z = size;; z += 0.1 * size) {
    const double radius = std::sqrt(area_above(heights, z) / M_PI);
    if (radius < size) break;
    levels.push_back(z);
    radii.push_back(radius);
  }
  return degrees_of(fitted_slope(levels, radii));
}

double angle_of_bank(const engine::World& world, const Area& area, double size, double crest) {
  const auto heights = surface_heights(world, area);
  std::vector<double> levels, depths;
  for (double z = 0.5 * size; z < crest - size; z += 0.1 * size) {
    levels.push_back(z);
    depths.push_back(area_above(heights, z) / (area.y1 - area.y0));
  }
  return degrees_of(fitted_slope(levels, depths));
}

Estimate estimate(const std::vector<double>& sample) {
  const double n = static_cast<double>(sample.size());
  const double mean = std::accumulate(sample.begin(), sample.end(), 0.0) / n;
  double squares = 0;
  for (double x : sample) squares += (x - mean) * (x - mean);
  return {mean, std::sqrt(squares / (n - 1) / n)};
}

}  // namespace drawpoint::validation
