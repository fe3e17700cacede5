// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The frames of a run as a user asks for them, drawn by the Chromium of this machine: a red box that goes
/// along a floor (troubled_study.cpp).

#include <drawpoint/tests/end_to_end/support.hpp>

#include <algorithm>
#include <sstream>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string study = "env TROUBLE=filmed " TROUBLED_STUDY;
const std::string small = " --size 320x180";

class Frames : public StudyTest {
 protected:
  Frames() {
    EXPECT_EQ(run(study + " --runs 12 --validation 0" + out()).code, 0);
    id_ = query("SELECT id FROM runs WHERE x <= 0.5 LIMIT 1");
    std::filesystem::create_directories(temporary());
  }
  ~Frames() override { EXPECT_TRUE(std::filesystem::is_empty(temporary())) << "something is left"; }

  /// What the command writes for itself lies here.
  std::filesystem::path temporary() const { return place_ / "temporary"; }
  std::filesystem::path folder(const std::string& name) const { return place_ / name; }
  std::string replay(const std::string& environment = "") const {
    return "env TMPDIR=" + temporary().string() + " " + environment + " " + study.substr(4) +
           " replay --run " + id_ + out();
  }
  std::string frames(const std::string& name) const { return " --frames " + folder(name).string(); }

  /// Of all frames in the folder, in order.
  std::vector<nlohmann::json> facts(const std::string& name) const {
    const Ended told =
        run("sh -c 'exec python3 " PICTURE_FACTS " " + folder(name).string() + "/frame_*.png'");
    EXPECT_EQ(told.code, 0) << told.err;
    std::istringstream lines(told.out);
    std::vector<nlohmann::json> all;
    for (std::string line; std::getline(lines, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }

  /// At most a minute.
  static void await(const std::filesystem::path& file) {
    for (int i = 0; i < 6000 && !std::filesystem::exists(file); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(std::filesystem::exists(file));
  }
  /// That have this folder for temporary files, or one in it.
  static int processes_at(const std::filesystem::path& folder) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc"))
      if (contents(entry.path() / "environ").find("TMPDIR=" + folder.string()) != std::string::npos) ++count;
    return count;
  }

  std::string id_;
};

// The box moves by equal steps, so its middle does, but for perspective: no step is less than half of
// another. It is 1.2 m long and high at 12 m: by the camera's 40 degrees of height a picture is 8.7 m high
// there and 15.5 m wide, so the box has about 1.4 m²/135 m² of it, 1 %.
TEST_F(Frames, ShowTheRunAsItGoesTheSameEachTime) {
  const Ended end = run(replay() + frames("a") + small + " --fps 2");
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.out, folder("a").string() + "\n");
  EXPECT_TRUE(contains(end.err, "5/5 frames"));
  const auto all = facts("a");
  ASSERT_EQ(all.size(), 5u);
  std::vector<double> steps;
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(all[k]["width"], 320);
    EXPECT_EQ(all[k]["height"], 180);
    EXPECT_GT(all[k]["colours"], 10);
    EXPECT_GT(all[k]["red"], 0.005);
    EXPECT_LT(all[k]["red"], 0.05);
    if (k > 0) steps.push_back(all[k]["column"].get<double>() - all[k - 1]["column"].get<double>());
  }
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  EXPECT_GT(*least, 0.5 * *most);
  EXPECT_GT(*least, 5.0) << "pixels";
  EXPECT_FALSE(
      std::filesystem::exists(dir() / ("replay_" + std::string(4 - id_.size(), '0') + id_ + ".html")));

  ASSERT_EQ(run(replay() + frames("b") + small + " --fps 2 --from 1").code, 0);
  const auto again = facts("b");
  ASSERT_EQ(again.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(again[k]["pixels"], all[k + 2]["pixels"]);
  expect_refused(replay() + frames("b") + small, 2, "holds frames already (3 files frame_*.png)");
}

TEST_F(Frames, OneMomentFromTheSideAndFromAbove) {
  std::vector<nlohmann::json> pictures;
  for (const std::string camera : {"side", "above"}) {
    ASSERT_EQ(run(replay() + frames(camera) + small + " --from 1 --to 1 --camera " + camera).code, 0);
    for (const auto& picture : facts(camera)) pictures.push_back(picture);
  }
  ASSERT_EQ(pictures.size(), 2u);
  for (const auto& picture : pictures) EXPECT_GT(picture["red"], 0.005);
  EXPECT_NE(pictures[0]["pixels"], pictures[1]["pixels"]);
}

// The floor passes by, the box stays where it is in the picture.
TEST_F(Frames, TheCameraFollowsTheBox) {
  ASSERT_EQ(run(replay() + frames("follow") + small + " --fps 1 --camera follow").code, 0);
  const auto all = facts("follow");
  ASSERT_EQ(all.size(), 3u);
  for (const auto& picture : all) {
    EXPECT_GT(picture["red"], 0.005);
    EXPECT_NEAR(picture["column"].get<double>(), 160, 3);
  }
  EXPECT_NE(all[0]["pixels"], all[1]["pixels"]);
}

TEST_F(Frames, BecomeAFilm) {
  for (const std::string name : {"film.mp4", "film.webm"}) {
    const Ended end = run(replay() + " --video " + folder(name).string() + small + " --fps 5 --speed 2");
    ASSERT_EQ(end.code, 0) << end.err;
    EXPECT_EQ(end.out, folder(name).string() + "\n");
    const Ended told = run(
        "ffprobe -v error -count_frames -show_entries stream=width,height,r_frame_rate,nb_read_frames -of "
        "json " +
        folder(name).string());
    const auto stream = nlohmann::json::parse(told.out).at("streams").at(0);
    EXPECT_EQ(stream.at("nb_read_frames"), "6");
    EXPECT_EQ(stream.at("r_frame_rate"), "5/1");
    EXPECT_EQ(stream.at("width"), 320);
    EXPECT_EQ(stream.at("height"), 180);
  }
}

TEST_F(Frames, OptionsThatCannotBeAreRefused) {
  const std::string begin = replay() + frames("none");
  expect_refused(begin + " --to 2.5", 2,
                 "--to: the replay of this run goes from 0 s to 2 s; 2.5 s is outside; give a time within");
  expect_refused(begin + " --from -1", 2,
                 "--from: the replay of this run goes from 0 s to 2 s; -1 s is outside");
  expect_refused(begin + " --from 2 --to 1", 2, "--from: 2 s is after --to 1 s; swap them");
  expect_refused(begin + " --size 0x9", 2, "Value 0x9 is no size; give WIDTHxHEIGHT, each 16 to 4096 pixels");
  expect_refused(begin + " --fps 0", 2, "Value 0 is no rate; give 0.1 to 240 frames per second");
  expect_refused(begin + " --speed nan", 2, "Value nan is no speed; give 0.01 to 100");
  expect_refused(begin + " --camera cab", 2, "--camera");
  expect_refused(begin + " --file a.html", 2, "--file excludes --frames");
  expect_refused(replay() + " --fps 5", 2, "--fps requires --frames or --video");
  expect_refused(replay() + " --video film.gif", 2,
                 "is no name of a film; give one that ends with .mp4 or .webm");
  expect_refused(replay() + " --video film.mp4 --size 321x180", 2,
                 "--size: a film has an even number of pixels");
  expect_refused(replay() + " --frames " + (dir() / "logs" / "x").string(), 2, "--frames: ");
  EXPECT_FALSE(std::filesystem::exists(folder("none")));
  expect_refused("env TROUBLE=drawn " TROUBLED_STUDY " replay --run " + id_ + out() + frames("none"), 1,
                 "the study draws no scene of the log of run " + id_);
}

TEST_F(Frames, WhatIsMissingIsNamedBeforeAnythingIsDrawn) {
  const std::string nothing = "PATH=" + temporary().string() + " ";
  const std::string program = std::string(TROUBLED_STUDY) + " replay --run " + id_ + out();
  expect_refused("env TROUBLE=filmed " + nothing + program + frames("none"), 1, "apt install chromium");
  expect_refused("env TROUBLE=filmed " + nothing + program + " --video " + folder("film.mp4").string(), 1,
                 "apt install ffmpeg");
  expect_refused(replay() + " --video " + (folder("none") / "film.mp4").string(), 1,
                 "none/film.mp4: No such file or directory; check its folder");
  expect_refused(replay("DRAWPOINT_BROWSER=/none") + frames("none"), 1,
                 "DRAWPOINT_BROWSER is \"/none\", which is no program");
  expect_refused(replay("DRAWPOINT_BROWSER=false") + frames("none"), 1,
                 "the browser ended with exit code 1, with 0 of 41 frames drawn");
}

TEST_F(Frames, CtrlCSaysWhatIsThere) {
  const auto browser = folder("browser");
  std::ofstream(browser) << "#!/bin/sh\ntouch " << folder("begun").string() << "\nexec sleep 300\n";
  std::filesystem::permissions(browser, std::filesystem::perms::owner_all);
  Command command(replay("DRAWPOINT_BROWSER=" + browser.string()) + frames("stopped"), place_);
  await(folder("begun"));
  command.send(SIGINT);
  const Ended end = command.wait();
  EXPECT_EQ(end.code, 130);
  EXPECT_TRUE(contains(end.err, "are whole; remove them before the same command, or name another folder"));
}

// Not even a command that is killed leaves a browser, its folder, or half a frame.
TEST_F(Frames, AKilledCommandLeavesWholeFramesAlone) {
  Command command(replay() + frames("killed") + small + " --fps 100", place_);
  await(folder("killed") / "frame_000003.png");
  EXPECT_GT(processes_at(temporary()), 1);
  command.send(SIGKILL);
  EXPECT_EQ(command.wait().code, 128 + SIGKILL);
  for (int i = 0; i < 6000 && (processes_at(temporary()) > 0 || !std::filesystem::is_empty(temporary())); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(processes_at(temporary()), 0);
  const auto all = facts("killed");
  EXPECT_GE(all.size(), 3u);
  for (const auto& picture : all) EXPECT_EQ(picture["width"], 320);
}

}  // namespace
