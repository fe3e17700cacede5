// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>
#include <span>
#include <vector>

/// The pile as columns: heights over a square grid on the floor, and what the planner reads from them.
///
/// H(i, j): i along x (toward the back wall), j across (y); x_i = x_min + (i + ½) w, w the column side. A
/// column's height is the highest of (1) the point where the vertical line through its centre leaves a rock
/// and (2) the rocks' vertices within it. Against the true maximum this misses at most w/√2 times the
/// steepest slope of a rock's edge that crosses the column.
///
/// The pile body is the largest (by volume) set of columns higher than h_tol that hang together by their
/// sides; other columns hold rocks lying on the floor and count as empty. A strip is the line of columns of
/// one j. Per strip, from the body:
///   front f: vehicle-side edge of the first column, toward the wall, that starts a run of n_run columns;
///   quota V_q = V_b w / w_b; N: least number of columns from the front on with Σ w² H ≥ V_q, or all;
///   VC = Σ v x / Σ v over those;   Θ = atan(H_VC / (VC − f)), the chord from the toe to the surface at VC.
/// The front is a column's edge, not its middle, so that VC − f ≥ w/2 always. A row is a lateral place of the
/// bucket: the mean over the breadth of ⌈w_b/w⌉ strips around it, each by the share of it that is covered, of those
/// with pile. Rows lie `row_pitch` apart, as many as there is room for, symmetric about the middle; those nearer
/// than `side_clearance` to a side wall do not exist.
///
/// Deterministic. Cost: rocks times columns under a rock times faces.
/// Source: Lindmark 2016, equations 38-40, with the index convention corrected.
namespace drawpoint::engine::loading {

struct PosedRock {
  const engine::ConvexPolyhedron* shape = nullptr;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  double mass = 0;  ///< [kg]
};

struct ColumnGrid {
  double x_min = 0, x_max = 20;  ///< along the drift [m]
  double half_width = 3.5;       ///< the side walls are at y = ±half_width [m]
  double cell = 0.25;            ///< side of a column [m]

  int nx() const;  ///< columns along x, the last may reach beyond x_max
  int ny() const;  ///< strips, centred on y = 0, none beyond the walls
  double x(double i) const { return x_min + (i + 0.5) * cell; }       ///< [m]
  double y(double j) const { return (j + 0.5 - 0.5 * ny()) * cell; }  ///< [m]
};

struct ColumnOptions {
  double h_tol = 0.10;           ///< a column this high or lower is empty [m]; a third of the smallest rock
  int n_run = 3;                 ///< columns that make a front [1]
  double bucket_width = 3.2;     ///< w_b [m]
  double bucket_volume = 8.0;    ///< V_b [m³]
  double side_clearance = 0.10;  ///< between bucket and side wall [m]
  double row_pitch = 0.01;       ///< from one place of the bucket to the next [m]; finer than anyone drives
};

struct Strip {
  bool has_pile = false;
  bool meets_quota = false;  ///< the strip holds V_q
  int front_column = 0;      ///< i of the front
  double front = 0;          ///< f [m]; x_max without pile
  double volume_centre = 0;  ///< VC [m]
  double height = 0;         ///< H above VC [m]
  double slope = 0;          ///< Θ [rad]
};

struct Row {
  double y = 0;              ///< middle of the bucket [m]
  double front = 0;          ///< [m]
  double volume_centre = 0;  ///< [m]
  double slope = 0;          ///< [rad]
  double crest = 0;          ///< highest point of the row's contour [m]
};

struct ColumnModel {
  ColumnGrid grid;
  ColumnOptions options;
  Eigen::MatrixXd heights;    ///< nx × ny, all rocks [m]
  Eigen::MatrixXd body;       ///< nx × ny, 0 outside the pile body [m]
  std::vector<Strip> strips;  ///< ny
  std::vector<Row> rows;      ///< places where the bucket fits and finds pile, by y
};

/// Throws std::invalid_argument on a grid or options that make no sense.
ColumnModel column_model(std::span<const PosedRock> rocks, const ColumnGrid& grid,
                         const ColumnOptions& options = {});

/// The same from measured heights, nx × ny [m], as a scan gives them.
ColumnModel column_model(const Eigen::MatrixXd& heights, const ColumnGrid& grid,
                         const ColumnOptions& options = {});

/// Height of the pile body along x, mean over the row's breadth: nx values at grid.x(i) [m].
std::vector<double> contour(const ColumnModel& model, const Row& row);

/// Whether a rock with this centre lies in front of the pile: on the vehicle's side of the front of the strip
/// it lies in. A strip without pile is in front altogether.
bool lies_in_front(const ColumnModel& model, const Eigen::Vector3d& centre);

}  // namespace drawpoint::engine::loading
