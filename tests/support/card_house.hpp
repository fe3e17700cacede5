// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <drawpoint/tests/support/blocks.hpp>
#include <vector>

/// A house of seven cards on the floor z = 0: two pairs that lean against each other, a card across both, a pair on it.
///
/// Cards are slabs that touch with their edges alone, as real ones do: a leaning card stands on its lower inner edge
/// and meets its partner in its upper inner edge; a lying card rests on the upper outer edges of a pair. All contacts
/// are just closed. World frame, SI units.
namespace drawpoint::support {

struct CardHouse {
  double length = 0.6, width = 0.4, thickness = 0.03;  ///< of a card [m]
  double lean = 20 * M_PI / 180;                       ///< from the vertical [rad]
  double apart = 0.5;                                  ///< of the lower pairs' middles [m]
  double density = 2500;                               ///< [kg/m³]

  double foot() const { return length * std::sin(lean); }  ///< of a leaning card, from the pair's middle [m]
  double meeting() const {
    return length * std::cos(lean);
  }  ///< height of the edges in which a pair meets [m]
  double top() const { return meeting() + thickness * std::sin(lean); }  ///< of a pair [m]
  double storey() const { return top() + thickness; }                    ///< with the card across it [m]

  /// The cards, from below.
  std::vector<PlacedBlock> cards() const {
    std::vector<PlacedBlock> cards;
    add_pair(cards, -apart / 2, 0);
    add_pair(cards, apart / 2, 0);
    cards.push_back(
        {box_body({0.75 * length, width / 2, thickness / 2}, density), at(0, 0, top() + thickness / 2)});
    add_pair(cards, 0, storey());
    return cards;
  }

 private:
  void add_pair(std::vector<PlacedBlock>& cards, double x, double floor) const {
    for (const double side : {-1.0, 1.0}) {
      const double half = thickness / 2, beside = half * std::cos(lean) + length / 2 * std::sin(lean),
                   up = half * std::sin(lean) + length / 2 * std::cos(lean);
      Eigen::Isometry3d pose = at(x + side * beside, 0, floor + up);
      pose.linear() = Eigen::AngleAxisd(-side * lean, Vector3d::UnitY()).toRotationMatrix();
      cards.push_back({box_body({half, width / 2, length / 2}, density), pose});
    }
  }
};

}  // namespace drawpoint::support
