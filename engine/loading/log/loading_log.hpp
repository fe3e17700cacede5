// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>
#include <drawpoint/engine/loading/strategy/executor.hpp>
#include <drawpoint/engine/record/table.hpp>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

/// Everything a loading run leaves behind: raw signals at full rate, one record per cycle, and frames for
/// pictures. Responses are pure functions of it, so a changed definition never needs a new simulation.
///
/// Signals that the responses read, when present: time [s], cycle (from 1), hinge_G_torque_x/y/z [N m] (y:
/// the bucket pin's axis); for plots tip_x, tip_z [m] and stage (1-4, 0 between cycles). World frame, SI
/// units.
namespace drawpoint::engine::loading {

struct CycleRecord {
  int number = 0;                 ///< from 1; the signals' `cycle`
  double t_start = 0, t_end = 0;  ///< of what was simulated of stages 1 to 4 [s]
  /// What the machine takes to the parts of stages 1 and 4 that were not simulated (strategy/left_out.hpp).
  double left_out_time = 0;    ///< [s]
  double left_out_energy = 0;  ///< of its wheel motors [J]
  double loaded_mass = 0;      ///< that the bucket carries once it stands, in its heap or on it [kg]
  std::vector<double> loaded_rock_masses;  ///< [kg]
  Plan plan;
  std::vector<StageResult> stages;
  std::vector<double> planned_x, planned_z;  ///< tip path [m]
  std::vector<double> contour_x, contour_z;  ///< pile along the attacked row, at the start [m]
  int columns_x = 0, columns_y = 0;          ///< nx, ny of the column model
  std::vector<double> column_heights;        ///< at the start, value of (i, j) at j * nx + i [m]

  double seconds() const { return t_end - t_start + left_out_time; }  ///< stages 1 to 4, all of them [s]
};

struct SceneBody {
  int shape = 0;                  ///< index into SceneRecord::shapes
  std::string color = "#808080";  ///< `#rrggbb`
  double opacity = 1.0;
  std::string name;
  double mass =
      std::numeric_limits<double>::quiet_NaN();  ///< of a rock [kg]; NaN: no rock, or of a log of version 4
  int with = -1;  ///< body whose poses this one takes, for it is fixed to that; -1: it has its own
};

struct SceneFrame {
  double t = 0;  ///< [s]
  int cycle = 0;
  std::string label;
  /// Mass of the rocks whose centre is in the heaped bucket, resting there or not [kg]; NaN in logs of version 4.
  double bucket_mass = std::numeric_limits<double>::quiet_NaN();
};

/// x y z qw qx qy qz of a body's centre of mass; NaN: not shown.
using ScenePose = std::array<float, 7>;

/// The pose of a body in one frame. From knot to knot of a cycle it goes evenly, after the last it stays as it
/// is, and before the first the body is not shown. A recorded scene is that within
/// 2.5 cm, its machine within 4 mm (scene_motion.hpp).
struct SceneKnot {
  int body = 0, frame = 0;
  ScenePose pose{};
};

struct SceneRecord {
  std::vector<engine::ConvexPolyhedron> shapes;
  std::vector<SceneBody> bodies;
  std::vector<SceneFrame> frames;
  std::vector<SceneKnot> knots;  ///< cycle by cycle; in a cycle by body, then by frame
};

struct LoadingLog {
  /// All cycles were run, but for those that broke down (`lost_cycles`) or were not needed
  /// (`left_out_cycles`).
  bool completed = false;
  std::string message;  ///< why not, or empty
  /// The scenario's parameters, and of the run: mass at first, present at the end, emitted, cleared away for
  /// the machine and of rock that left the drift [kg], cycles that broke down, steps that had to be done
  /// again in parts, the most contact points of a step and the iterations per substep that `iteration_budget`
  /// left for these, and the largest overlap of a rock and loop error while the machine worked [m].
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> texts;  ///< its choices, versions, why cycles broke down
  record::Table signals;
  std::vector<CycleRecord> cycles;  ///< done, in order; a cycle that broke down has none
  SceneRecord scene;
};

/// HDF5, atomic: the whole log or the old file. Throws std::runtime_error if it cannot be written,
/// std::invalid_argument if the log contradicts itself.
void write_log(const std::filesystem::path& path, const LoadingLog& log);

/// What of a log is read: motion and shapes of a scene are most of it. Without, the scene has its frames alone.
enum class LogContent { all, without_scene };

/// Reads logs of versions 4 to 9; of a run that was killed, all cycles that it had done: those after
/// the first are in files beside it, FILE.part0002 and so on. Throws std::runtime_error if a file is missing,
/// truncated, damaged or no loading log, or if a part is of another run.
LoadingLog read_log(const std::filesystem::path& path, LogContent content = LogContent::all);

}  // namespace drawpoint::engine::loading
