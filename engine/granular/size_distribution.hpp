// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

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
  bool operator==(const SizeClass&) const = default;
};

using SizeDistribution = std::array<SizeClass, 4>;

inline constexpr SizeDistribution blasted_ore{{{0.3, 0.2}, {0.4, 0.3}, {0.6, 0.3}, {0.8, 0.2}}};

/// The same with a quarter of its mass below the table's finest, as rocks of 0.2 m; the other three quarters
/// keep the table's shares, 0.3 and 0.4 m as one class of their mean. Some three times as many rocks per
/// tonne, and as dear a step.
inline constexpr SizeDistribution blasted_ore_with_fines{
    {{0.2, 0.25}, {0.35, 0.375}, {0.6, 0.225}, {0.8, 0.15}}};

/// With a tenth of its mass as rocks of 0.1 m; the rest keeps the table's shares, 0.3 and 0.4 m as one class.
/// Eight times as many rocks per tonne.
inline constexpr SizeDistribution blasted_ore_with_small_fines{
    {{0.1, 0.1}, {0.35, 0.45}, {0.6, 0.27}, {0.8, 0.18}}};

/// Rock that blasting broke well: nine tenths of the mass at 0.4 m and below, where half of blasted_ore is at
/// 0.6 m and above. Four times as many rocks per tonne.
inline constexpr SizeDistribution well_broken_ore{{{0.2, 0.35}, {0.3, 0.3}, {0.4, 0.25}, {0.5, 0.1}}};

/// "mine": blasted_ore; "mine_with_fines": blasted_ore_with_fines; "mine_with_small_fines":
/// blasted_ore_with_small_fines; "well_broken": well_broken_ore. Throws std::invalid_argument with the names.
SizeDistribution sizes_named(const std::string& name);
inline constexpr std::array<std::string_view, 4> size_names = {"mine", "mine_with_fines",
                                                               "mine_with_small_fines", "well_broken"};

/// Σ w_i / L_i³ [1/m³]: how many rocks there are of a mass, up to a factor of density and shapes.
double rocks_per_mass(const SizeDistribution& sizes);

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
