// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Frames as they are taken and kept: whole pictures, in order, in a folder without others.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/say/frames/frame_files.h>
#include <drawpoint/studies/say/frames/frame_inbox.h>
#include <drawpoint/studies/say/frames/png.h>
#include <drawpoint/studies/say/frames/programs.h>
#include <drawpoint/studies/say/frames/scratch.h>
#include <drawpoint/tests/support/png_bytes.hpp>

#include <chrono>
#include <map>

using namespace drawpoint;
using namespace drawpoint::studies;
using support::png_bytes;

namespace {

constexpr std::chrono::milliseconds at_once(0);

TEST(Png, IsWholeOrNot) {
  const FrameSize size{300, 20};
  const std::string whole = png_bytes(300, 20);
  EXPECT_EQ(png_complaint(whole, size), "");
  EXPECT_EQ(png_complaint(png_bytes(20, 300), size), "it has 20x300 pixels, not 300x20");
  EXPECT_EQ(png_complaint(whole + "x", size), "bytes follow its end");
  EXPECT_EQ(png_complaint("GIF89a", size), "it is no PNG file");
  for (std::size_t kept = 0; kept < whole.size(); ++kept)
    EXPECT_NE(png_complaint(whole.substr(0, kept), size), "") << kept << " bytes of it";
  EXPECT_EQ(png_complaint(whole.substr(0, whole.size() - 12), size), "it ends early") << "a chunk is missing";
}

TEST(Png, LengthsThatLeadBeyondTheEndAreNoHarm) {
  std::string bytes = png_bytes(300, 20);
  for (std::size_t k = 33; k < 37; ++k) bytes[k] = '\xff';  // length of the second chunk
  EXPECT_EQ(png_complaint(bytes, {300, 20}), "it ends early");
}

class Inbox : public testing::Test {
 protected:
  std::map<std::size_t, std::string> kept_;
  FrameInbox inbox_{3, {2, 1}, [this](std::size_t number, std::string_view png) { kept_[number] = png; }};
  const std::string frame_ = png_bytes(2, 1);
};

TEST_F(Inbox, KeepsFramesInOrder) {
  EXPECT_EQ(inbox_.wait(0, at_once), 0u);
  for (std::size_t k = 1; k <= 3; ++k) EXPECT_EQ(inbox_.take(k, png_bytes(2, 1, std::to_string(k))), "");
  EXPECT_EQ(inbox_.wait(0, std::chrono::hours(1)), 3u);
  EXPECT_EQ(kept_.at(2), png_bytes(2, 1, "2"));
  EXPECT_EQ(inbox_.take(4, frame_), "frame 4 of 3 came after frame 3");
}

TEST_F(Inbox, TheFirstThingWrongEndsTheWork) {
  EXPECT_EQ(inbox_.take(1, frame_), "");
  EXPECT_EQ(inbox_.take(3, frame_), "frame 3 of 3 came after frame 1");
  EXPECT_EQ(inbox_.take(2, frame_), "no more frames are taken");
  EXPECT_EQ(test::complaint([&] { inbox_.wait(0, at_once); }), "replay: frame 3 of 3 came after frame 1");
  EXPECT_EQ(kept_.size(), 1u);
}

TEST_F(Inbox, WhatIsNotWholeIsNotKept) {
  EXPECT_EQ(inbox_.take(1, "junk"), "frame 1 is not whole: it is no PNG file");
  EXPECT_TRUE(kept_.empty());
}

TEST_F(Inbox, AFrameThatComesTooLateIsNotKept) {
  inbox_.close();
  EXPECT_EQ(inbox_.take(1, frame_), "no more frames are taken");
  EXPECT_TRUE(kept_.empty());
}

TEST(InboxOnAFullDisk, SaysWhatTheDiskSays) {
  FrameInbox inbox(1, {2, 1},
                   [](std::size_t, std::string_view) { throw std::runtime_error("no space left"); });
  EXPECT_EQ(inbox.take(1, png_bytes(2, 1)), "no space left");
  EXPECT_EQ(test::complaint([&] { inbox.wait(0, at_once); }), "replay: no space left");
}

TEST(FrameFolder, IsMadeAndHoldsNoOtherFrames) {
  const test::TestFolder place;
  const auto folder = place / "a" / "b";
  prepare_frame_folder(folder);
  test::write_file(folder / "notes.txt", "mine");
  EXPECT_NO_THROW(prepare_frame_folder(folder)) << "no frames";
  test::write_file(folder / frame_name(41), "");
  EXPECT_EQ(test::complaint([&] { prepare_frame_folder(folder); }),
            "--frames: " + folder.string() +
                " holds frames already (1 files frame_*.png); name another folder, or remove them");
  EXPECT_THROW(prepare_frame_folder(folder / "notes.txt"), UsageError);
  EXPECT_THROW(prepare_frame_folder(folder / "notes.txt" / "c"), std::runtime_error);
  EXPECT_EQ(frame_name(41), "frame_000041.png");
}

TEST(ScratchFolder, GoesAwayWithAllThatIsInIt) {
  std::filesystem::path path;
  {
    const Scratch scratch;
    path = scratch.path();
    EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms::owner_all) << "ours alone";
    std::filesystem::create_directories(path / "profile" / "a b");
    test::write_file(path / "profile" / "a b" / "-c", "x");
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(LastWords, AreTheLastLines) {
  const test::TestFolder place;
  EXPECT_EQ(last_words(place / "none"), "it printed nothing");
  test::write_file(place / "out", "1\n2\n3\n\n4\n5\nERROR:dbus/bus.cc: none\n6\n7");
  EXPECT_EQ(last_words(place / "out"), "it printed last:\n  3\n  4\n  5\n  6\n  7");
}

}  // namespace
