// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/frames/frame_times.h>

#include <algorithm>
#include <cmath>

namespace drawpoint::studies {

double frame_count(const FrameTimes& times) {
  constexpr double round_off = 1e-6;  // of a frame: (1.1 - 0.4)·10 is a little more or less than 7
  return 1.0 + std::floor((times.to - times.from) * times.fps / times.speed + round_off);
}

std::vector<double> all_times(const FrameTimes& times) {
  std::vector<double> result(static_cast<std::size_t>(frame_count(times)));
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] = std::min(times.to, times.from + static_cast<double>(k) * times.speed / times.fps);
  return result;
}

}  // namespace drawpoint::studies
