// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/say/live/follower.h>
#include <sys/stat.h>

#include <algorithm>
#include <ctime>
#include <random>
#include <tuple>
#include <utility>

namespace drawpoint::studies {
namespace {

using Clock = std::chrono::steady_clock;

/// A file whose last change is younger may change once more without another time of change [s].
constexpr std::time_t certain_after = 2;

/// What tells one state of a file from another; empty where there is no file.
std::string signature_of(const std::filesystem::path& file) {
  struct stat status = {};
  if (stat(file.c_str(), &status) != 0) return "";
  std::string text;
  for (const std::uintmax_t value :
       {std::uintmax_t{status.st_dev}, std::uintmax_t{status.st_ino}, std::uintmax_t(status.st_size),
        std::uintmax_t(status.st_mtim.tv_sec), std::uintmax_t(status.st_mtim.tv_nsec)})
    text += std::to_string(value) + " ";
  const bool young = std::time(nullptr) - status.st_mtim.tv_sec < certain_after;
  return text + (young ? "young" : "");
}

/// Whether all that had ended has, as it had.
bool goes_on(const Contents& now, const Contents& before) {
  return now.identity.seed == before.identity.seed && now.identity.options == before.identity.options &&
         std::all_of(before.ended.begin(), before.ended.end(), [&](std::size_t i) {
           return i < now.runs.size() && now.runs[i].status == before.runs[i].status &&
                  now.runs[i].finished == before.runs[i].finished && now.runs[i].x == before.runs[i].x;
         });
}

std::uint64_t new_epoch() { return std::random_device{}(); }

}  // namespace

void order_ends(Contents& now, const Contents* before) {
  const bool on = before != nullptr && goes_on(now, *before);
  now.epoch = on ? before->epoch : new_epoch();
  if (on) now.ended = before->ended;
  std::vector<bool> known(now.runs.size(), false);
  for (const std::size_t i : now.ended) known[i] = true;
  const std::size_t old = now.ended.size();
  for (std::size_t i = 0; i < now.runs.size(); ++i)
    if (has_ended(now.runs[i]) && !known[i]) now.ended.push_back(i);
  std::sort(now.ended.begin() + static_cast<std::ptrdiff_t>(old), now.ended.end(),
            [&](std::size_t a, std::size_t b) {
              return std::tie(now.runs[a].finished, a) < std::tie(now.runs[b].finished, b);
            });
}

Follower::Follower(const Study& study, Folder folder, double share)
    : study_(study), folder_(std::move(folder)), share_(share) {
  if (!std::filesystem::exists(folder_.store())) return;
  try {
    read();
  } catch (const StoreBusy& e) {
    view_.trouble = e.what();
  }
}

View Follower::look() {
  const std::lock_guard lock(mutex_);
  const std::string signature = signature_of(folder_.store());
  view_.there = !signature.empty();
  view_.holder = holder_of(folder_);
  if (!view_.there) {
    view_.contents = nullptr;
    view_.trouble.clear();
    seen_.clear();
    return view_;
  }
  if (signature == seen_ || (view_.contents && Clock::now() < rests_until_)) return view_;
  seen_.clear();
  try {
    read();
    view_.trouble.clear();
    if (!signature.ends_with("young")) seen_ = signature;
  } catch (const std::exception& e) {
    view_.trouble = e.what();
  }
  return view_;
}

void Follower::read() {
  const Clock::time_point begin = Clock::now();
  const Store store = open_store(study_, folder_, Access::read);
  auto contents = std::make_shared<Contents>(
      Contents{.identity = store.identity(), .sampling = store.sampling(), .runs = store.runs()});
  order_ends(*contents, view_.contents.get());
  view_.contents = std::move(contents);
  const Clock::time_point end = Clock::now();
  rests_until_ = end + std::chrono::duration_cast<Clock::duration>((end - begin) * (1.0 / share_ - 1.0));
}

}  // namespace drawpoint::studies
