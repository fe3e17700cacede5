// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The libFuzzer target of one reader, DRAWPOINT_READER.
#include <drawpoint/tests/fuzz/readers.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  drawpoint::fuzz::DRAWPOINT_READER({data, size});
  return 0;
}
