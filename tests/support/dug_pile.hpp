// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/record/snapshot_file.hpp>
#include <drawpoint/engine/world/state_hash.hpp>
#include <drawpoint/tests/support/blade_pile.hpp>
#include <memory>

/// The heap of blade_pile.hpp with its blade driven to and fro, and in mid-run put into a snapshot file,
/// thrown away, built anew and read back: the run whose state is compared bit for bit between numbers of
/// threads, builds and runs.
namespace drawpoint::support {

class DugPile {
 public:
  static constexpr long stroke = 250;  ///< steps between two turns of the blade

  DugPile(int rocks, const engine::WorldOptions& options, const engine::Material& material = BladePile::stone)
      : rocks_(rocks), options_(options), material_(material), pile_(built()) {}

  void run(long steps) {
    for (const long end = step_ + steps; step_ < end; ++step_) {
      pile_->blade().set_motor(0, step_ / stroke % 2 == 0 ? 0.6 : -0.6);
      pile_->run(1);
    }
  }

  /// Through the file, which is removed afterwards, into a pile that knows nothing of this one.
  void restart(const std::filesystem::path& file) {
    engine::record::write_snapshot(file, pile_->world().save());
    pile_ = built();
    pile_->world().restore(engine::record::read_snapshot(file));
    std::filesystem::remove(file);
  }

  long step() const { return step_; }
  std::uint64_t hash() const { return engine::state_hash(pile_->world()); }
  const engine::StepReport& report() const { return pile_->report(); }

 private:
  std::unique_ptr<BladePile> built() const {
    return std::make_unique<BladePile>(rocks_, options_, 7, material_);
  }

  int rocks_;
  engine::WorldOptions options_;
  engine::Material material_;
  std::unique_ptr<BladePile> pile_;
  long step_ = 0;
};

}  // namespace drawpoint::support
