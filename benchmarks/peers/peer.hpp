// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/tests/support/pile_measures.hpp>
#include <memory>
#include <string>
#include <vector>

/// Another rigid-body engine behind one small interface, so that all step the same scene.
///
/// Each adapter (bullet.cpp, ode.cpp, mujoco.cpp) defines make_peer() and says at its top what it sets, what
/// it leaves at the engine's default and which terms of the scene's material the engine has not got. Common
/// to all: convex hulls about their centre of mass in their principal axes with the scene's masses and
/// inertias, its friction and no restitution; nothing sleeps; one thread. SI units, z up.
namespace drawpoint::benchmarks {

struct PeerOptions {
  double step = 0.01;   ///< [s]
  int iterations = 10;  ///< of the engine's velocity solver
};

class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string version() const = 0;
  /// The blade moves along +x at this speed [m/s] from now on, whatever it meets.
  virtual void drive_blade(double speed) = 0;
  virtual void step() = 0;
  virtual double blade_position() const = 0;  ///< x of its centre [m]
  virtual support::RockState rock(int i) const = 0;
  virtual int contacts() const = 0;  ///< contact points of the last step
};

/// As in "peer_NAME".
std::string engine_name();

/// The scene at its start. Throws std::runtime_error if the engine cannot take it.
std::unique_ptr<Peer> make_peer(const support::RockPile& pile, const PeerOptions& options);

}  // namespace drawpoint::benchmarks
