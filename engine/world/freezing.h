// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/pair_memory.h>
#include <Eigen/Dense>
#include <drawpoint/engine/collision/manifold.hpp>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <drawpoint/engine/world/freezing_options.hpp>
#include <drawpoint/engine/world/rock.hpp>
#include <utility>
#include <vector>

/// Which rocks stand still and need no solving: rock by rock, since a pile under load is one island.
///
/// With the impulses that a step puts on a rock, P = m h g + Σ f and L = Σ M about its centre (contacts that
/// are solved and contacts that are held alike), its carried load c = max(m h |g|, ½ Σ |f|) and its radius of
/// gyration k, the unbalance is u = max(|P|, |L| / k) / c.
///   A rock freezes when it has stayed within `distance` for `hold`, carries load, is out of reach of machine
///     parts, is slower than distance / hold, and u ≤ tolerance / 2; and when all that it touches have stayed
///     for hold / 2 or are frozen with u ≤ tolerance. So a layer of calm rocks lies between the frozen ones
///     and what moves.
///   While frozen it is part of the fixed world. Contacts between two bodies that stand still are not looked
///     for and not solved; their last impulses are held and their manifolds kept (pair_memory.h, pair_cache.h).
///   It thaws when a rock faster than `nudge` touches it or is about to; and when P and L, as exponential
///     means over `average`, leave the balance: u > tolerance. Resting contacts tick as they change features,
///     and a tick is no load. All that a frozen rock may take from a neighbour unnoticed is a momentum of
///     c (tolerance average / h): for a free rock 0.05 m/s by default.
///   A step that leaves a frozen rock with u > impact is solved again with that rock and its neighbours up to
///     `spread` contacts away thawed, twice as far in every further round.
///   Rocks within reach of a machine part thaw before they are touched, with their neighbours, and do not
///     freeze there. A rock that is taken away thaws those it bore.
/// So the held impulses are a static solution of the pile, inside its friction cones, with every rock in
/// balance within `tolerance` of the load that it carries. A thawed rock starts at rest from the impulses
/// that were held. Freezing takes a rock's kinetic energy away: at most ½ m (distance / hold)².
///
/// Pure function of the calls: same bits for any number of threads. Cost per step: 50 ns per awake rock and 10 ns
/// per solved point; some µs per change; nothing for a frozen rock. A step that is solved again costs twice.
namespace drawpoint::engine {

/// All that later decisions depend on, beside the held pairs of the memory.
struct FreezingState {
  struct Stand {
    bool frozen = false;
    int calm = 0;  ///< steps since the rock was at `anchor`
    /// Of a frozen rock: means of P [N s] and L [N m s].
    Eigen::Vector3d impulse = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
    Eigen::Isometry3d anchor = Eigen::Isometry3d::Identity();
  };
  std::vector<Stand> rocks;
};

class Freezing {
 public:
  /// Throws std::invalid_argument for options out of range. step [s], gravity [m/s²].
  Freezing(const FreezingOptions& options, double step, const Eigen::Vector3d& gravity);

  bool frozen(int rock) const { return state_.rocks[static_cast<std::size_t>(rock)].frozen; }
  const std::vector<int>& awake() const { return awake_; }  ///< rocks that are solved, ascending

  void add(int rock, const Rock& body);
  /// Forgets a rock that is taken away. Returns the frozen rocks that it bore or that bore it.
  std::vector<int> remove(int rock, detail::PairMemory& memory);

  /// Frozen rocks that a machine part is near enough to touch, and their neighbours; remembers all such rocks
  /// for this step's freeze().
  std::vector<int> near_machine(const std::vector<Manifold>& manifolds);

  /// Takes the impulses of a solved step, which may be solved again.
  void weigh(const ContactProblem& problem);
  /// Frozen rocks beyond `impact` in the step that was weighed last, and their neighbours over
  /// `contacts_away` contacts.
  std::vector<int> struck(int contacts_away) const;
  /// Takes the step that was weighed last into the means. Returns the frozen rocks that have left their
  /// balance, and their neighbours over `spread` contacts.
  std::vector<int> unbalanced();
  /// Frozen rocks that touch one faster than `nudge`, or are about to, and their neighbours.
  std::vector<int> nudged(const std::vector<Rock>& rocks, const ContactProblem& problem) const;
  /// u of a rock in the step that was weighed last [1]; 0 for a frozen rock without solved contacts.
  double unbalance(int rock) const;

  /// Thaws frozen rocks and releases their contacts.
  void thaw(const std::vector<int>& rocks, detail::PairMemory& memory);
  /// Evaluates the awake rocks after the step that was weighed last. Returns those that freeze now; they
  /// stand.
  std::vector<int> freeze(const std::vector<Rock>& rocks, const ContactProblem& problem,
                          detail::PairMemory& memory);

  const FreezingOptions& options() const { return options_; }
  const FreezingState& state() const { return state_; }
  /// Takes a state over. Throws std::runtime_error when it is of another number of rocks or the memory holds contacts of
  /// rocks that are awake, and then changes nothing.
  void restore(const FreezingState& state, const detail::PairMemory& memory);

 private:
  struct Load {
    Eigen::Vector3d impulse = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
    double carried = 0;
    bool solved = false;
  };
  struct Partner {
    int collider, slot;  // of the held contact
    bool bears;          // whether it has an impulse
  };
  struct Body {
    int collider = -1;
    double mass = 0, arm = 0;       // arm: radius of gyration
    std::vector<Partner> partners;  // by collider, ascending
    Load held;
  };

  int rock_of(int collider) const;
  bool stands(int collider) const;
  Load& load_of(int rock);
  void add_pair(const ContactProblem& problem, const ContactPair& pair);
  void hold(const ContactProblem& problem, detail::PairMemory& memory);
  void join(int a, int b, int slot, const detail::HeldLoad& load);
  void part(int a, int b);
  void sum_held(int rock, const detail::PairMemory& memory);
  std::vector<int> spread_from(std::vector<int> rocks, int contacts_away) const;
  double speed(int rock, const Rock& body) const;
  void watch(int rock, const Rock& body);
  double relative(int rock, const Eigen::Vector3d& P, const Eigen::Vector3d& L) const;
  void veto(std::vector<int>& candidates, const ContactProblem& problem) const;
  void list_awake();

  static constexpr int no_rock = -1;  // for a collider that is no rock's

  FreezingOptions options_;
  int hold_steps_;
  Eigen::Vector3d weight_;  // h g
  double slow_;             // [m/s]
  double share_;            // of a step in the means
  FreezingState state_;
  std::vector<Body> bodies_;
  std::vector<int> rock_of_collider_;
  std::vector<bool> present_;
  std::vector<int> awake_;
  std::vector<Load> loads_;
  std::vector<int> near_;     // rocks within reach of a machine part in this step, ascending
  std::vector<int> weighed_;  // rocks with solved contacts, in no order that matters
};

}  // namespace drawpoint::engine
