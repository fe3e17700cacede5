// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/sqlite_version.h>
#include <drawpoint/studies/say/versions.h>
#include <drawpoint/engine/record/hdf5_version.hpp>
#include <drawpoint/kriging/detail/ipopt_version.hpp>

namespace drawpoint::studies {
namespace {

std::string eigen_version() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

}  // namespace

std::string program_version() {
  return std::string("Drawpoint ") + DRAWPOINT_VERSION + ", commit " + commit() + ", compiler " + __VERSION__;
}

std::string version_text(const Study& study) {
  std::string text = std::string("Drawpoint ") + DRAWPOINT_VERSION + "\ncommit " + commit() + "\ncompiler " +
                     __VERSION__ + "\nEigen " + eigen_version() + "\nIpopt " +
                     kriging::detail::ipopt_version() + "\nSQLite " + sqlite_version();
  const std::string hdf5 = "HDF5 " + engine::record::hdf5_version();
  text += "\n" + hdf5;
  for (const std::string& library : study.simulator.libraries)
    if (library != hdf5) text += "\n" + library;
  return text;
}

}  // namespace drawpoint::studies
