// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What docs/reference/machine.md and its picture print of pins, lengths and materials is what the code has.

#include <gtest/gtest.h>

#include <drawpoint/engine/loading/arm_linkage.hpp>
#include <drawpoint/engine/loading/mine_materials.hpp>
#include <drawpoint/engine/loading/strategy/kinematics.hpp>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <vector>

using namespace drawpoint::engine::loading;

namespace {

std::string text_of_doc(const std::string& name) {
  std::ifstream file(std::string(DRAWPOINT_DOCS) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The numbers of a row of a table that begins like this.
std::vector<double> numbers_in_row(const std::string& text, const std::string& begin) {
  const std::size_t at = text.find("\n" + begin);
  if (at == std::string::npos) return {};
  const std::size_t from = at + 1 + begin.size();
  const std::string row = text.substr(from, text.find('\n', from) - from);
  static const std::regex number("-?[0-9]+(\\.[0-9]+)?(e[0-9]+)?");
  std::vector<double> all;
  for (std::sregex_iterator match(row.begin(), row.end(), number), end; match != end; ++match)
    all.push_back(std::stod(match->str()));
  return all;
}

std::map<std::string, Eigen::Vector2d> pins_of_code() {
  const ArmLinkage arm;
  return {{"F", arm.F}, {"G", arm.G}, {"E", arm.E}, {"Q", arm.Q}, {"P", arm.P}, {"H", arm.H}, {"T", arm.T}};
}

}  // namespace

TEST(MachinePage, HasThePinsOfTheCode) {
  const std::string page = text_of_doc("reference/machine.md");
  for (const auto& [name, pin] : pins_of_code()) {
    const std::vector<double> printed = numbers_in_row(page, "| " + name + " | ");
    ASSERT_EQ(printed.size(), 2u) << name;
    EXPECT_EQ(printed[0], pin.x()) << name;
    EXPECT_EQ(printed[1], pin.y()) << name;
  }
}

TEST(MachinePage, HasTheLengthsOfTheCode) {
  const ArmGeometry arm;
  const std::string head = "| FG [m] | GK [m] | x_F [m] | z_F [m] | ψ_b [deg] |\n|---|---|---|---|---|\n";
  const std::vector<double> printed = numbers_in_row(text_of_doc("reference/machine.md"), head);
  ASSERT_EQ(printed.size(), 5u);
  EXPECT_EQ(printed[0], arm.FG);
  EXPECT_EQ(printed[1], arm.GK);
  EXPECT_EQ(printed[2], arm.x_F);
  EXPECT_EQ(printed[3], arm.z_F);
  EXPECT_NEAR(printed[4], arm.psi_b * 180 / M_PI, 0.005);
}

// One metre is 140 in the picture; x = 0 lies at 150, z = 0 at 370.
TEST(MachinePage, ThePictureHasThePinsOfTheCode) {
  const std::string picture = text_of_doc("images/arm.svg");
  const ArmGeometry arm;
  std::map<std::string, Eigen::Vector2d> pins = pins_of_code();
  pins["K"] = pins["G"] + arm.GK * Eigen::Vector2d(std::cos(arm.psi_b), std::sin(arm.psi_b));
  for (const auto& [name, pin] : pins) {
    std::smatch found;
    ASSERT_TRUE(std::regex_search(picture, found,
                                  std::regex("id=\"" + name + "\" cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"")))
        << name;
    EXPECT_NEAR((std::stod(found[1]) - 150) / 140, pin.x(), 0.001) << name;
    EXPECT_NEAR((370 - std::stod(found[2])) / 140, pin.y(), 0.001) << name;
  }
}

TEST(MachinePage, HasTheMaterialsOfTheCode) {
  const std::string page = text_of_doc("reference/machine.md");
  const MineMaterials source = lindmark2016_materials(), ours = calibrated_materials();
  const std::map<std::string, drawpoint::engine::Material MineMaterials::*> rows{
      {"| 8 | rock, bucket | ", &MineMaterials::rock_steel},
      {"| 9 | floor, bucket | ", &MineMaterials::steel_terrain},
      {"| 10 | rock, tyre | ", &MineMaterials::rock_tyre},
      {"| 11 | rock, floor | ", &MineMaterials::rock_terrain},
      {"| 12 | tyre, floor | ", &MineMaterials::tyre_terrain},
      {"| 13 | rock, rock | ", &MineMaterials::rock_rock}};
  for (const auto& [row, pair] : rows) {
    const std::vector<double> printed = numbers_in_row(page, row);
    ASSERT_EQ(printed.size(), 6u) << row;
    for (const auto& [materials, from] : {std::pair{&source, 0}, std::pair{&ours, 3}}) {
      const drawpoint::engine::Material& m = materials->*pair;
      const auto at = static_cast<std::size_t>(from);
      EXPECT_EQ(printed[at], m.friction) << row;
      EXPECT_EQ(printed[at + 1], m.rolling) << row;
      EXPECT_EQ(printed[at + 2], m.stiffness) << row;
      EXPECT_EQ(m.restitution, 0) << row;
    }
  }
}
