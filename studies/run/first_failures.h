// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether the first runs of a study all fail in one way: then the program is wrong and not the point, and the
/// rest would fail too.

#include <string>

namespace drawpoint::studies {

class FirstFailures {
 public:
  /// So many are the first few.
  static constexpr int few = 5;

  /// `off`: there are runs that were done, or whoever asks goes on anyway.
  explicit FirstFailures(bool off) : off_(off) {}

  void done() { off_ = true; }
  void failed(const std::string& reason);
  bool all_alike() const { return !off_ && count_ >= few; }
  const std::string& reason() const { return reason_; }

 private:
  bool off_;
  int count_ = 0;
  std::string reason_, shape_;
};

}  // namespace drawpoint::studies
