// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/record/trailer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <drawpoint/engine/base/hash.hpp>
#include <fstream>
#include <span>
#include <system_error>

namespace drawpoint::engine::record::detail {
namespace {

struct Trailer {
  std::array<char, 8> mark = {'d', 'r', 'a', 'w', 'p', 'o', 'i', 'n'};
  std::uint64_t length = 0, checksum = 0;  // of all before it
};
static_assert(sizeof(Trailer) == 24);

// The trailer for the next `count` bytes of a stream, or for as many as there are.
Trailer trailer_of(std::istream& in, std::uint64_t count) {
  Trailer trailer;
  Checksum sum;
  std::vector<char> piece(1u << 20);
  while (count > 0 && in) {
    in.read(piece.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(count, piece.size())));
    const auto got = static_cast<std::size_t>(in.gcount());
    sum.add(std::as_bytes(std::span(piece.data(), got)));
    trailer.length += got;
    count -= got;
  }
  trailer.checksum = sum.value();
  return trailer;
}

}  // namespace

void append_trailer(std::vector<std::byte>& image) {
  Trailer trailer;
  trailer.length = image.size();
  trailer.checksum = Checksum::of(image);
  const auto bytes = std::as_bytes(std::span(&trailer, 1));
  image.insert(image.end(), bytes.begin(), bytes.end());
}

std::string trailer_fault(const std::filesystem::path& path) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error) return "cannot be opened: " + error.message() + "; check the path";
  std::ifstream in(path, std::ios::binary);
  if (!in) return "cannot be opened; check the permissions";
  std::array<char, 8> start{};
  in.read(start.data(), start.size());
  if (std::string_view(start.data(), start.size()) != "\x89HDF\r\n\x1a\n")
    return size == 0 ? "is empty; delete it and let it be written anew"
                     : "is not an HDF5 file; give a file that Drawpoint wrote";
  in.clear();
  in.seekg(0);
  const Trailer computed = trailer_of(in, size - std::min<std::uint64_t>(size, sizeof(Trailer)));
  Trailer stored;
  stored.mark = {};
  in.read(reinterpret_cast<char*>(&stored), sizeof(Trailer));
  if (stored.mark != computed.mark)
    return "is truncated, or written by another program; give a file that Drawpoint wrote";
  if (stored.length != computed.length || stored.checksum != computed.checksum)
    return "is damaged: its checksum differs; delete it and let it be written anew";
  return "";
}

}  // namespace drawpoint::engine::record::detail
