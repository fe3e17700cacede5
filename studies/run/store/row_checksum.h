// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a row of the store is checked by: 64-bit FNV-1a over all that a run is, numbers bit for bit.

#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/doe/detail/hash.hpp>

#include <bit>
#include <cstdint>
#include <string>

namespace drawpoint::studies::detail {

class RowText {
 public:
  RowText& operator<<(const std::string& text) {
    text_ += std::to_string(text.size()) + ":" + text;
    return *this;
  }
  RowText& operator<<(double value) { return *this << std::to_string(std::bit_cast<std::uint64_t>(value)); }
  RowText& operator<<(const Eigen::VectorXd& values) {
    for (const double value : values) *this << value;
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

inline std::string row_checksum(const Run& run) {
  RowText row;
  row << std::to_string(run.id) << name_of(run.kind) << std::to_string(run.point)
      << std::to_string(run.replicate) << std::to_string(run.seed) << name_of(run.status) << run.reason
      << run.seconds << run.started << run.finished << run.log << run.x << run.y << run.predicted << run.lower
      << run.upper;
  return doe::detail::checksum(row.text());
}

}  // namespace drawpoint::studies::detail
