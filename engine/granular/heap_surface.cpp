// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/heap_surface.hpp>

#include <drawpoint/engine/granular/vertical_line.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::granular {
namespace {

using Eigen::Vector2d;
using engine::Rock;

[[noreturn]] void refuse_surface(const std::string& what) {
  throw std::invalid_argument("granular::heap_surface: " + what);
}

void check_length(const std::string& name, double length) {
  if (!(std::isfinite(length) && length > 0))
    refuse_surface(name + " is " + std::to_string(length) + " m; give more than 0 m");
}

std::vector<Vector2d> places_of(const Area& area, double spacing) {
  check_length("spacing of places", spacing);
  std::vector<Vector2d> places;
  if (std::isfinite(area.x1 - area.x0) && std::isfinite(area.y1 - area.y0))
    for (double x = area.x0 + spacing / 2; x < area.x1; x += spacing)
      for (double y = area.y0 + spacing / 2; y < area.y1; y += spacing) places.emplace_back(x, y);
  if (places.empty())
    refuse_surface("area from x = " + std::to_string(area.x0) + " to " + std::to_string(area.x1) +
                   ", y = " + std::to_string(area.y0) + " to " + std::to_string(area.y1) +
                   " m has no place at a spacing of " + std::to_string(spacing) +
                   " m; give finite sides of more than half the spacing");
  return places;
}

// Calls act(place's number, chord) for every place that has something of a rock over it.
template <class Act>
void each_chord(const engine::World& world, const std::vector<Vector2d>& places, Act&& act) {
  for (const Rock& rock : world.rocks()) {
    if (!rock.present) continue;
    for (std::size_t k = 0; k < places.size(); ++k)
      if (const auto c = chord(rock, places[k])) act(k, *c);
  }
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

// Angle of slope [deg] from radii or depths `extents` at the heights `levels`; NaN for fewer than three.
double degrees_of(const std::vector<double>& levels, const std::vector<double>& extents) {
  if (levels.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  return std::atan2(1.0, -fitted_slope(levels, extents)) * 180 / M_PI;
}

// About the origin and all rocks.
Area around(const engine::World& world, double size) {
  Area area{-size, size, -size, size};
  for (const Rock& rock : world.rocks()) {
    if (!rock.present) continue;
    const Vector2d p = rock.pose.translation().head<2>();
    area = {std::min(area.x0, p.x() - size), std::max(area.x1, p.x() + size), std::min(area.y0, p.y() - size),
            std::max(area.y1, p.y() + size)};
  }
  return area;
}

}  // namespace

std::vector<double> surface_heights(const engine::World& world, const Area& area, double spacing) {
  const std::vector<Vector2d> places = places_of(area, spacing);
  std::vector<double> heights(places.size(), 0);
  each_chord(world, places,
             [&](std::size_t k, const Chord& c) { heights[k] = std::max(heights[k], c.high); });
  return heights;
}

double area_above(const std::vector<double>& heights, double spacing, double z) {
  return spacing * spacing *
         static_cast<double>(std::count_if(heights.begin(), heights.end(), [z](double h) { return h > z; }));
}

double mean_height(const engine::World& world, const Area& area, double spacing) {
  const auto heights = surface_heights(world, area, spacing);
  return std::accumulate(heights.begin(), heights.end(), 0.0) / static_cast<double>(heights.size());
}

double angle_of_cone(const std::vector<double>& heights, double spacing, double size) {
  check_length("spacing of places", spacing);
  check_length("size of a rock", size);
  std::vector<double> levels, radii;
  for (double z = size;; z += 0.1 * size) {
    const double radius = std::sqrt(area_above(heights, spacing, z) / M_PI);
    if (radius < size) break;
    levels.push_back(z);
    radii.push_back(radius);
  }
  return degrees_of(levels, radii);
}

double angle_of_cone(const engine::World& world, double size, double spacing) {
  check_length("size of a rock", size);
  return angle_of_cone(surface_heights(world, around(world, size), spacing), spacing, size);
}

double angle_of_bank(const engine::World& world, const Area& area, double size, double crest,
                     double spacing) {
  check_length("size of a rock", size);
  if (!std::isfinite(crest)) refuse_surface("crest is " + std::to_string(crest) + " m; give a finite height");
  const auto heights = surface_heights(world, area, spacing);
  std::vector<double> levels, depths;
  for (double z = 0.5 * size; z < crest - size; z += 0.1 * size) {
    levels.push_back(z);
    depths.push_back(area_above(heights, spacing, z) / (area.y1 - area.y0));
  }
  return degrees_of(levels, depths);
}

double solid_volume(const engine::World& world, const Area& area, double z0, double z1, double spacing) {
  double length = 0;
  each_chord(world, places_of(area, spacing), [&](std::size_t, const Chord& c) {
    length += std::max(0.0, std::min(c.high, z1) - std::max(c.low, z0));
  });
  return length * spacing * spacing;
}

}  // namespace drawpoint::engine::granular
