// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The constants of the contact engine: what is physics or a choice of accuracy, and is no option.
///
/// Each has its unit, its source and what it costs: what would be gained and lost by another value. Sources
/// are a reference, a derivation, or "chosen here" for rocks of 0.3 to 2 m in steps of about 0.01 s. Most
/// change the bits of a run; none depends on the machine. Numbers that only say how much work a thread takes
/// at a time, how memory is laid out or what a file begins with change no result and stay where they are
/// used. What a user may choose is an option: WorldOptions, ContactFinderOptions, SolverOptions.
namespace drawpoint::engine::constants {

// Contact law (solver).

/// [m/s] An approach that is faster is an impact: restitution answers it, damping does not, and its impulse
/// does not carry over to the next substep. Chosen here: what gravity gives in half a step. Higher: slow
/// impacts act as damped contacts, and start impulses overshoot. Lower: a creeping pile is struck instead of
/// damped.
constexpr double impact_speed = 0.05;

/// [1] Load that is there to stay grows by at most this factor in a substep; more is an impact. Chosen here.
/// Higher: an impact is struck again, and the pile shakes. Lower: load builds up more slowly than it may.
constexpr double load_growth = 2;

/// [m/s], [rad/s] When the bodies in contact are no faster than this before and after a step's first substep, in the
/// root mean square, and none is faster than `standing_speed_of_one`, all stand: the other substeps are not made, and
/// nothing moves. Chosen here: loads are within 1.6e-4 of a weight then, and a rock that is pushed by less than ten
/// times that, at rest and in a pile at rest, does not begin to move. Higher: loads are less true, and rocks that are
/// pushed harder stay. Lower: round-off of single precision keeps piles going (one small rock of 3000 trembled at 1e-6
/// to 2e-6).
constexpr double standing_speed = 1e-6, standing_speed_of_one = 1e-5;

/// [1] Σ|Δλ| of that substep's last iteration, of Σ λ_n, at most. Chosen here. Higher: a pile that still finds its
/// balance is stopped. Lower: single precision hardly gets there.
constexpr double standing_change = 1e-5;

/// [m/s] At most so fast are overlapping bodies pushed apart. Chosen here: overlaps above 20 mm are slowed down with
/// steps of 10 ms, and what is thrown up rises by 50 mm. Higher: rocks that are put into each other burst apart. Lower:
/// a soft contact that is let go springs back more slowly.
constexpr double push_out_speed = 1;

/// [steps] The least damping time τ of a contact, the stepper's own damping (docs/decisions/0008). Higher:
/// overlap is taken back more slowly. Lower: contacts ring.
constexpr double least_damping_steps = 2;

/// [m] Overlap below which Hertz's law keeps its stiffness, which would be zero at the first touch. Chosen
/// here. Costs a stiffness too high by up to √(1e-5 m / δ) below it.
constexpr double least_hertz_overlap = 1e-5;

/// [1] Determinant of the tangents' 2 x 2 response, relative to the square of its largest eigenvalue, below
/// which it counts as singular and is answered by the scalar step: a machine part with few freedoms. Chosen
/// here, some 1e4 and 80 times the round-off. Higher: sticking takes more iterations. Lower: the inverse is
/// round-off.
constexpr double singular_double = 1e-12, singular_single = 1e-5;

/// [1] Momentum of the iterations: every second one of a substep starts from λ + β (λ − λ'), λ' what it was two
/// iterations (at first one) before. Chosen here among 0.3 to 0.8, on recorded steps of a loading cycle
/// (docs/measurements/contact-solving.md). Higher: sooner near the solution, but single contacts keep swinging about
/// it. Lower: load travels through chains of rocks more slowly.
constexpr double momentum = 0.6;

/// [iterations] Of a substep, after which there is no more momentum. Chosen here. Higher: in single precision a body's
/// momentum drifts by 5e-8 of its own per iteration, and what swings about the solution goes on.
constexpr int momentum_iterations = 64;

// Impulse stage of restitution (solver).

/// [m] A gap of round-off must not keep a contact out of an impact. Chosen here. Higher: rocks are struck
/// that do not touch yet.
constexpr double touching_gap = 1e-6;

/// [1] Change of an iteration, relative to the load, at which the stage has converged; and [iterations] the
/// most that it takes. Chosen here: momentum of a row of balls to round-off. Costs iterations, only in steps
/// with a rebound.
constexpr double impact_tolerance = 1e-12;
constexpr int impact_iterations = 10000;

// Order of the fast method (solver/batch).

/// [pairs] The least of a subdomain, that is of what a thread solves between two barriers. Chosen here: some
/// 20 µs an iteration (docs/measurements/threads.md). Higher: fewer threads have work. Lower: barriers cost
/// more, and more pairs lie across borders.
constexpr int pairs_per_subdomain = 900;

/// [slabs] Of the scene's longest side, among whose borders those of the subdomains are chosen. Chosen here.
/// Higher: subdomains are more equal, for a longer table. Lower: threads wait for the largest.
constexpr int slabs = 256;

// Steps.

/// [s] The step of a world. Shorter: 1/h² of a contact's compliance leaves single precision. Longer: a rock of 0.3 m
/// that falls 5 m goes farther than its own size.
constexpr double shortest_step = 1e-9, longest_step = 0.1;

/// [1] A step that is longer than the last by more than this starts from no impulses: those of a short step may be an
/// impact, not a load that grows with it. Chosen here. Higher: such an impact is multiplied. Lower: loads are lost that
/// would serve.
constexpr double most_growth = 10;

// Geometry.

/// [1] Of a hull's extent: points nearer than this are one, and corners so near to a plane lie in it. Text of six
/// digits is off by up to 5e-6 of its number. Higher: small faces are lost. Lower: faces of a mesh stay in pieces.
constexpr double hull_thickness = 1e-5;

/// [1] Of a hull's extent: the least width of a hull. Lower: planes are tilted by round-off. Higher: sheets are
/// refused.
constexpr double least_hull_width = 1e-6;

/// [m] A face is taken as the axis before a pair of edges that separates by up to so much more: where they
/// tie, a face gives the richer manifold. Chosen here, below the 1e-6 m to which depths are promised; costs
/// that much depth. Lower: the manifold of a rock on its face may fall to one point by round-off.
constexpr double face_preference = 1e-7;

/// [1] Cosine of the angle between the axis of two edges and a face beside them, from which on the face's contact
/// points join the crossing of the edges: 1.15°, by which a rock on a chord of 0.2 m rocks when its ends part by 4 mm.
/// Chosen here. Higher: one end at a time carries the rock, and it rattles. Lower: the points' normal is off by the
/// angle.
constexpr double flat_cosine = 0.9998;

/// [1] So much more counts a point of the last step in the choice of four. Chosen here. Higher: points stay that others
/// outdo, up to this ratio of the area that the four span. Lower: a rock on five corners changes them as their gaps
/// change by micrometres, and rattles.
constexpr double kept_points = 1.5;

/// [1] Squared sine below which two edges are parallel and have no axis; some face normal stands in for it,
/// off by 1e-7 rad at most. Derived: the axis keeps nine of sixteen digits there.
constexpr double parallel_edges = 1e-14;

/// [m] Points or centres nearer than this give no direction. Derived: at 100 m from the origin 1e-14 m of
/// round-off turn it by 1e-5 rad. Higher: another axis is taken, off by no more than this in depth.
constexpr double coincident = 1e-9;

/// [1] Sine of the tilt below which a cylinder stands on its face and its lowest line has no direction.
/// Chosen here; costs a radius times this, in height.
constexpr double upright = 1e-9;

/// [1] Of the farthest coordinates: what bounds of separations are eased by in single precision, unit round-off u =
/// 2⁻²⁴. Derived: the difference of two points is off by 2u of them both, its products with a unit vector and their sum
/// by 4u more, the root of two such squares by 12u in all; 16u. Costs a candidate too many. Lower: the axis of least
/// overlap may be missed.
constexpr double single_round_off = 0x1p-20;

/// [m] Round-off of a height over a plane, for coordinates up to some 100 m. Bounds of separations are eased
/// by it: costs at most a candidate too many. Lower: the axis of least overlap may be missed by round-off.
constexpr double height_round_off = 1e-12;

// Finding contacts (collision, world).

/// [1] Sides of the prism that stands in for a cylinder against polyhedra: it lies within R (1 − cos(π/48)) = 0.0021 R
/// of it, its normals step by 7.5°. Chosen here. More: truer wheels, edges that cost time in every pair.
constexpr int cylinder_sides = 48;

/// [m] FCL takes boxes that differ by round-off for equal and keeps the older one: it gets boxes larger by
/// this, and what it finds is checked against the true ones. Chosen here, some 1e5 times the round-off at 1e5
/// m from the origin. Higher: more candidates to check. Lower: FCL may miss a pair of boxes. Changes no
/// result.
constexpr double box_growth = 1e-6;

/// [m] The tolerance that FCL's narrow phase is asked with. Chosen here, between the round-off of a height (1e-12) and
/// `claim_tolerance`. Lower: EPA's planes are round-off and it may not end by itself. Higher: more axes that are off by
/// more than `claim_tolerance`.
constexpr double fcl_tolerance = 1e-9;

/// [m] By how much the supports along FCL's axis may separate by more or less than FCL says. Derived: an axis from two
/// witness points that are off by `height_round_off` turns by that over their distance d, which costs a shape of
/// radius r a height of 1e-12 r / d: with d = 1e-5 r, 1e-7 m, as much as a face is preferred by. Right answers nearer
/// to touching than that may be refused; none that is accepted is off by more than half of the promised 1e-6 m.
/// Higher: wrong depths pass. Lower: more answers are refused for their round-off.
constexpr double claim_tolerance = 1e-7;

/// [m], of normals [1] How far the points, centres and normals of a restored finder may be off what its poses
/// make them. Chosen here; costs nothing. Lower: states of other compilers are refused. Higher: a damaged
/// state may pass.
constexpr double restored_round_off = 1e-6;

/// [m] Steps of the speculative margin, so that a speed that wavers does not make contacts be searched anew. Chosen
/// here. Higher: more candidates that do not touch. Lower: more searches.
constexpr double speculative_step = 5e-3;

/// [m] A point this far apart joins the solve even when it does not close in; with the motion of two steps added it
/// covers what the solve itself sets moving, but for hard impacts (world/extra_reach.h). Chosen here. Higher: more
/// points to solve. Lower: a contact may be missed for a step.
constexpr double resting_margin = 1e-3;

/// [m] Shapes that are swept towards each other touch when they come this near. Derived: above face_preference, by
/// which an edge may be nearer than is said. Higher: shapes that pass each other catch.
constexpr double touching = 1e-6;

/// [m] By how much two surfaces of a body may lie apart where one goes on into the other (world/inner_edges.h). Chosen
/// here. Higher: what should catch in a gap slides over it. Lower: joints of real drawings catch.
constexpr double seam_width = 1e-3;

/// [m] By how much one of them may lie higher. Chosen here. Higher: a step that should stop a rock does not. Lower: as
/// above.
constexpr double seam_step = 1e-4;

/// A contact normal this near to a face's is the face's. Derived: a mesh of six digits turns its faces by some 1e-6.
constexpr double same_face = 1e-4;

/// [m] A point without its feature of the last step starts from the nearest one left within this. Chosen here, a tenth
/// of the smallest rock. Higher: impulses start at the wrong place. Lower: a rolling rock starts from nothing.
constexpr double match_distance = 0.03;

// Motion (world).

/// [rad] A smaller turn, times √(largest over least moment), is made in one. Derived (free_rotation.h): an energy error
/// of 1e-10 per step. Higher: needles gain energy. Lower: more flows per step.
constexpr double gyroscopic_angle = 1e-5;

/// [1] The energy after a free rotation over that before, beyond which the angular momentum turns along with
/// what contacts turned the rock (free_rotation.h). Chosen here. Higher: slender rocks gain energy. Lower:
/// the momentum of more rocks changes its direction by the extra turn.
constexpr double energy_rise = 1.1;

/// [m/s], [rad/s] What a rock may be given, and beyond which (rad/s: ten times) the solution of a step has broken down.
/// Chosen here, far beyond any mine; squares of it do not overflow single precision.
constexpr double fastest_input = 1e3, fastest_spin = 1e4, fastest_solution = 1e4;

/// [m] Coordinates of a restored rock. Chosen here: a day's flight at `fastest_solution`; squares of it do
/// not overflow. Lower: a world whose rocks left it long ago cannot be restored.
constexpr double farthest_restored = 1e9;

}  // namespace drawpoint::engine::constants
