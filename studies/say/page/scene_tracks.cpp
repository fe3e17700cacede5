// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/say/page/scene_tracks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::studies::detail {
namespace {

using nlohmann::json;
using Pose = std::array<double, 7>;

constexpr std::size_t most_frames_of_scene = 65536;  // their numbers have 16 bits

struct TrackPoint {
  std::size_t frame = 0;
  Pose pose{};  ///< not finite: the body hides
};
using Track = std::vector<TrackPoint>;

[[noreturn]] void reject_scene(const std::string& what) { throw std::invalid_argument(what); }

Pose hiding() {
  Pose pose{};
  pose.fill(std::numeric_limits<double>::quiet_NaN());
  return pose;
}

bool hides(const Pose& pose) {
  return !std::all_of(pose.begin(), pose.end(), [](double v) { return std::isfinite(v); });
}

void check_frames(const json& scene) {
  const json& frames = scene.at("frames");
  if (!frames.is_array()) reject_scene("\"frames\" is not a list");
  if (frames.empty()) reject_scene("there are no frames");
  if (frames.size() > most_frames_of_scene) reject_scene("there are more than 65536 frames");
  for (const json& frame : frames)
    if (!frame.is_object() || !frame.value("t", json()).is_number())
      reject_scene("a frame's time is not a number");
  if (scene.value("poster_frame", std::size_t{0}) >= frames.size())
    reject_scene("the poster frame is not among the frames");
}

TrackPoint point_of(const json& row, std::size_t frames) {
  const bool shown = row.size() > 1;
  TrackPoint point{row.at(0).get<std::size_t>(), hiding()};
  if (point.frame >= frames) reject_scene("a body's track names a frame that is not there");
  if (shown && row.size() != 1 + point.pose.size())
    reject_scene("a row of a body's track has neither a frame alone nor a frame and seven numbers");
  for (std::size_t k = 0; shown && k < point.pose.size(); ++k) point.pose[k] = row.at(k + 1).get<double>();
  return point;
}

Track track_of(const json& body, const json& scene) {
  const std::size_t bodies = scene.at("bodies").size();
  if (body.contains("with")) {
    const auto carrier = body.at("with").get<std::size_t>();
    if (carrier >= bodies || scene.at("bodies").at(carrier).contains("with"))
      reject_scene("a body moves with one that is not there or has no track");
    return {};
  }
  Track track;
  for (const json& row : body.at("track")) {
    track.push_back(point_of(row, scene.at("frames").size()));
    if (track.size() > 1 && track[track.size() - 2].frame >= track.back().frame)
      reject_scene("the frames of a body's track do not rise");
  }
  return track;
}

/// A body that stands still for a while needs the first and the last of its equal poses.
void leave_out_repeated(Track& track) {
  Track kept;
  const auto same = [](const TrackPoint& a, const TrackPoint& b) {
    return a.pose == b.pose || (hides(a.pose) && hides(b.pose));
  };
  for (std::size_t k = 0; k < track.size(); ++k)
    if (k == 0 || !same(track[k], track[k - 1]) || (k + 1 < track.size() && !same(track[k], track[k + 1])))
      kept.push_back(track[k]);
  track = std::move(kept);
}

std::vector<Track> tracks_of_all_poses(const json& scene) {
  std::vector<Track> tracks(scene.at("bodies").size());
  std::size_t number = 0;
  for (const json& frame : scene.at("frames")) {
    const json& poses = frame.value("poses", json());
    if (!poses.is_array() || poses.size() != tracks.size())
      reject_scene("a frame has not one pose for every body");
    for (std::size_t b = 0; b < tracks.size(); ++b)
      tracks[b].push_back({number, poses[b].is_null() ? hiding() : poses[b].get<Pose>()});
    ++number;
  }
  std::for_each(tracks.begin(), tracks.end(), leave_out_repeated);
  return tracks;
}

std::vector<Track> tracks_of(const json& scene) {
  const json& bodies = scene.at("bodies");
  const auto has_own = [](const json& body) { return body.contains("track") || body.contains("with"); };
  if (std::none_of(bodies.begin(), bodies.end(), has_own)) return tracks_of_all_poses(scene);
  std::vector<Track> tracks;
  for (const json& body : bodies) {
    if (!has_own(body)) reject_scene("of some bodies there is a track, of others not");
    tracks.push_back(track_of(body, scene));
  }
  return tracks;
}

struct Box {
  std::array<double, 3> origin{};
  double scale = 1.0;  ///< [m] a unit
};

Box box_around(const std::vector<Track>& tracks) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const Track& track : tracks)
    for (const TrackPoint& point : track)
      for (std::size_t k = 0; k < 3 && !hides(point.pose); ++k) {
        low[k] = std::min(low[k], point.pose[k]);
        high[k] = std::max(high[k], point.pose[k]);
      }
  Box box;
  double half_extent = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (low[k] > high[k]) return box;
    box.origin[k] = 0.5 * (low[k] + high[k]);
    half_extent = std::max(half_extent, 0.5 * (high[k] - low[k]));
  }
  if (half_extent > 0.0) box.scale = half_extent / 32767.0;
  return box;
}

std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63u];
  }
  return text;
}

void append16(std::string& bytes, std::uint16_t n) {
  bytes += static_cast<char>(n & 255u);
  bytes += static_cast<char>(n >> 8);
}

void append_pose(std::string& bytes, const Pose& pose, const Box& box) {
  const bool gone = hides(pose);
  for (std::size_t k = 0; k < pose.size(); ++k) {
    const double value = k < 3 ? (pose[k] - box.origin[k]) / box.scale : 32767.0 * pose[k];
    const double kept = gone ? (k == 0 ? -32768.0 : 0.0) : std::clamp(value, -32767.0, 32767.0);
    append16(bytes, static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(kept))));
  }
}

}  // namespace

json packed_tracks(const json& scene) {
  check_frames(scene);
  const std::vector<Track> tracks = tracks_of(scene);
  const Box box = box_around(tracks);
  std::string frames, poses;
  json counts = json::array();
  for (const Track& track : tracks) {
    counts.push_back(track.size());
    for (const TrackPoint& point : track) {
      append16(frames, static_cast<std::uint16_t>(point.frame));
      append_pose(poses, point.pose, box);
    }
  }
  return {{"counts", std::move(counts)},
          {"frames", base64(frames)},
          {"data", base64(poses)},
          {"origin", box.origin},
          {"scale", box.scale}};
}

}  // namespace drawpoint::studies::detail
