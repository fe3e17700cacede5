// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <drawpoint/engine/base/publish.h>
#include <drawpoint/engine/base/thread_pool.h>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace drawpoint::engine::detail {
namespace {

// Spins this often before it lets other threads of the machine run.
constexpr int spins_before_yield = 2000;

// The blocks of one thread that are still to be claimed, on a cache line of its own.
struct alignas(64) Share {
  // The loop's number and the blocks left in one word: a thread that comes late cannot claim a block of a
  // loop that is over, and while it holds one the loop cannot end.
  std::atomic<std::uint64_t> claim{0};
  int end = 0;

  static std::uint64_t word(std::uint32_t loop, std::uint32_t left) {
    return std::uint64_t{loop} << 32 | left;
  }

  void offer(std::uint32_t loop, int first, int last) {
    end = last;
    claim.store(word(loop, static_cast<std::uint32_t>(last - first)), std::memory_order_release);
  }

  // The next block, in ascending order; -1 when none is left or the loop is over.
  int take(std::uint32_t loop) {
    std::uint64_t seen = claim.load(std::memory_order_acquire);
    for (;;) {
      const auto left = static_cast<std::uint32_t>(seen);
      if (static_cast<std::uint32_t>(seen >> 32) != loop || left == 0) return -1;
      if (claim.compare_exchange_weak(seen, word(loop, left - 1), std::memory_order_acq_rel))
        return end - static_cast<int>(left);
    }
  }
};

}  // namespace

struct Parallel::Team {
  using Work = std::function<void(int block, int thread)>;

  explicit Team(int threads)
      : allowed(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena(threads),
        shares(static_cast<std::size_t>(threads)) {}

  void gather() {
    if (shifts++ > 0) return;
    stop.store(false, std::memory_order_relaxed);
    const std::uint32_t now = loop.load(std::memory_order_relaxed);
    hand_over.begin();
    try {
      for (int k = 1; k < static_cast<int>(shares.size()); ++k)
        arena.execute([this, k, now] { start_helper(k, now); });
    } catch (...) {
      dismiss();
      throw;
    }
  }

  void dismiss() {
    if (--shifts > 0) return;
    stop.store(true, std::memory_order_release);
    arena.execute([this] { group.wait(); });
    hand_over.end();
  }

  void start_helper(int thread, std::uint32_t last) {
    group.run([this, thread, last] { hand_over.task([&] { help(thread, last); }); });
  }

  // Loop after loop, from the one after `last`.
  void help(int thread, std::uint32_t last) {
    int spins = 0;
    while (!stop.load(std::memory_order_acquire)) {
      const std::uint32_t now = loop.load(std::memory_order_acquire);
      if (now != last) {
        if (thread < members.load(std::memory_order_relaxed)) work_on(thread, now);
        last = now;
        spins = 0;
      } else if (++spins > spins_before_yield) {
        std::this_thread::yield();
      }
    }
  }

  // Works on the loop until no block is left to claim: its own share first, then what others have left.
  void work_on(int thread, std::uint32_t number) {
    const int count = members.load(std::memory_order_relaxed);
    int worked = 0;
    for (int k = 0; k < count; ++k) {
      Share& share = shares[static_cast<std::size_t>((thread + k) % count)];
      for (int block = share.take(number); block >= 0; block = share.take(number), ++worked)
        do_block(block, thread);
    }
    if (worked > 0) done.fetch_add(worked, std::memory_order_acq_rel);
  }

  void do_block(int block, int thread) {
    try {
      (*work.load(std::memory_order_relaxed))(block, thread);
    } catch (...) {
      const std::scoped_lock lock(failing);
      if (!error || block < failed) failed = block, error = std::current_exception();
    }
  }

  static int share_of(int thread, int threads, int blocks) {
    return static_cast<int>(std::int64_t{blocks} * thread / threads);
  }

  void run(int blocks, int threads, const Work& f) {
    const std::uint32_t number = loop.load(std::memory_order_relaxed) + 1;
    done.store(0, std::memory_order_relaxed);
    work.store(&f, std::memory_order_relaxed);
    members.store(threads, std::memory_order_relaxed);
    for (int k = 0; k < threads; ++k)
      shares[static_cast<std::size_t>(k)].offer(number, share_of(k, threads, blocks),
                                                share_of(k + 1, threads, blocks));
    loop.store(number, std::memory_order_release);
    work_on(0, number);
    for (int spins = 0; done.load(std::memory_order_acquire) < blocks;)
      if (++spins > spins_before_yield) std::this_thread::yield();
    if (error) std::rethrow_exception(std::exchange(error, {}));
  }

  tbb::global_control allowed;
  tbb::task_arena arena;
  tbb::task_group group;
  HandOver hand_over;
  int shifts = 0;
  std::vector<Share> shares;  // by thread
  std::atomic<bool> stop{false};
  std::atomic<std::uint32_t> loop{0};
  std::atomic<int> done{0}, members{0};  // blocks; threads that take part
  std::atomic<const Work*> work{nullptr};
  std::mutex failing;
  int failed = 0;            // the first block of those that have thrown
  std::exception_ptr error;  // what it threw
};

Parallel::Parallel(int threads) : threads_(threads) {
  if (threads > 1) team_ = std::make_unique<Team>(threads);
}
Parallel::~Parallel() = default;

Parallel::Shift::Shift(const Parallel& parallel) : parallel_(parallel) {
  if (parallel_.team_) parallel_.team_->gather();
}
Parallel::Shift::~Shift() {
  if (parallel_.team_) parallel_.team_->dismiss();
}

void Parallel::run(int blocks, int threads, const std::function<void(int)>& work) const {
  if (!team_ || threads == 1 || blocks <= 1) {
    for (int block = 0; block < blocks; ++block) work(block);
    return;
  }
  const Shift shift(*this);
  team_->run(blocks, std::min(threads, threads_), [&](int block, int) { work(block); });
}

void Parallel::blocks(int count, int block, const std::function<void(int, int)>& work) const {
  blocks_by_thread(count, block, [&](int begin, int end, int) { work(begin, end); });
}

void Parallel::blocks_by_thread(int count, int block, const std::function<void(int, int, int)>& work) const {
  if (!team_ || count <= block) {
    if (count > 0) work(0, count, 0);
    return;
  }
  const Shift shift(*this);
  team_->run((count + block - 1) / block, threads_,
             [&](int k, int thread) { work(k * block, std::min(count, (k + 1) * block), thread); });
}

}  // namespace drawpoint::engine::detail
