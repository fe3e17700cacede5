// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which moments of a scene become frames of a film.
///
/// Frame k shows the time t_k = from + k·speed/fps, k = 0, 1, ... while t_k <= to. `to` itself is shown where
/// it is such a time, to a millionth of a frame: 0 to 2 s with 20 frames/s are 41 frames.

#include <cstddef>
#include <vector>

namespace drawpoint::studies {

struct FrameTimes {
  double from = 0.0, to = 0.0;  ///< [s], from <= to
  double fps = 20.0;            ///< frames per second of the film, above 0
  double speed = 1.0;           ///< seconds of the scene per second of the film, above 0
};

/// As a number that does not overflow.
double frame_count(const FrameTimes& times);

/// [s], ascending, none beyond `to`. Requires a frame_count that fits into memory.
std::vector<double> all_times(const FrameTimes& times);

}  // namespace drawpoint::studies
