// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <cstdint>
#include <drawpoint/engine/contact/hand_over.hpp>
#include <drawpoint/engine/contact/stage_team.hpp>
#include <thread>
#include <vector>

namespace drawpoint::engine::contact::detail {
namespace {

// Spins this often before it lets other threads of the machine run.
constexpr int spins_before_yield = 2000;

// The blocks of one thread that are still to be claimed, on a cache line of its own.
struct alignas(64) Share {
  // The stage's number and the blocks left in one word: a thread that comes late cannot claim a block of a
  // stage that is over, and while it holds one the stage cannot end.
  std::atomic<std::uint64_t> claim{0};
  int end = 0;

  static std::uint64_t word(std::uint32_t stage, std::uint32_t left) {
    return std::uint64_t{stage} << 32 | left;
  }

  void offer(std::uint32_t stage, int first, int last) {
    end = last;
    claim.store(word(stage, static_cast<std::uint32_t>(last - first)), std::memory_order_release);
  }

  // The next block, in ascending order; -1 when none is left or the stage is over.
  int take(std::uint32_t stage) {
    std::uint64_t seen = claim.load(std::memory_order_acquire);
    for (;;) {
      const auto left = static_cast<std::uint32_t>(seen);
      if (static_cast<std::uint32_t>(seen >> 32) != stage || left == 0) return -1;
      if (claim.compare_exchange_weak(seen, word(stage, left - 1), std::memory_order_acq_rel))
        return end - static_cast<int>(left);
    }
  }
};

}  // namespace

struct StageTeam::Impl {
  explicit Impl(int count) : threads(count), shares(static_cast<std::size_t>(count)), arena(count) {
    hand_over.begin();
    for (int k = 1; k < threads; ++k)
      arena.execute([this, k] { group.run([this, k] { hand_over.task([this, k] { help(k); }); }); });
  }

  ~Impl() {
    stop.store(true, std::memory_order_release);
    stage.fetch_add(1, std::memory_order_release);
    arena.execute([this] { group.wait(); });
    hand_over.end();
  }

  // Works on the stage until no block is left to claim: its own share first, then what others have left.
  void work_on(int thread, std::uint32_t number) {
    int worked = 0;
    for (int k = 0; k < threads; ++k) {
      Share& share = shares[static_cast<std::size_t>((thread + k) % threads)];
      for (int block = share.take(number); block >= 0; block = share.take(number), ++worked)
        (*work.load(std::memory_order_relaxed))(block);
    }
    if (worked > 0) done.fetch_add(worked, std::memory_order_acq_rel);
  }

  void help(int thread) {
    std::uint32_t last = 0;
    int spins = 0;
    while (!stop.load(std::memory_order_acquire)) {
      const std::uint32_t now = stage.load(std::memory_order_acquire);
      if (now != last) {
        work_on(thread, now);
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
    for (int k = 0; k < threads; ++k)
      shares[static_cast<std::size_t>(k)].offer(number, count * k / threads, count * (k + 1) / threads);
    stage.store(number, std::memory_order_release);
    work_on(0, number);
    for (int spins = 0; done.load(std::memory_order_acquire) < count;)
      if (++spins > spins_before_yield) std::this_thread::yield();
  }

  int threads;
  std::vector<Share> shares;
  HandOver hand_over;
  oneapi::tbb::task_arena arena;
  oneapi::tbb::task_group group;
  std::atomic<bool> stop{false};
  std::atomic<std::uint32_t> stage{0};
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
