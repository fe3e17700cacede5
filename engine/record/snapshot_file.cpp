// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <drawpoint/engine/base/atomic_file.hpp>
#include <drawpoint/engine/base/hash.hpp>
#include <drawpoint/engine/record/snapshot_file.hpp>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace drawpoint::engine::record {
namespace {

static_assert(std::endian::native == std::endian::little, "snapshots are little-endian");

struct Head {
  std::array<char, 8> mark = {'D', 'P', 'S', 'N', 'A', 'P', '\r', '\n'};
  std::uint32_t version = 1, zero = 0;
  std::uint64_t length = 0;
};
static_assert(sizeof(Head) == 24);

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw std::runtime_error("record::read_snapshot: \"" + name + "\" " + what);
}

}  // namespace

namespace detail {

std::vector<std::byte> wrapped_snapshot(std::span<const std::byte> state) {
  Head head;
  head.length = state.size();
  std::vector<std::byte> file(sizeof head + state.size() + sizeof(std::uint64_t));
  std::memcpy(file.data(), &head, sizeof head);
  std::copy(state.begin(), state.end(), file.begin() + sizeof head);
  const std::uint64_t sum = Checksum::of(std::span(file).first(file.size() - sizeof sum));
  std::memcpy(file.data() + file.size() - sizeof sum, &sum, sizeof sum);
  return file;
}

std::span<const std::byte> unwrapped_snapshot(std::span<const std::byte> file, const std::string& name) {
  constexpr const char* save_anew = "; save the state anew";
  Head head;
  const Head expected;
  std::uint64_t sum = 0;
  if (file.size() < sizeof head + sizeof sum)
    fail(name, "has " + std::to_string(file.size()) + " bytes, fewer than any snapshot" + save_anew);
  std::memcpy(&head, file.data(), sizeof head);
  if (head.mark != expected.mark) fail(name, "is no snapshot; give a file that write_snapshot() wrote");
  if (head.version != expected.version)
    fail(name, "has version " + std::to_string(head.version) + " of the snapshot format, not " +
                   std::to_string(expected.version) + save_anew);
  const std::size_t held = file.size() - sizeof head - sizeof sum;
  if (head.length != held)
    fail(name, "holds " + std::to_string(held) + " bytes of state, not the " + std::to_string(head.length) +
                   " that it names: it is cut or was added to" + save_anew);
  std::memcpy(&sum, file.data() + sizeof head + held, sizeof sum);
  if (sum != Checksum::of(file.first(sizeof head + held)))
    fail(name, "is damaged: its checksum differs" + std::string(save_anew));
  return file.subspan(sizeof head, held);
}

}  // namespace detail

void write_snapshot(const std::filesystem::path& path, std::span<const std::byte> state) {
  write_atomically(path, detail::wrapped_snapshot(state));
}

std::vector<std::byte> read_snapshot(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) fail(path.string(), "cannot be opened: " + error.message() + "; check the path");
  std::ifstream in(path, std::ios::binary);
  std::vector<std::byte> file(size);
  in.read(reinterpret_cast<char*>(file.data()), static_cast<std::streamsize>(size));
  if (!in) fail(path.string(), "cannot be read; check the permissions and the disk");
  const std::span<const std::byte> state = detail::unwrapped_snapshot(file, path.string());
  return {state.begin(), state.end()};
}

}  // namespace drawpoint::engine::record
