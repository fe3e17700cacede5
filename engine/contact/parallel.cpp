// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <drawpoint/engine/contact/hand_over.hpp>
#include <drawpoint/engine/contact/parallel.hpp>
#include <vector>

namespace drawpoint::engine::contact::detail {

struct Parallel::Arena {
  explicit Arena(int threads)
      : allowed(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena(threads),
        places(static_cast<std::size_t>(threads)) {}
  tbb::global_control allowed;
  tbb::task_arena arena;
  HandOver loop;
  std::vector<HandOver> places;  // of threads; one thread after another may take a place
};

Parallel::Parallel(int threads) : threads_(threads) {
  if (threads > 1) arena_ = std::make_unique<Arena>(threads);
}
Parallel::~Parallel() = default;
Parallel::Parallel(Parallel&&) noexcept = default;
Parallel& Parallel::operator=(Parallel&&) noexcept = default;

void Parallel::blocks(int count, int block, const std::function<void(int, int)>& work) const {
  blocks_by_thread(count, block, [&](int begin, int end, int) { work(begin, end); });
}

void Parallel::blocks_by_thread(int count, int block, const std::function<void(int, int, int)>& work) const {
  if (!arena_ || count <= block) {
    if (count > 0) work(0, count, 0);
    return;
  }
  const auto do_block = [&](int k) {
    const int thread = tbb::this_task_arena::current_thread_index();
    arena_->loop.task([&] {
      arena_->places[static_cast<std::size_t>(thread)].in_turn(
          [&] { work(k * block, std::min(count, (k + 1) * block), thread); });
    });
  };
  arena_->loop.begin();
  arena_->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, (count + block - 1) / block, 1),
        [&](const tbb::blocked_range<int>& range) {
          for (int k = range.begin(); k < range.end(); ++k) do_block(k);
        },
        tbb::simple_partitioner());
  });
  arena_->loop.end();
}

}  // namespace drawpoint::engine::contact::detail
