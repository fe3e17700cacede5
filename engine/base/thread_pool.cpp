// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace drawpoint::engine {
namespace {

// Spins this often before it lets other threads of the machine run.
constexpr int spins_before_yield = 2000;
constexpr int most_threads = 256;

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

struct ThreadPool::Workers {
  using Work = std::function<void(int block, int thread)>;

  explicit Workers(int threads) : shares(static_cast<std::size_t>(threads)) {
    try {
      for (int k = 1; k < threads; ++k) workers.emplace_back([this, k] { serve(k); });
    } catch (...) {
      close();
      throw;
    }
  }
  ~Workers() { close(); }

  void close() {
    closing.store(true, std::memory_order_relaxed);
    wake();
    for (std::thread& worker : workers) worker.join();
  }

  void wake() {
    region.fetch_add(1, std::memory_order_release);
    region.notify_all();
  }

  void begin_region() {
    if (regions++ > 0) return;
    open.store(true, std::memory_order_relaxed);
    wake();
  }

  void end_region() {
    if (--regions == 0) open.store(false, std::memory_order_relaxed);
  }

  // Sleeps from region to region.
  void serve(int thread) {
    std::uint32_t seen = 0;
    for (;;) {
      region.wait(seen, std::memory_order_acquire);
      seen = region.load(std::memory_order_acquire);
      if (closing.load(std::memory_order_relaxed)) return;
      work_in_region(thread);
    }
  }

  // Loop after loop. A worker that comes late finds nothing left to claim.
  void work_in_region(int thread) {
    std::uint32_t last = 0;
    int spins = 0;
    while (open.load(std::memory_order_relaxed)) {
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

  int regions = 0;            // open, one within the other
  std::vector<Share> shares;  // by thread
  std::atomic<bool> open{false}, closing{false};
  std::atomic<std::uint32_t> region{0}, loop{0};  // the last one that was begun
  std::atomic<int> done{0}, members{0};           // blocks; threads that take part
  std::atomic<const Work*> work{nullptr};
  std::mutex failing;
  int failed = 0;            // the first block of those that have thrown
  std::exception_ptr error;  // what it threw
  std::vector<std::thread> workers;
};

ThreadPool::ThreadPool(int threads) : threads_(threads) {
  if (threads < 1 || threads > most_threads)
    throw std::invalid_argument("engine::ThreadPool: threads is " + std::to_string(threads) +
                                "; allowed: 1 to " + std::to_string(most_threads));
  if (threads > 1) workers_ = std::make_unique<Workers>(threads);
}
ThreadPool::~ThreadPool() = default;

ThreadPool::Region::Region(const ThreadPool& pool) : pool_(pool) {
  if (pool_.workers_) pool_.workers_->begin_region();
}
ThreadPool::Region::~Region() {
  if (pool_.workers_) pool_.workers_->end_region();
}

void ThreadPool::run(int blocks, int threads, const std::function<void(int)>& work) const {
  if (!workers_ || threads == 1 || blocks <= 1) {
    for (int block = 0; block < blocks; ++block) work(block);
    return;
  }
  const Region region(*this);
  workers_->run(blocks, std::min(threads, threads_), [&](int block, int) { work(block); });
}

void ThreadPool::blocks(int count, int block, const std::function<void(int, int)>& work) const {
  blocks_by_thread(count, block, [&](int begin, int end, int) { work(begin, end); });
}

void ThreadPool::blocks_by_thread(int count, int block,
                                  const std::function<void(int, int, int)>& work) const {
  if (!workers_ || count <= block) {
    if (count > 0) work(0, count, 0);
    return;
  }
  const Region region(*this);
  workers_->run((count + block - 1) / block, threads_,
                [&](int k, int thread) { work(k * block, std::min(count, (k + 1) * block), thread); });
}

}  // namespace drawpoint::engine
