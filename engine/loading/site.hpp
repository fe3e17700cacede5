// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/lhd_driver.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>
#include <drawpoint/engine/loading/strategy/column_model.hpp>

/// Drift, pile and machine put together: the world of one run and what can be read off it.
namespace drawpoint::engine::loading {

class Site {
 public:
  Site(const Scenario& scenario, const SettledPile& pile);
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  engine::World& world() { return world_; }
  const engine::World& world() const { return world_; }
  machine::Machine& machine() { return machine_; }
  const machine::Machine& machine() const { return machine_; }
  const Lhd& lhd() const { return lhd_; }
  LhdDriver& driver() { return driver_; }
  const LhdDriver& driver() const { return driver_; }

  /// Rocks that are present, leaving out those in the bucket if asked.
  std::vector<PosedRock> rocks(bool with_bucket = true) const;
  const std::vector<granular::RockSpec>& specs() const { return specs_; }
  bool in_bucket(int rock) const;  ///< its centre within the heaped bucket
  double mass_in_bucket() const;   ///< of the rocks that are [kg]

  /// What the machine would take away as it stands: `in_bucket` the rocks in the heaped bucket and, of those
  /// `free_of_pile` (by number), the ones that hang together with these or with the bucket and not with the
  /// ground; `elsewhere` the ones that hang so on the rest of it. By the contact forces of the last step: a
  /// rock that hops in it, beside the heaped bucket, is missed.
  struct Load {
    std::vector<int> in_bucket, elsewhere;
  };
  Load load(const std::vector<bool>& free_of_pile) const;

  double remove(const std::vector<int>& rocks);         ///< returns their mass [kg]
  double mass_of(const std::vector<int>& rocks) const;  ///< present or not [kg]

  /// Whether the bucket has left the pile with what it carries: neither it, nor the arm, nor its load touches the
  /// ground or a rock that is not load, and the load moves with it, to 0.25 m/s.
  bool bucket_is_clear() const;

  /// tip_x, or as far back as keeps the bucket at lateral place y clear of rocks lying in its way, but not behind
  /// `farthest_back` [m].
  double free_tip_x(double tip_x, double y, double farthest_back) const;
  /// Puts the machine, standing on its tyres with its bucket on the floor, at lateral place y with the cutting edge at
  /// tip_x, driving at `speed` [m/s]. Rocks that would lie inside it are taken away; returns them.
  std::vector<int> place_machine(double tip_x, double y, double speed = 0);

  /// Lets rocks come down the raise when it is time, toward the mass at the start; whether any came. Call
  /// once per step while mass is missing. `carried` [kg]: what is still there and will be taken away.
  bool refill(double carried = 0);
  double missing_mass() const;  ///< [kg]; at most 0 when the drift holds what it held at the start

  double initial_mass() const { return initial_mass_; }
  double present_mass() const;    ///< of the rocks that are in the drift [kg]
  double emitted_mass() const;    ///< that came down the raise so far [kg]
  double machine_energy() const;  ///< kinetic and potential, over z = 0 [J]
  double rock_energy() const;     ///< the same of all rocks that are present [J]
  /// Takes away rocks that lie outside the drift; returns their mass [kg].
  double remove_escaped();
  /// Empty, or which value of the state is not finite.
  std::string trouble() const;

 private:
  bool in_lane(const engine::Rock& rock, double y) const;

  Drift drift_;
  Lhd lhd_;
  machine::Machine machine_;
  engine::World world_;
  LhdDriver driver_;
  granular::RockLibrary library_;
  granular::Emitter emitter_;
  std::vector<granular::RockSpec> specs_;
  double initial_mass_ = 0;
  std::size_t initial_rocks_ = 0;
};

}  // namespace drawpoint::engine::loading
