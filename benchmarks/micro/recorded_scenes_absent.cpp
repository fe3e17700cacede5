// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/benchmarks/micro/recorded_scenes.hpp>
#include <stdexcept>

namespace drawpoint::benchmarks {

std::vector<std::string> scene_names() { return {}; }

void record_scene(const std::string& scene, const std::filesystem::path&) {
  throw std::runtime_error("this build leaves out engine/loading, so it cannot simulate \"" + scene +
                           "\"; use a build of the whole engine, or the sets in benchmarks/sets");
}

}  // namespace drawpoint::benchmarks
