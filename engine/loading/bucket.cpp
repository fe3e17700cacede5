// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/engine/loading/bucket.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::loading {
namespace {

using Eigen::Vector2d;

const Vector2d foot_of_back(2.14, 0);
constexpr double own_mass = 4800;  // [kg]

/// Drawn larger about the foot of the back. Of size 1 it is the point itself, to the bit.
Vector2d drawn(const Vector2d& point, double size) { return point + (size - 1) * (point - foot_of_back); }

/// Section area of the floor plate, which lies inside the profile [m²].
double floor_section(const std::vector<Vector2d>& profile) {
  return (profile.front() - profile.back()).norm() * (plate_thickness + plate_thickness / 4) / 2;
}

double plate_area(const BucketOptions& bucket) {
  const std::vector<Vector2d> profile = bucket_profile(bucket);
  double girth = 0;
  for (std::size_t k = 1; k < profile.size(); ++k)
    girth += (profile[(k + 1) % profile.size()] - profile[k]).norm();
  return girth * bucket.width + 2 * area(profile);
}

void require_bucket(bool fine, const std::string& name, double value, const std::string& allowed) {
  if (!fine)
    throw std::invalid_argument("loading::BucketOptions: " + name + " is " + std::to_string(value) +
                                "; allowed: " + allowed);
}

}  // namespace

// The section goes with the square of the size, what the floor takes of it with the size: a quadratic equation.
BucketOptions bucket_of(double width, double heaped_volume) {
  const std::vector<Vector2d> own = bucket_profile({});
  const double square = area(heaped(own)), floor = floor_section(own);
  const double wanted = heaped_volume / clear_width({width});
  return {width, (floor + std::sqrt(floor * floor + 4 * square * wanted)) / (2 * square)};
}

std::vector<Vector2d> bucket_profile(const BucketOptions& bucket) {
  std::vector<Vector2d> profile = {{3.85, 0},    {2.95, 1.85}, {2.30, 1.68},
                                   {2.14, 1.15}, {2.16, 0.35}, {2.40, 0}};
  for (Vector2d& point : profile) point = drawn(point, bucket.size);
  return profile;
}

std::vector<Vector2d> heaped(const std::vector<Vector2d>& profile) {
  const Vector2d edge = profile[0], lip = profile[1], opening = lip - edge;
  const Vector2d outward = Vector2d(opening.y(), -opening.x()).normalized();
  std::vector<Vector2d> heap = profile;
  heap.insert(heap.begin() + 1, edge + 0.5 * opening + outward * (opening.norm() / 4));
  return heap;
}

// Shoelace formula.
double area(const std::vector<Vector2d>& profile) {
  double twice = 0;
  for (std::size_t i = 0, j = profile.size() - 1; i < profile.size(); j = i++)
    twice += profile[j].x() * profile[i].y() - profile[i].x() * profile[j].y();
  return twice / 2;
}

double clear_width(const BucketOptions& bucket) { return bucket.width - 2 * plate_thickness; }

double struck_volume(const BucketOptions& bucket) {
  const std::vector<Vector2d> profile = bucket_profile(bucket);
  return clear_width(bucket) * (area(profile) - floor_section(profile));
}

double heaped_volume(const BucketOptions& bucket) {
  const std::vector<Vector2d> profile = bucket_profile(bucket);
  return clear_width(bucket) * (area(heaped(profile)) - floor_section(profile));
}

double bucket_mass(const BucketOptions& bucket) { return own_mass * (plate_area(bucket) / plate_area({})); }

Vector2d bucket_centre(const BucketOptions& bucket) { return drawn({2.60, 0.60}, bucket.size); }

void check(const BucketOptions& bucket) {
  require_bucket(bucket.width >= 3.1 && bucket.width <= 5, "width [m]", bucket.width,
                 "3.1 m (the wheels run in its track) to 5 m");
  require_bucket(bucket.size >= 0.7 && bucket.size <= 1.3, "size [1]", bucket.size,
                 "0.7 to 1.3 of the machine's own bucket");
}

}  // namespace drawpoint::engine::loading
