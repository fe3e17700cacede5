// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/frames/png.h>

#include <cstdint>

namespace drawpoint::studies {
namespace {

constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
constexpr std::size_t around_data = 12;  // of a chunk: length, type, check sum [byte]

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

/// Takes the first chunk off and returns its type; empty where the bytes end within it.
std::string_view taken_chunk(std::string_view& bytes) {
  if (bytes.size() < around_data) return {};
  const std::size_t size = around_data + std::size_t{big_endian(bytes)};
  if (bytes.size() < size) return {};
  const std::string_view type = bytes.substr(4, 4);
  bytes.remove_prefix(size);
  return type;
}

}  // namespace

std::string png_complaint(std::string_view bytes, const FrameSize& size) {
  if (!bytes.starts_with(signature)) return "it is no PNG file";
  bytes.remove_prefix(signature.size());
  const std::string_view header = bytes;
  if (taken_chunk(bytes) != "IHDR" || big_endian(header) != 13) return "its header is not whole";
  const auto width = big_endian(header.substr(8)), height = big_endian(header.substr(12));
  if (width != static_cast<std::uint32_t>(size.width) || height != static_cast<std::uint32_t>(size.height))
    return "it has " + std::to_string(width) + "x" + std::to_string(height) + " pixels, not " +
           std::to_string(size.width) + "x" + std::to_string(size.height);
  std::string_view type = "IHDR";
  while (!bytes.empty() && type != "IEND") {
    type = taken_chunk(bytes);
    if (type.empty()) return "it ends early";
  }
  if (type != "IEND") return "it ends early";
  return bytes.empty() ? "" : "bytes follow its end";
}

}  // namespace drawpoint::studies
