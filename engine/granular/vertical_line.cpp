// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/vertical_line.h>

#include <algorithm>
#include <limits>

namespace drawpoint::engine::granular {

std::optional<Chord> chord(const engine::Rock& rock, const Eigen::Vector2d& place) {
  constexpr double upright = 1e-12;  // normals are unit vectors, round-off of a component 1e-16
  const auto& shape = std::get<engine::ConvexPolyhedron>(*rock.body.shape);
  const Eigen::Vector3d centre = rock.pose.translation();
  const Eigen::Vector2d offset = place - centre.head<2>();
  if (offset.squaredNorm() >= shape.radius() * shape.radius()) return {};
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t f = 0; f < shape.faces().size(); ++f) {
    const Eigen::Vector3d n = rock.pose.linear() * shape.face_normals()[f];
    const double room =
        shape.face_normals()[f].dot(shape.vertices()[shape.faces()[f][0]]) - n.head<2>().dot(offset);
    if (n.z() > upright)
      high = std::min(high, room / n.z());
    else if (n.z() < -upright)
      low = std::max(low, room / n.z());
    else if (room < 0)
      return {};
  }
  if (low > high) return {};
  return Chord{centre.z() + low, centre.z() + high};
}

}  // namespace drawpoint::engine::granular
