// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <cstdint>
#include <drawpoint/engine/contact/hand_over.hpp>
#include <drawpoint/engine/contact/stage_team.hpp>
#include <thread>

namespace drawpoint::engine::contact::detail {
namespace {

// Spins this often before it lets other threads of the machine run.
constexpr int spins_before_yield = 2000;

}  // namespace

struct StageTeam::Impl {
  explicit Impl(int threads) : arena(threads) {
    hand_over.begin();
    for (int k = 1; k < threads; ++k)
      arena.execute([this] { group.run([this] { hand_over.task([this] { help(); }); }); });
  }

  ~Impl() {
    stop.store(true, std::memory_order_release);
    stage.fetch_add(1, std::memory_order_release);
    arena.execute([this] { group.wait(); });
    hand_over.end();
  }

  // A claim is the stage's number and the blocks left in one word: a helper that comes late cannot claim a
  // block of a stage that is over, and while it holds one the stage cannot end.
  static std::uint64_t claim_of(std::uint32_t stage_number, std::uint32_t left) {
    return std::uint64_t{stage_number} << 32 | left;
  }

  // Works on the stage until no block is left to claim.
  void work_on(std::uint32_t number) {
    std::uint64_t seen = claim.load(std::memory_order_acquire);
    while (static_cast<std::uint32_t>(seen >> 32) == number) {
      const auto left = static_cast<std::uint32_t>(seen);
      if (left == 0) return;
      if (!claim.compare_exchange_weak(seen, claim_of(number, left - 1), std::memory_order_acq_rel)) continue;
      (*work.load(std::memory_order_relaxed))(static_cast<int>(left) - 1);
      done.fetch_add(1, std::memory_order_acq_rel);
      seen = claim.load(std::memory_order_acquire);
    }
  }

  void help() {
    std::uint32_t last = 0;
    int spins = 0;
    while (!stop.load(std::memory_order_acquire)) {
      const std::uint32_t now = stage.load(std::memory_order_acquire);
      if (now != last) {
        work_on(now);
        last = now;
        spins = 0;
      } else if (++spins > spins_before_yield) {
        std::this_thread::yield();
      }
    }
  }

  void run(int count, const std::function<void(int)>& f) {
    const std::uint32_t number = stage.load(std::memory_order_relaxed) + 1;
    done.store(0, std::memory_order_relaxed);
    work.store(&f, std::memory_order_relaxed);
    claim.store(claim_of(number, static_cast<std::uint32_t>(count)), std::memory_order_release);
    stage.store(number, std::memory_order_release);
    work_on(number);
    for (int spins = 0; done.load(std::memory_order_acquire) < count;)
      if (++spins > spins_before_yield) std::this_thread::yield();
  }

  HandOver hand_over;
  oneapi::tbb::task_arena arena;
  oneapi::tbb::task_group group;
  std::atomic<bool> stop{false};
  std::atomic<std::uint32_t> stage{0};
  std::atomic<std::uint64_t> claim{0};
  std::atomic<int> done{0};
  std::atomic<const std::function<void(int)>*> work{nullptr};
};

StageTeam::StageTeam(int threads) {
  if (threads > 1) impl_ = std::make_unique<Impl>(threads);
}
StageTeam::~StageTeam() = default;

void StageTeam::run(int blocks, const std::function<void(int)>& work) {
  if (impl_ && blocks > 1) {
    impl_->run(blocks, work);
    return;
  }
  for (int block = 0; block < blocks; ++block) work(block);
}

}  // namespace drawpoint::engine::contact::detail
