// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The answers of the live page's server: a page, its state, and single runs. Nothing else of the disk can be
/// asked for: what a question names is a number of a run, never a file.

#include <drawpoint/studies/say/live/follower.h>
#include <drawpoint/studies/say/live/state.h>

#include <cstdint>
#include <mutex>
#include <string>

namespace drawpoint::studies {

struct Answer {
  int status = 200;
  std::string type;  ///< MIME
  std::string body;
};

/// May be asked by several threads.
class Site {
 public:
  /// Throws as Follower does. The study must outlive it.
  explicit Site(Followed followed);

  /// The page; its scripts have the nonce that the policy of the answer names.
  Answer page(const std::string& nonce) const;
  Answer state(const Kept& kept);
  /// {run, illustrations, cautions}: of a run's log, but for scenes; 404 with {error} where there are none.
  Answer figures(std::int64_t run);
  /// The page of one run, as the command replay writes it; 404 with the reason where there is none.
  Answer replay(std::int64_t run);

  /// How the study stands, for the terminal.
  std::string standing();

 private:
  Followed followed_;
  Follower follower_;
  std::mutex logs_;  ///< one log is read at a time
};

}  // namespace drawpoint::studies
