// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What makes a PNG file whole (ISO/IEC 15948): signature, header with the size, chunks whose lengths lead
/// from one to the next, IEND at the end. Check sums are not looked at.

#include <string>
#include <string_view>

namespace drawpoint::studies {

struct FrameSize {
  int width = 1280, height = 720;  ///< [pixel]
};

/// What is wrong with the bytes of a picture of this size, or "".
std::string png_complaint(std::string_view bytes, const FrameSize& size);

}  // namespace drawpoint::studies
