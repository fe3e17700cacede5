// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/joining_points.h>
#include <drawpoint/engine/world/scene.h>
#include <optional>
#include <vector>

/// Contacts on edges that are none: where one surface of a body goes on into the next, as tiles of a floor, plates of
/// a bucket or a chute do.
///
/// What slides over a joint is next to the end face of the plate ahead, which the plate behind covers; taken
/// for a wall, it would stop the slide. Of a contact with shape S, a point p on S with outward normal n is
/// left out when another shape T of the same body (fixed surroundings, or one part) is there: T holds p + ε
/// d, and S does not stand out of T's surface at p by more than the depth of p in T and constants::seam_step.
/// With n a face's normal d = n: the face is covered. Else, on an edge or a corner, d is the part of n that
/// leans back over T, across the normal of what slides on T: no point of the joined surface has such a
/// normal. ε = constants::seam_width, so joints may gape by as much. Rocks have no inner edges, and a
/// half-space only covers.
/// Cost: some 10 ns for a contact with the surroundings or a part, more for what is near two shapes of one body.
namespace drawpoint::engine::detail {

class InnerEdges {
 public:
  /// Leaves the points on inner edges out of `joining`, which has results for this many manifolds.
  void leave_out(const Scene& scene, int manifolds, JoiningPoints& joining);

 private:
  // A contact with a surface of the surroundings or of a part.
  struct Contact {
    int other, part;  // the collider on the other side; the part, or -1 for the surroundings
    int manifold;
    bool on_a;  // the surface is side A
    bool same_body(const Contact& c) const { return other == c.other && part == c.part; }
  };

  void list(const Scene& scene, int manifolds, const JoiningPoints& joining);
  unsigned covered(const Scene& scene, const JoiningPoints& joining, const Contact& contact,
                   const Contact& by) const;

  std::vector<Contact> contacts_;
};

}  // namespace drawpoint::engine::detail
