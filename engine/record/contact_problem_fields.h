// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <vector>

/// The arrays of a contact problem, each with its path, unit and meaning: one list for all that goes through them.
///
/// A visitor has three functions, each for all bodies, pairs, points, parts or rows (the items): `reals` and
/// `integers` for one number per item, `arrays` for a vector or matrix of a shape per item, stored row by row
/// after the item's index. Each gets the field, the items and a function from an item to its value. Private to
/// engine/record.
namespace drawpoint::engine::record::detail {

struct Field {
  const char *path, *unit, *description;
};

using Shape = std::vector<std::size_t>;

template <class Visitor>
void visit_bodies(Visitor& v, std::vector<SolverBody>& items) {
  const Shape vector{3};
  v.arrays(
      {"bodies/velocity", "m/s", "of the centre of mass, before the step"}, items, vector,
      [](auto& b) -> auto& { return b.velocity; });
  v.arrays(
      {"bodies/angular_velocity", "rad/s", "before the step"}, items, vector,
      [](auto& b) -> auto& { return b.angular_velocity; });
  v.arrays(
      {"bodies/external_velocity_change", "m/s", "by outer forces over the step, not yet in velocity"}, items,
      vector, [](auto& b) -> auto& { return b.external_velocity_change; });
  v.reals(
      {"bodies/inverse_mass", "1/kg", "0: fixed"}, items, [](auto& b) -> auto& { return b.inverse_mass; });
  v.arrays(
      {"bodies/inverse_inertia", "1/(kg m2)", "about the centre of mass, in world axes"}, items, {3, 3},
      [](auto& b) -> auto& { return b.inverse_inertia; });
}

template <class Visitor>
void visit_pairs(Visitor& v, std::vector<ContactPair>& items) {
  v.integers(
      {"pairs/a", "1", "first side: row in bodies, or -1 - p for part p of the machine"}, items,
      [](auto& p) -> auto& { return p.a; });
  v.integers(
      {"pairs/b", "1", "second side, as a; normals point from a to b, impulses act on b"}, items,
      [](auto& p) -> auto& { return p.b; });
  v.integers(
      {"pairs/collider_a", "1", "label of a's shape"}, items, [](auto& p) -> auto& { return p.collider_a; });
  v.integers(
      {"pairs/collider_b", "1", "label of b's shape"}, items, [](auto& p) -> auto& { return p.collider_b; });
  v.integers(
      {"pairs/first", "1", "first row in points"}, items, [](auto& p) -> auto& { return p.first; });
  v.integers(
      {"pairs/count", "1", "rows in points: first to first + count - 1"}, items,
      [](auto& p) -> auto& { return p.count; });
  v.reals(
      {"pairs/rolling_arm", "m", "limit of the rolling moment over the sum of the pair's normal impulses"},
      items, [](auto& p) -> auto& { return p.rolling_arm; });
  v.reals(
      {"pairs/spinning_arm", "m", "limit of the moment along the normal over the same sum"}, items,
      [](auto& p) -> auto& { return p.spinning_arm; });
  v.arrays(
      {"pairs/start", "N m s", "moment on b to start from: of the last substep before, times the substeps"},
      items, {3}, [](auto& p) -> auto& { return p.start; });
}

template <class Visitor>
void visit_points(Visitor& v, std::vector<ContactPoint>& items) {
  const Shape vector{3};
  v.integers(
      {"points/feature", "1", "label of the touching features (bits of an unsigned)"}, items,
      [](auto& p) -> auto& { return p.feature; });
  v.arrays(
      {"points/position", "m", "in the world"}, items, vector, [](auto& p) -> auto& { return p.position; });
  v.arrays(
      {"points/arm_a", "m", "from a's centre of mass, or its part's origin, to the point"}, items, vector,
      [](auto& p) -> auto& { return p.arm_a; });
  v.arrays(
      {"points/arm_b", "m", "the same from b's"}, items, vector, [](auto& p) -> auto& { return p.arm_b; });
  v.arrays(
      {"points/normal", "1", "unit, from a to b; the same for all points of a pair"}, items, vector,
      [](auto& p) -> auto& { return p.normal; });
  v.reals(
      {"points/gap", "m", "at the step's start; negative: overlap"}, items,
      [](auto& p) -> auto& { return p.gap; });
  v.reals(
      {"points/stiffness", "N/m", "k"}, items, [](auto& p) -> auto& { return p.stiffness; });
  v.reals(
      {"points/damping_time", "s", "tau; at least two steps count"}, items,
      [](auto& p) -> auto& { return p.damping_time; });
  v.reals(
      {"points/friction", "1", "mu; the same for all points of a pair"}, items,
      [](auto& p) -> auto& { return p.friction; });
  v.reals(
      {"points/restitution", "1", "0 to 1; for a stage of impacts before the step"}, items,
      [](auto& p) -> auto& { return p.restitution; });
  v.arrays(
      {"points/start", "N s", "impulse on b to start from: of the last substep before, times the substeps"},
      items, vector, [](auto& p) -> auto& { return p.start; });
}

template <class Visitor>
void visit_rows(Visitor& v, std::vector<SuperBodyRow>& items, std::size_t freedoms) {
  v.arrays(
      {"machine/rows/jacobian", "1/sqrt(kg) or 1/(m sqrt(kg))", "J, of a row's velocity J w"}, items,
      {freedoms}, [](auto& r) -> auto& { return r.jacobian; });
  v.integers(
      {"machine/rows/kind", "1", "0: motor, 1: stop"}, items, [](auto& r) -> auto& { return r.kind; });
  v.reals(
      {"machine/rows/target", "m/s or rad/s", "of a motor"}, items,
      [](auto& r) -> auto& { return r.target; });
  v.reals(
      {"machine/rows/gap", "m or rad", "of a stop, at the step's start; negative: past the end"}, items,
      [](auto& r) -> auto& { return r.gap; });
  v.reals(
      {"machine/rows/recovery", "s", "in which a stop takes back what is past the end"}, items,
      [](auto& r) -> auto& { return r.recovery; });
  v.reals(
      {"machine/rows/lower", "N s or N m s", "least impulse over the step"}, items,
      [](auto& r) -> auto& { return r.lower; });
  v.reals(
      {"machine/rows/upper", "N s or N m s", "greatest impulse over the step"}, items,
      [](auto& r) -> auto& { return r.upper; });
  v.reals(
      {"machine/rows/start", "N s or N m s", "impulse to start from, as of points"}, items,
      [](auto& r) -> auto& { return r.start; });
}

template <class Visitor>
void visit_machine(Visitor& v, SuperBody& machine) {
  const auto freedoms = static_cast<std::size_t>(machine.velocity.size());
  std::vector<Eigen::VectorXd*> velocities{&machine.velocity_before, &machine.velocity};
  v.arrays(
      {"machine/velocities", "sqrt(kg) m/s",
       "w of unit mass: row 0 before the step, row 1 after outer forces"},
      velocities, {freedoms}, [](auto* w) -> auto& { return *w; });
  v.arrays(
      {"machine/part_maps", "rad/(sqrt(kg) m); 1/sqrt(kg)",
       "N_p: rows 0 to 2 of a part give its angular velocity from w, rows 3 to 5 its origin's velocity"},
      machine.part_maps, {6, freedoms}, [](auto& map) -> auto& { return map; });
  v.arrays(
      {"machine/origins", "m", "of the parts, in the world"}, machine.origins, {3},
      [](auto& origin) -> auto& { return origin; });
  visit_rows(v, machine.rows, freedoms);
}

/// Bodies, pairs and points.
template <class Visitor>
void visit_items(Visitor& v, ContactProblem& problem) {
  visit_bodies(v, problem.bodies);
  visit_pairs(v, problem.pairs);
  visit_points(v, problem.points);
}

}  // namespace drawpoint::engine::record::detail
