// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/rock_shapes.hpp>

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <drawpoint/engine/base/hash.hpp>
#include <drawpoint/engine/geometry/mass_properties.hpp>
#include <vector>

namespace drawpoint::engine::granular {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using engine::ConvexPolyhedron;

// a x + b y + c z ≤ d. The first six are the sides of a block, the others cut its corners and edges.
struct HalfSpace {
  int a, b, c, d;
};
using Planes = std::vector<HalfSpace>;

const std::array<Planes, 6>& fractures() {
  static const std::array<Planes, 6> table{{
      {{97, 23, -8, 52},
       {-96, -23, -16, 49},
       {6, 100, 0, 31},
       {-13, -99, 8, 32},
       {-7, 17, 98, 26},
       {-4, -10, -99, 25},
       {-8, 34, 94, 27},
       {43, -63, 64, 45},
       {79, 14, -59, 41},
       {-83, 55, -6, 39}},
      {{97, -18, 19, 51},
       {-100, 8, 5, 48},
       {-28, 96, 3, 35},
       {13, -98, 14, 33},
       {-19, 9, 98, 31},
       {14, -20, -97, 31},
       {82, 52, -22, 46},
       {-14, 6, -99, 28},
       {-39, -69, -61, 43},
       {16, 38, -91, 36},
       {48, 70, 53, 44}},
      {{94, 1, 34, 51},
       {-94, 33, -13, 50},
       {34, 94, 3, 37},
       {-1, -100, -4, 38},
       {-10, 2, 99, 29},
       {19, -14, -97, 28},
       {90, -44, 3, 40},
       {-92, -36, 11, 44},
       {-21, 94, -28, 38},
       {-31, -19, 93, 38}},
      {{99, 7, -12, 51},
       {-99, 13, 8, 51},
       {1, 100, -2, 39},
       {-15, -99, 8, 38},
       {11, 11, 99, 34},
       {-12, -3, -99, 32},
       {-53, 77, 37, 52},
       {-49, 85, -19, 48},
       {80, -59, -8, 54},
       {71, 64, -29, 47},
       {-36, -57, -74, 48},
       {-84, -53, 6, 44}},
      {{96, 29, 2, 49},
       {-98, -18, -2, 50},
       {-25, 95, -17, 42},
       {-22, -97, 8, 45},
       {-8, 12, 99, 31},
       {-6, 6, -100, 29},
       {22, 75, 63, 41},
       {66, -67, 33, 48},
       {55, -66, -52, 47},
       {52, -79, -31, 43},
       {42, 89, -17, 47}},
      {{94, 19, -27, 49},
       {-96, -28, -10, 50},
       {-13, 98, -14, 43},
       {-21, -96, -17, 44},
       {46, 8, 88, 40},
       {-11, 4, -99, 38},
       {34, -73, 59, 48},
       {-53, 42, -74, 59},
       {-49, 48, 73, 48},
       {-18, 52, 84, 43},
       {-27, -62, 74, 56},
       {96, -26, -11, 51}},
  }};
  return table;
}

bool inside(const Planes& planes, const Vector3d& p) {
  constexpr double round_off = 1e-9;  // coefficients are of order 100, corners meet three planes exactly
  for (const HalfSpace& h : planes)
    if (h.a * p.x() + h.b * p.y() + h.c * p.z() > h.d + round_off) return false;
  return true;
}

std::vector<Vector3d> corners(const Planes& planes) {
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j)
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        Matrix3d A;
        Vector3d d;
        int row = 0;
        for (const HalfSpace& h : {planes[i], planes[j], planes[k]}) {
          A.row(row) << h.a, h.b, h.c;
          d[row++] = h.d;
        }
        if (std::abs(A.determinant()) < 1e3)
          continue;  // integers near 1e6 unless the planes share a direction
        const Vector3d corner = A.inverse() * d;
        if (inside(planes, corner)) result.push_back(corner);
      }
  return result;
}

ConvexPolyhedron rock(const Planes& planes) {
  const ConvexPolyhedron raw = ConvexPolyhedron::hull_of(corners(planes));
  const Eigen::Isometry3d to_principal = engine::principal_frame(engine::mass_properties(raw, 1.0)).inverse();
  return raw.transformed(to_principal).scaled(1 / raw.length());
}

}  // namespace

const std::array<ConvexPolyhedron, 6>& rock_shapes() {
  static const std::array<ConvexPolyhedron, 6> shapes{rock(fractures()[0]), rock(fractures()[1]),
                                                      rock(fractures()[2]), rock(fractures()[3]),
                                                      rock(fractures()[4]), rock(fractures()[5])};
  return shapes;
}

std::uint64_t rock_shapes_checksum() {
  engine::StateHash hash;
  for (const Planes& planes : fractures())
    for (const HalfSpace& h : planes)
      for (const int coefficient : {h.a, h.b, h.c, h.d}) hash.add(static_cast<std::uint64_t>(coefficient));
  return hash.value();
}

}  // namespace drawpoint::engine::granular
