// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/collision/finder_state.h>
#include <drawpoint/engine/base/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <drawpoint/engine/base/byte_stream.hpp>
#include <drawpoint/engine/base/hash.hpp>
#include <string>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::uint64_t mark = 0x3730444e46435044;  // "DPCFND07"

std::array<double, 6> numbers_of(const ContactFinderOptions& o) {
  return {o.margin, o.slack, o.reuse_distance, o.reuse_angle, o.hysteresis, static_cast<double>(o.narrow)};
}

int vertices_of(const Items& items, int id) {
  return items.placed[id].hull ? items.placed[id].hull->vertex_count() : 0;
}

void save_collider(const FinderParts& parts, int id, ByteWriter& out) {
  const Placement& placed = parts.items.placed[id];
  out.put(vertices_of(parts.items, id));
  out.put(parts.items.item[id].dirty);
  out.put(placed.R), out.put(placed.p), out.put(placed.centre);
  out.put(parts.items.motion_bound[id]), out.put(parts.items.item[id].boxed_at);
  out.put(parts.items.speculative_margin[id]);
  if (placed.hull) out.put(parts.boxes.box(id).min()), out.put(parts.boxes.box(id).max());
}

ColliderState read_collider(const FinderParts& parts, int id, ByteReader& in) {
  const CollisionHull* hull = parts.items.placed[id].hull;
  const int vertices = vertices_of(parts.items, id);
  in.get_int("the number of vertices", vertices, vertices);
  ColliderState state;
  state.dirty = in.get<bool>("a collider's dirty flag");
  state.R = in.get_rotation("a collider's orientation");
  state.p = in.get_vector("a collider's position"), state.centre = in.get_vector("a collider's centre");
  state.motion_bound = in.get<double>("a motion bound"), state.boxed_at = in.get<double>("a motion bound");
  state.speculative_margin = in.get<double>("the reach of a collider");
  if (state.speculative_margin < 0) in.fail("holds the reach of a collider that is negative");
  if (!hull) return state;
  if (!((state.R * hull->centre + state.p - state.centre).norm() <= constants::restored_round_off))
    in.fail("holds a collider's centre that is not where its pose puts it");
  state.box.min() = in.get_vector("a box"), state.box.max() = in.get_vector("a box");
  const Vector3d slack = Vector3d::Constant(constants::restored_round_off);
  const Eigen::AlignedBox3d roomy(state.box.min() - slack, state.box.max() + slack);
  if (state.dirty) return state;
  for (const Vector3d& v : hull->vertices)
    if (!roomy.contains(Vector3d(state.R * v + state.p))) in.fail("holds a box that does not hold its shape");
  return state;
}

void save_contact(const PairState& state, int count, ByteWriter& out) {
  out.put(state.contact.normal), out.put(state.contact.normal_of_b);
  for (int k = 0; k < count; ++k) {
    const Anchors& point = state.contact.points[static_cast<std::size_t>(k)];
    out.put(point.on_a), out.put(point.on_b), out.put(point.feature);
  }
  out.put(state.centre), out.put(state.orientation), out.put(state.margin);
}

// A contact with a plane is saved as which points touched.
void save_touch(const PairState* state, ByteWriter& out) {
  const int count = state ? state->contact.count : 0;
  out.put(count);
  for (int k = 0; k < count; ++k) out.put(state->contact.points[static_cast<std::size_t>(k)].feature);
}

void save_pair(const PairEntry& entry, const PairCache& pairs, bool with_plane, ByteWriter& out) {
  const NearState& near = pairs.near(entry);
  const PairState* held = near.held < 0 ? nullptr : &pairs.held(near.held);
  out.put(entry.a), out.put(entry.b), out.put(entry.count), out.put(entry.limit);
  out.put(near.normal), out.put(near.support);
  out.put(static_cast<int>(near.feature.kind)), out.put(near.feature.a), out.put(near.feature.b);
  if (entry.count > 0) save_contact(*held, entry.count, out);
  if (with_plane) save_touch(held, out);
}

constexpr std::size_t least_pair_size = 3 * 4 + 8 + 4 * 8 + 3 * 4;

Feature read_feature(const Placement& a, const Placement& b, ByteReader& in) {
  const int kind = in.get_int("the kind of a pair's axis", 0, 3);
  Feature feature;
  feature.kind = static_cast<FeatureKind>(kind);
  const bool edges = feature.kind == FeatureKind::edges;
  const auto index = [&](bool used, int count) {
    return in.get_int("a feature of a pair's axis", used ? 0 : -1, used ? count - 1 : -1);
  };
  const auto count = [&](const Placement& placed) {
    if (!placed.hull) return 0;
    return edges ? static_cast<int>(placed.hull->edges.size()) : placed.hull->face_count();
  };
  feature.a = index(edges || feature.kind == FeatureKind::face_a, count(a));
  feature.b = index(edges || feature.kind == FeatureKind::face_b, count(b));
  return feature;
}

PairState read_contact(int count, ByteReader& in) {
  PairState state;
  ConvexContact& c = state.contact;
  c.normal = in.get_vector("the normal of a pair");
  if (!(std::abs(c.normal.norm() - 1) <= constants::restored_round_off))
    in.fail("holds the normal of a pair that has no unit length");
  c.normal_of_b = in.get<bool>("the owner of a normal");
  c.count = count;
  for (int k = 0; k < count; ++k) {
    Anchors& point = c.points[static_cast<std::size_t>(k)];
    point.on_a = in.get_vector("a point of a pair"), point.on_b = in.get_vector("a point of a pair");
    point.feature = in.get<std::uint32_t>();
  }
  state.centre = in.get_vector("the stand of a pair");
  state.orientation = in.get_rotation("the stand of a pair");
  state.margin = in.get<double>("the margin of a pair");
  return state;
}

PairState read_touch(ByteReader& in) {
  PairState state;
  ConvexContact& c = state.contact;
  c.count = in.get_int("the number of points of a pair", 0, static_cast<int>(c.points.size()));
  for (int k = 0; k < c.count; ++k) c.points[static_cast<std::size_t>(k)].feature = in.get<std::uint32_t>();
  return state;
}

void read_pair(const Items& items, ByteReader& in, FinderState& state) {
  const int last = items.size() - 1;
  PairEntry entry{};
  entry.a = in.get_int("the first collider of a pair", 0, last);
  entry.b = in.get_int("the second collider of a pair", entry.a + 1, last);
  const Traits &ta = items.traits[entry.a], &tb = items.traits[entry.b];
  const Placement &a = items.placed[entry.a], &b = items.placed[entry.b];
  const bool apart_by_rule = ta.body == tb.body || (ta.family > 0 && ta.family == tb.family);
  if (!ta.alive || !tb.alive || (!a.hull && !b.hull) || apart_by_rule)
    in.fail("holds a pair that is of two colliders that cannot touch");
  if (!state.entries.empty() &&
      std::pair(state.entries.back().a, state.entries.back().b) >= std::pair(entry.a, entry.b))
    in.fail("holds a pair that is out of order");
  entry.count = in.get_int("the number of points of a pair", 0, a.hull && b.hull ? 4 : 0);
  entry.limit = in.get_any_double();
  if (!(entry.limit < std::numeric_limits<double>::infinity()))
    in.fail("holds the limit of a pair that is not a number below infinity");
  NearState near;
  near.normal = in.get_vector("the normal of a pair");
  near.support = in.get<double>("the reach of a pair");
  near.feature = read_feature(a, b, in);
  PairState held;
  if (entry.count > 0) held = read_contact(entry.count, in);
  if (!a.hull || !b.hull) held = read_touch(in);
  if (held.contact.count > 0) {
    held.contact.feature = near.feature;
    near.held = static_cast<int>(state.held.size());
    state.held.push_back(held);
  }
  state.entries.push_back(entry);
  state.near.push_back(near);
}

}  // namespace

std::vector<std::byte> save_state(const FinderParts& parts) {
  ByteWriter out;
  out.put(mark);
  for (double number : numbers_of(parts.options)) out.put(number);
  out.put_count(static_cast<std::size_t>(parts.items.size()));
  for (int id = 0; id < parts.items.size(); ++id) {
    out.put(parts.items.traits[id].alive);
    if (parts.items.traits[id].alive) save_collider(parts, id, out);
  }
  out.put_count(parts.boxes.pending().size());
  for (int id : parts.boxes.pending()) out.put(id);
  const auto alive = [&](const PairEntry& e) {
    return parts.items.traits[e.a].alive && parts.items.traits[e.b].alive;
  };
  std::size_t pairs = 0;
  for (const PairEntry& entry : parts.pairs.entries()) pairs += alive(entry) ? 1 : 0;
  out.put_count(pairs);
  const auto save = [&](const PairEntry& e) {
    const bool with_plane = !parts.items.placed[e.a].hull || !parts.items.placed[e.b].hull;
    save_pair(e, parts.pairs, with_plane, out);
  };
  for (const PairEntry& entry : parts.pairs.entries())
    if (alive(entry)) save(entry);
  out.put(Checksum::of(out.bytes()));
  return out.take();
}

FinderState read_state(const FinderParts& parts, std::span<const std::byte> bytes) {
  constexpr std::size_t tail = sizeof(std::uint64_t);
  const std::string
      place = "engine::ContactFinder::restore: the state",
      advice = "give the whole state that save() wrote, to a finder with the same options and colliders";
  const auto body = bytes.first(bytes.size() - std::min(bytes.size(), tail));
  ByteReader in(body, place, advice), end(bytes.subspan(body.size()), place, advice);
  if (in.get<std::uint64_t>() != mark) in.fail("is none of a contact finder");
  if (end.get<std::uint64_t>() != Checksum::of(body)) end.fail("is damaged, its checksum differs,");
  for (const double number : numbers_of(parts.options))
    if (const auto saved = in.get<double>("an option"); saved != number)
      in.fail("holds " + std::to_string(saved) + " for an option that is " + std::to_string(number) +
              " here,");
  FinderState state;
  const int size = parts.items.size();
  if (const auto saved = in.get_count(1); saved != static_cast<std::size_t>(size))
    in.fail("has " + std::to_string(saved) + " colliders, here there are " + std::to_string(size) + ",");
  state.colliders.resize(static_cast<std::size_t>(size));
  for (int id = 0; id < size; ++id) {
    if (in.get<bool>("a collider's presence") != parts.items.traits[id].alive)
      in.fail("says that collider " + std::to_string(id) + " is removed on one side only,");
    if (parts.items.traits[id].alive) state.colliders[id] = read_collider(parts, id, in);
  }
  for (std::size_t k = in.get_count(4); k > 0; --k)
    state.pending.push_back(in.get_int("a box to look up", 0, size - 1));
  for (std::size_t left = in.get_count(least_pair_size); left > 0; --left) read_pair(parts.items, in, state);
  in.expect_end();
  return state;
}

}  // namespace drawpoint::engine::detail
