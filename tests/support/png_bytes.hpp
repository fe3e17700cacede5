// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The least that is a PNG file to who looks at its structure alone: check sums are zero, the pixels none.

#include <cstdint>
#include <string>

namespace drawpoint::support {

inline std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 255u);
  return bytes;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(0);
}

inline std::string png_bytes(std::uint32_t width, std::uint32_t height,
                             const std::string& pixels = "pixels") {
  const std::string header = big_endian(width) + big_endian(height) + std::string("\x08\x02\0\0\0", 5);
  return std::string("\x89PNG\r\n\x1a\n", 8) + png_chunk("IHDR", header) + png_chunk("IDAT", pixels) +
         png_chunk("IEND", "");
}

}  // namespace drawpoint::support
