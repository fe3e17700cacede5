// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>
#include <drawpoint/tests/house/dependency_table.hpp>

using namespace drawpoint::house;

namespace {

const std::filesystem::path root = DRAWPOINT_ROOT;

std::string first_breach(const std::string& path, const std::string& text) {
  const std::vector<std::string> found = breaches({path, text});
  return found.empty() ? "" : found.front();
}

}  // namespace

// The law: no file of a module includes or names what its row does not grant.
TEST(Dependencies, EverySourceKeepsToTheTable) {
  const std::vector<Source> all = sources(root, {"doe", "kriging", "pareto", "python", "engine", "studies"});
  ASSERT_FALSE(all.empty());
  std::vector<std::string> found;
  for (const Source& source : all) {
    EXPECT_NE(row_of(source.path), nullptr) << source.path << " is in no folder of the dependency table";
    for (const std::string& breach : breaches(source)) found.push_back(breach);
  }
  EXPECT_TRUE(found.empty()) << joined(found);
}

// Who saves no models needs no JSON: the two headers that do are included by no other of their module, and
// what they share by them alone.
TEST(Dependencies, SavingModelsIsAskedForByName) {
  for (const Source& source : sources(root, {"kriging"})) {
    EXPECT_EQ(source.text.find("#include <drawpoint/kriging/save"), std::string::npos) << source.path;
    const bool saves = source.path.find("kriging/save") != std::string::npos ||
                       source.path.find("kriging/detail/saved_") != std::string::npos;
    EXPECT_TRUE(saves || source.text.find("detail/saved_") == std::string::npos) << source.path;
  }
  EXPECT_EQ(first_breach("kriging/save.hpp", "#include <nlohmann/json.hpp>"), "");
  EXPECT_EQ(first_breach("kriging/fit.hpp", "#include <nlohmann/json.hpp>"),
            "kriging/fit.hpp:1: <nlohmann/json.hpp>: kriging/ may not use nlohmann-json");
}

// The checker itself: each kind of breach is found and named, with its line.
TEST(Dependencies, ABreachIsNamed) {
  EXPECT_EQ(first_breach("doe/a.hpp", "#pragma once\n#include <drawpoint/kriging/fit.hpp>\n"),
            "doe/a.hpp:2: <drawpoint/kriging/fit.hpp>: doe/ may not include it");
  EXPECT_EQ(first_breach("kriging/a.hpp", "#include <drawpoint/pareto/nsga2.hpp>"),
            "kriging/a.hpp:1: <drawpoint/pareto/nsga2.hpp>: kriging/ may not include it");
  EXPECT_EQ(first_breach("pareto/a.hpp", "  #  include <drawpoint/kriging/fit.hpp>"),
            "pareto/a.hpp:1: <drawpoint/kriging/fit.hpp>: pareto/ may not include it");
  EXPECT_EQ(first_breach("doe/a.hpp", "#include <coin/IpTNLP.hpp>"),
            "doe/a.hpp:1: <coin/IpTNLP.hpp>: doe/ may not use Ipopt");
  EXPECT_EQ(first_breach("kriging/a.hpp", "#include <coin/IpStdCInterface.h>"),
            "kriging/a.hpp:1: <coin/IpStdCInterface.h>: kriging/ may not use Ipopt's C interface");
  EXPECT_EQ(first_breach("engine/world/a.cpp", "#include <drawpoint/engine/granular/pile.hpp>"),
            "engine/world/a.cpp:1: <drawpoint/engine/granular/pile.hpp>: engine/world/ may not include it");
  EXPECT_EQ(
      first_breach("engine/solver/a.cpp", "#include <drawpoint/engine/collision/manifold.hpp>"),
      "engine/solver/a.cpp:1: <drawpoint/engine/collision/manifold.hpp>: engine/solver/ may not include it");
  EXPECT_EQ(first_breach("engine/machine/a.cpp", "#include <drawpoint/engine/world/world.hpp>"),
            "engine/machine/a.cpp:1: <drawpoint/engine/world/world.hpp>: engine/machine/ may not include it");
  EXPECT_EQ(first_breach("kriging/a.hpp", "#include <pybind11/eigen.h>"),
            "kriging/a.hpp:1: <pybind11/eigen.h>: kriging/ may not use pybind11");
  EXPECT_EQ(first_breach("python/a.cpp", "#include <drawpoint/studies/study.hpp>"),
            "python/a.cpp:1: <drawpoint/studies/study.hpp>: python/ may not include it");
  EXPECT_EQ(first_breach("engine/world/a.cpp", "#include <fcl/fcl.h>"),
            "engine/world/a.cpp:1: <fcl/fcl.h>: engine/world/ may not use FCL");
  EXPECT_EQ(first_breach("engine/loading/a.cpp", "#include <drawpoint/studies/study.hpp>"),
            "engine/loading/a.cpp:1: <drawpoint/studies/study.hpp>: engine/loading/ may not include it");
  EXPECT_EQ(first_breach("engine/loading/a.cpp", "#include <Simbody.h>"),
            "engine/loading/a.cpp:1: <Simbody.h>: engine/loading/ may not use Simbody");
  EXPECT_EQ(first_breach("engine/machine/a.hpp", "#include <SimTKcommon.h>"),
            "engine/machine/a.hpp:1: <SimTKcommon.h>: Simbody may not be in a header");
  EXPECT_EQ(first_breach("engine/collision/a.hpp", "#include <fcl/fcl.h>"),
            "engine/collision/a.hpp:1: <fcl/fcl.h>: FCL may not be in a header");
  EXPECT_EQ(first_breach("doe/a.hpp", "#include <boost/optional.hpp>"),
            "doe/a.hpp:1: <boost/optional.hpp>: no known package has it; name it in the dependency table");
  EXPECT_EQ(first_breach("doe/a.hpp", "#include \"problem.hpp\""),
            "doe/a.hpp:1: <problem.hpp>: write it as <drawpoint/...>");
}

TEST(Dependencies, AnInternalHeaderStaysInside) {
  const std::string include = "#include <drawpoint/engine/machine/a.h>";
  const std::string why =
      ":1: <drawpoint/engine/machine/a.h>: an internal header; only *.cpp and *.h of its room include it";
  EXPECT_EQ(first_breach("engine/machine/a.hpp", include), "engine/machine/a.hpp" + why);
  EXPECT_EQ(first_breach("engine/loading/a.cpp", include), "engine/loading/a.cpp" + why);
  EXPECT_EQ(first_breach("studies/a.cpp", include), "studies/a.cpp" + why);
  EXPECT_EQ(first_breach("engine/machine/b.cpp", include), "");
  EXPECT_EQ(first_breach("engine/machine/b.h", include), "");
  EXPECT_EQ(first_breach("studies/a.cpp", "#include <drawpoint/studies/a.h>"), "");
  EXPECT_NE(first_breach("studies/a.cpp", "#include <drawpoint/studies/run/store/a.h>"), "");
  EXPECT_EQ(first_breach("studies/a.cpp", "#include <drawpoint/studies/loading/a.h>"), "");
  EXPECT_NE(first_breach("studies/a.hpp", "#include <drawpoint/studies/b.h>"), "");
  const std::string shared = "#include <drawpoint/engine/geometry/a.h>";
  EXPECT_EQ(first_breach("engine/collision/b.h", shared), "");
  EXPECT_NE(first_breach("engine/granular/b.cpp", shared), "");
  EXPECT_NE(first_breach("engine/solver/b.cpp", shared), "");
  EXPECT_EQ(first_breach("engine/machine/a.h", "#include <Simbody.h>\nSimTK::State s;"), "");
  EXPECT_EQ(first_breach("engine/loading/a.h", "#include <Simbody.h>"),
            "engine/loading/a.h:1: <Simbody.h>: engine/loading/ may not use Simbody");
}

TEST(Dependencies, TheRoomsOfStudiesIncludeOneWay) {
  const std::vector<std::string> rooms{"run", "model", "say", "commands"};
  for (std::size_t of = 0; of < rooms.size(); ++of)
    for (std::size_t other = 0; other < rooms.size(); ++other) {
      const std::string path = "studies/" + rooms[of] + "/a.cpp", header = "studies/" + rooms[other] + "/b.h";
      const std::string why =
          path + ":1: <drawpoint/" + header + ">: studies/" + rooms[of] + "/ may not include it";
      EXPECT_EQ(first_breach(path, "#include <drawpoint/" + header + ">"), other <= of ? "" : why);
    }
  EXPECT_NE(first_breach("studies/run/store/a.cpp", "#include <drawpoint/studies/run/b.h>"), "");
  EXPECT_NE(first_breach("studies/model/fits/a.cpp", "#include <drawpoint/studies/model/fronts/b.h>"), "");
  EXPECT_NE(first_breach("studies/loading/a.cpp", "#include <drawpoint/studies/model/b.h>"), "");
}

// Below studies/ every folder of sources is a room of the table: a ground floor beside them has no row.
TEST(Dependencies, EveryRoomOfStudiesHasItsRow) {
  for (const Source& source : sources(root, {"studies"})) {
    const auto end = source.path.find('/', std::string("studies/").size());
    if (end == std::string::npos) continue;
    const Row* row = row_of(source.path);
    ASSERT_TRUE(row) << source.path;
    EXPECT_TRUE(row->folder.size() > std::string("studies/").size())
        << source.path << ": its room has no row in the dependency table";
  }
}

TEST(Dependencies, AForwardDeclarationLeaksToo) {
  EXPECT_EQ(first_breach("engine/machine/a.hpp", "namespace SimTK { class State; }"),
            "engine/machine/a.hpp: names Simbody");
  EXPECT_EQ(first_breach("engine/loading/a.cpp", "fcl::Vector3d v;"), "engine/loading/a.cpp: names FCL");
  EXPECT_EQ(first_breach("engine/machine/a.hpp", "/// Built on SimTK's multibody tree.\n"), "");
}

TEST(Dependencies, WhatTheTableGrantsPasses) {
  EXPECT_EQ(first_breach("engine/machine/a.cpp", "#include <Simbody.h>\nSimTK::State s;"), "");
  EXPECT_EQ(first_breach("engine/collision/a.cpp", "#include <fcl/fcl.h>\nfcl::Vector3d v;"), "");
  EXPECT_EQ(
      first_breach("kriging/a.hpp", "#include <Eigen/Dense>\n#include <coin/IpTNLP.hpp>\n#include <cmath>"),
      "");
  EXPECT_EQ(
      first_breach("studies/a.cpp", "#include <sys/wait.h>\n#include <drawpoint/engine/record/run_log.hpp>"),
      "");
  EXPECT_EQ(first_breach("tests/doe/a.cpp", "#include <anything/at_all.hpp>"), "");
}

// A public header that took Eigen by itself would not notice a user's alignment (decision 0020).
TEST(Dependencies, PublicHeadersOfTheEngineTakeEigenFromBase) {
  for (const Source& source : sources(root, {"engine"})) {
    if (!source.path.ends_with(".hpp") || source.path == "engine/base/eigen.hpp") continue;
    EXPECT_EQ(source.text.find("#include <Eigen/"), std::string::npos)
        << source.path << ": include <drawpoint/engine/base/eigen.hpp> instead";
  }
}
