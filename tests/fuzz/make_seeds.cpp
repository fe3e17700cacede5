// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Writes the seed corpus of snapshot_reader: states of the small world at several times, as a file (first
// byte 0) and bare (first byte 1). Usage: make_seeds FOLDER
#include <drawpoint/engine/record/snapshot_file.hpp>
#include <drawpoint/tests/fuzz/small_world.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>

using namespace drawpoint;

namespace {

void write(const std::filesystem::path& path, char kind, const std::vector<std::byte>& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.put(kind);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_seeds FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const auto world = fuzz::small_world();
  for (int seed = 0; seed < 6; ++seed) {
    if (seed == 3) world->remove_rock(2);
    const std::vector<std::byte> state = world->save();
    write(folder / ("state" + std::to_string(seed)), 1, state);
    if (seed < 2)
      write(folder / ("file" + std::to_string(seed)), 0, engine::record::detail::wrapped_snapshot(state));
    for (int k = 0; k < 15; ++k) world->step();
  }
}
