// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: a snapshot's bytes, however damaged, are refused with std::runtime_error or give a world
// that can be stepped, with all its numbers finite.
//
// Two layers are fuzzed, by the first byte of the input. Even: the file, as it is, which mostly ends at the
// checksum. Odd: the state behind it; the custom mutator puts the checksum of the contact finder's part right
// after each mutation, so that what is mutated is the meaning and not the sum.
#include <cstring>
#include <drawpoint/engine/record/snapshot_file.hpp>
#include <drawpoint/engine/world/state_hash.hpp>
#include <drawpoint/tests/fuzz/small_world.hpp>

using namespace drawpoint;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

std::span<const std::byte> as_bytes(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const std::byte*>(data), size};
}

void require_finite(const engine::World& world) {
  for (const engine::Rock& rock : world.rocks())
    if (rock.present &&
        !(rock.pose.matrix().allFinite() && rock.velocity.allFinite() && rock.angular_velocity.allFinite()))
      __builtin_trap();
}

// One world serves all inputs: each restore must replace whatever the one before left.
void restore_and_step(std::span<const std::byte> state) {
  static const std::unique_ptr<engine::World> world = fuzz::small_world();
  const std::uint64_t before = engine::state_hash(*world);
  try {
    world->restore(state);
  } catch (const std::runtime_error&) {
    if (engine::state_hash(*world) != before) __builtin_trap();
    return;
  }
  try {
    for (int k = 0; k < 2; ++k) world->step();
  } catch (const engine::SolutionBroken&) {
  }
  require_finite(*world);
}

// The finder's part is the last, with its FNV-1a sum in the last 8 bytes and its length before it.
void mend_checksum(std::uint8_t* state, std::size_t size) {
  constexpr std::uint64_t finder_mark_prefix = 0x444e46435044;  // "DPCFND"
  for (std::size_t at = 8; at + 16 <= size; ++at) {
    std::uint64_t word = 0;
    std::memcpy(&word, state + at, sizeof word);
    if ((word & 0xffffffffffff) != finder_mark_prefix) continue;
    const std::uint64_t length = size - at;
    std::memcpy(state + at - 8, &length, sizeof length);
    std::uint64_t sum = 0xcbf29ce484222325ull;
    for (std::size_t k = at; k < size - 8; ++k) sum = (sum ^ state[k]) * 0x100000001b3ull;
    std::memcpy(state + size - 8, &sum, sizeof sum);
    return;
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned) {
  size = LLVMFuzzerMutate(data, size, max_size);
  if (size > 1 && data[0] % 2 == 1) mend_checksum(data + 1, size - 1);
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto rest = as_bytes(data + 1, size - 1);
  if (data[0] % 2 == 1) {
    restore_and_step(rest);
    return 0;
  }
  try {
    restore_and_step(engine::record::detail::unwrapped_snapshot(rest, "input"));
  } catch (const std::runtime_error&) {
  }
  return 0;
}
