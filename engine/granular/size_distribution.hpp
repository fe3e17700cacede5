// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

/// Sizes of blasted rock by mass, and a sampler that keeps to them.
///
/// Mass shares w_i of lengths L_i mean number shares p_i ∝ w_i / L_i³ (equal shapes and density). The sampler
/// draws to a mass quota: with M_i the mass drawn of size i, M the sum and m_i the mean rock of size i, size
/// i is next with a chance in proportion to max(0, w_i (M + Σ p_j m_j) − M_i) / m_i. So no size runs ahead by
/// more than one rock, and |M_i − w_i M| stays below the sum of the heaviest rocks of all sizes, however long
/// the run: shares converge as 1/M, not as 1/√n. Random numbers are a function of (seed, number of the draw):
/// same seed, same rocks. Source of the table: Lindmark (2016), table 3 (its finest part
/// truncated).
namespace drawpoint::engine::granular {

struct SizeClass {
  double length = 0;      ///< longest dimension [m]
  double mass_share = 0;  ///< of the total mass
};

using SizeDistribution = std::array<SizeClass, 4>;

inline constexpr SizeDistribution blasted_ore{{{0.3, 0.2}, {0.4, 0.3}, {0.6, 0.3}, {0.8, 0.2}}};

/// p_i ∝ w_i / L_i³, summing to 1.
std::array<double, 4> number_shares(const SizeDistribution& sizes);

struct RockDraw {
  int size = 0;       ///< index into the distribution
  int shape = 0;      ///< index into rock_shapes()
  double length = 0;  ///< [m]
  double mass = 0;    ///< [kg]
};

class RockSampler {
 public:
  /// What the next draws depend on beside the arguments of the constructor; keep it in a snapshot.
  struct State {
    std::uint64_t drawn = 0;
    std::array<double, 4> mass{};  ///< drawn so far of each size [kg]
  };

  /// density [kg/m³]. Throws std::invalid_argument for a density, length or share that is not positive, and
  /// for shares that do not sum to 1.
  RockSampler(std::uint64_t seed, double density, const SizeDistribution& sizes = blasted_ore);

  RockDraw next();

  const State& state() const { return state_; }
  void restore(const State& state) { state_ = state; }

 private:
  int draw_size(double uniform) const;

  std::uint64_t seed_;
  double density_;
  SizeDistribution sizes_;
  std::array<double, 4> mean_mass_{};
  double mean_of_all_ = 0;
  State state_;
};

}  // namespace drawpoint::engine::granular
