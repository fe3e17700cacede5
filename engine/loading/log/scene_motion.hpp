// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <optional>
#include <vector>

/// The motion of the scene's bodies as few poses as show it: of all samples of a body those are kept between
/// which the others lie on a straight line, to a tolerance in each coordinate.
///
/// A line from the last kept sample p₀ (t₀) meets sample i if its slope in each coordinate is within (pᵢ ± tol
/// − p₀)/(tᵢ − t₀). All earlier samples leave an interval of slopes; the first sample outside it makes the one
/// before it a knot, from which the next line begins. O(1) per sample and body. The quaternion's sign is
/// turned so that neighbours lie in the same half; a sample that goes evenly between two knots is theirs
/// mixed component by component, to length 1.
namespace drawpoint::engine::loading {

/// Largest distance of a sample from what is kept: place [m] in each of x, y, z, turn in each component of the
/// quaternion (0.02 is about 2.3 degrees). A body that stands within it has one knot.
struct MotionTolerance {
  double place = 0, turn = 0;
};

inline constexpr ScenePose hidden_pose = {NAN, NAN, NAN, NAN, NAN, NAN, NAN};
inline bool is_hidden(const ScenePose& pose) { return std::isnan(pose[0]); }

class MotionRecorder {
 public:
  /// Into `knots`, which is to stay.
  explicit MotionRecorder(std::vector<SceneKnot>& knots) : knots_(knots) {}
  /// The next sample of a body; its frames come in order, their times [s] rise.
  void add(const SceneKnot& sample, double t, const MotionTolerance& tolerance);
  /// Ends a cycle: what was added since the last end is in the knots, by body and frame, and each body begins
  /// anew.
  void end();

 private:
  struct Line {
    bool begun = false, still = true;  // no sample left the first one by more than the tolerance
    SceneKnot first, last;
    double t_first = 0;
    std::array<double, 7> low{}, high{};  // slopes
  };
  void begin(Line& line, const SceneKnot& sample, double t);
  static bool meets(const Line& line, const ScenePose& pose, double dt);
  static void narrow(Line& line, const ScenePose& pose, double dt, const MotionTolerance& tolerance);
  void finish(Line& line);

  std::vector<SceneKnot>& knots_;
  std::vector<Line> lines_;  // per body
  std::vector<double> t_last_;
  std::size_t sorted_ = 0;  // knots
};

/// Where a body is in a frame, which is of the same cycle as its knots around it; nothing: not shown. O(log n)
/// in the knots.
std::optional<ScenePose> pose_in(const SceneRecord& scene, int body, int frame);

}  // namespace drawpoint::engine::loading
