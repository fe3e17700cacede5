// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/collision/finder_state.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::uint64_t mark = 0x3330444e46435044;  // "DPCFND03"
constexpr double off_orthonormal = 1e-6;            // as set_pose() allows
constexpr double round_off = 1e-6;                  // [m] of recomputed points

[[noreturn]] void refuse(const std::string& what) {
  throw std::runtime_error("engine::ContactFinder::restore: " + what +
                           "; give the whole state that save() wrote, to a finder with the same options and "
                           "colliders");
}

// FNV-1a, 64 bits.
std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (std::byte b : bytes) sum = (sum ^ static_cast<std::uint64_t>(b)) * 0x100000001b3;
  return sum;
}

class Writer {
 public:
  explicit Writer(std::vector<std::byte>& bytes) : bytes_(bytes) {}
  template <class T>
  void raw(const T& value) {
    const auto* from = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), from, from + sizeof value);
  }
  void count(std::size_t value) { raw(static_cast<std::uint64_t>(value)); }
  void number(int value) { raw(static_cast<std::int32_t>(value)); }
  void flag(bool value) { raw(static_cast<std::uint8_t>(value)); }
  template <class Derived>
  void matrix(const Eigen::PlainObjectBase<Derived>& m) {
    for (Eigen::Index k = 0; k < m.size(); ++k) raw(m.data()[k]);
  }

 private:
  std::vector<std::byte>& bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  T raw() {
    if (bytes_.size() - at_ < sizeof(T)) refuse("the state ends at byte " + std::to_string(bytes_.size()));
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  // A number of things that take at least `size` bytes each, so that no count makes us ask for more memory
  // than the state itself takes.
  std::size_t count(const char* what, std::size_t size) {
    const auto value = raw<std::uint64_t>();
    if (value > (bytes_.size() - at_) / size)
      refuse(place(what) + " is " + std::to_string(value) + ", more than the bytes that follow can hold");
    return static_cast<std::size_t>(value);
  }
  int number(const char* what, int lower, int upper) {
    const int value = raw<std::int32_t>();
    if (value < lower || value > upper)
      refuse(place(what) + " is " + std::to_string(value) + ", expected " + std::to_string(lower) + " to " +
             std::to_string(upper));
    return value;
  }
  bool flag(const char* what) {
    const auto value = raw<std::uint8_t>();
    if (value > 1) refuse(place(what) + " is " + std::to_string(value) + ", expected 0 or 1");
    return value == 1;
  }
  double finite(const char* what) {
    const auto value = raw<double>();
    if (!std::isfinite(value)) refuse(place(what) + " is not finite");
    return value;
  }
  Vector3d vector(const char* what) {
    const double x = finite(what), y = finite(what), z = finite(what);
    return {x, y, z};
  }
  Matrix3d rotation(const char* what) {
    Matrix3d R;
    for (Eigen::Index k = 0; k < 9; ++k) R.data()[k] = finite(what);
    if (!((R.transpose() * R - Matrix3d::Identity()).norm() <= off_orthonormal))
      refuse(place(what) + " is no rotation");
    return R;
  }
  std::string place(const char* what) const { return std::string(what) + " at byte " + std::to_string(at_); }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

std::array<double, 5> numbers_of(const ContactFinderOptions& o) {
  return {o.margin, o.slack, o.reuse_distance, o.reuse_angle, o.hysteresis};
}

int vertices_of(const Items& items, int id) {
  return items.placed[id].hull ? items.placed[id].hull->vertex_count() : 0;
}

void save_collider(const FinderParts& parts, int id, Writer& out) {
  const Placement& placed = parts.items.placed[id];
  out.number(vertices_of(parts.items, id));
  out.flag(parts.items.traits[id].moves);
  out.flag(parts.items.item[id].dirty);
  out.matrix(placed.R), out.matrix(placed.p), out.matrix(placed.centre);
  out.raw(parts.items.motion_bound[id]), out.raw(parts.items.item[id].boxed_at);
  out.raw(parts.items.speculative_margin[id]);
  if (placed.hull) out.matrix(parts.boxes.box(id).min()), out.matrix(parts.boxes.box(id).max());
}

ColliderState read_collider(const FinderParts& parts, int id, Reader& in) {
  const CollisionHull* hull = parts.items.placed[id].hull;
  const int vertices = vertices_of(parts.items, id);
  in.number("the number of vertices", vertices, vertices);
  ColliderState state;
  state.moves = in.flag("a collider's moves");
  state.dirty = in.flag("a collider's dirty flag");
  state.R = in.rotation("a collider's orientation");
  state.p = in.vector("a collider's position"), state.centre = in.vector("a collider's centre");
  state.motion_bound = in.finite("a motion bound"), state.boxed_at = in.finite("a motion bound");
  state.speculative_margin = in.finite("the reach of a collider");
  if (state.speculative_margin < 0) refuse(in.place("the reach of a collider") + " is negative");
  if (!hull) return state;
  if (!((state.R * hull->centre + state.p - state.centre).norm() <= round_off))
    refuse(in.place("a collider's centre") + " is not where its pose puts it");
  state.box.min() = in.vector("a box"), state.box.max() = in.vector("a box");
  const Vector3d slack = Vector3d::Constant(round_off);
  const Eigen::AlignedBox3d roomy(state.box.min() - slack, state.box.max() + slack);
  if (state.dirty) return state;
  for (const Vector3d& v : hull->vertices)
    if (!roomy.contains(Vector3d(state.R * v + state.p)))
      refuse(in.place("a box") + " does not hold its shape");
  return state;
}

void save_pair(const PairEntry& entry, const PairState& state, Writer& out) {
  const ConvexContact& c = state.contact;
  out.number(entry.a), out.number(entry.b), out.number(entry.count), out.raw(entry.limit);
  out.matrix(c.normal), out.raw(c.separation), out.raw(c.support), out.flag(c.normal_of_b);
  out.number(static_cast<int>(c.feature.kind)), out.number(c.feature.a), out.number(c.feature.b);
  for (int k = 0; k < entry.count; ++k) {
    const Anchors& point = c.points[static_cast<std::size_t>(k)];
    out.matrix(point.on_a), out.matrix(point.on_b), out.raw(point.feature);
  }
  if (entry.count > 0) out.matrix(state.centre), out.matrix(state.orientation), out.raw(state.margin);
}

constexpr std::size_t least_pair_size = 3 * 4 + 8 + 5 * 8 + 1 + 3 * 4;

Feature read_feature(const Placement& a, const Placement& b, Reader& in) {
  const int kind = in.number("the kind of a pair's axis", 0, 3);
  Feature feature;
  feature.kind = static_cast<FeatureKind>(kind);
  const bool edges = feature.kind == FeatureKind::edges;
  const auto index = [&](bool used, int count) {
    return in.number("a feature of a pair's axis", used ? 0 : -1, used ? count - 1 : -1);
  };
  const auto count = [&](const Placement& placed) {
    if (!placed.hull) return 0;
    return edges ? static_cast<int>(placed.hull->edges.size()) : placed.hull->face_count();
  };
  feature.a = index(edges || feature.kind == FeatureKind::face_a, count(a));
  feature.b = index(edges || feature.kind == FeatureKind::face_b, count(b));
  return feature;
}

PairEntry read_pair(const Items& items, Reader& in, PairState& state) {
  const int last = items.size() - 1;
  PairEntry entry{};
  entry.a = in.number("the first collider of a pair", 0, last);
  entry.b = in.number("the second collider of a pair", entry.a + 1, last);
  const Traits &ta = items.traits[entry.a], &tb = items.traits[entry.b];
  const Placement &a = items.placed[entry.a], &b = items.placed[entry.b];
  const bool apart_by_rule = ta.body == tb.body || (ta.family > 0 && ta.family == tb.family);
  if (!ta.alive || !tb.alive || (!a.hull && !b.hull) || apart_by_rule)
    refuse(in.place("a pair") + " is of two colliders that cannot touch");
  entry.count = in.number("the number of points of a pair", 0, a.hull && b.hull ? 4 : 0);
  entry.limit = in.raw<double>();
  if (!(entry.limit < std::numeric_limits<double>::infinity()))
    refuse(in.place("the limit of a pair") + " is not a number below infinity");
  ConvexContact& c = state.contact;
  c.normal = in.vector("the normal of a pair");
  c.separation = in.finite("the separation of a pair"), c.support = in.finite("the reach of a pair");
  c.normal_of_b = in.flag("the owner of a normal");
  c.feature = read_feature(a, b, in);
  c.count = entry.count;
  for (int k = 0; k < entry.count; ++k) {
    Anchors& point = c.points[static_cast<std::size_t>(k)];
    point.on_a = in.vector("a point of a pair"), point.on_b = in.vector("a point of a pair");
    point.feature = in.raw<std::uint32_t>();
  }
  if (entry.count > 0) {
    if (!(std::abs(c.normal.norm() - 1) <= round_off))
      refuse(in.place("the normal of a pair") + " has no unit length");
    state.centre = in.vector("the stand of a pair"), state.orientation = in.rotation("the stand of a pair");
    state.margin = in.finite("the margin of a pair");
  }
  return entry;
}

// Appends their states.
std::vector<PairEntry> read_pairs(const Items& items, Reader& in, std::vector<PairState>& states) {
  std::vector<PairEntry> entries;
  for (std::size_t left = in.count("the number of pairs", least_pair_size); left > 0; --left) {
    const PairEntry entry = read_pair(items, in, states.emplace_back());
    if (!entries.empty() && std::pair(entries.back().a, entries.back().b) >= std::pair(entry.a, entry.b))
      refuse(in.place("a pair") + " is out of order");
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace

void save_state(const FinderParts& parts, std::vector<std::byte>& bytes) {
  const std::size_t start = bytes.size();
  Writer out(bytes);
  out.raw(mark);
  for (double number : numbers_of(parts.options)) out.raw(number);
  out.count(static_cast<std::size_t>(parts.items.size()));
  for (int id = 0; id < parts.items.size(); ++id) {
    out.flag(parts.items.traits[id].alive);
    if (parts.items.traits[id].alive) save_collider(parts, id, out);
  }
  out.count(parts.boxes.pending().size());
  for (int id : parts.boxes.pending()) out.number(id);
  const auto alive = [&](const PairEntry& e) {
    return parts.items.traits[e.a].alive && parts.items.traits[e.b].alive;
  };
  std::size_t pairs = 0;
  for (const PairEntry& entry : parts.pairs.entries()) pairs += alive(entry) ? 1 : 0;
  out.count(pairs);
  for (const PairEntry& entry : parts.pairs.entries())
    if (alive(entry)) save_pair(entry, parts.pairs.state(entry), out);
  out.count(parts.pairs.inactive().size());
  for (const auto& [pair, entry] : parts.pairs.inactive()) save_pair(entry, parts.pairs.state(entry), out);
  out.raw(checksum(std::span(bytes).subspan(start)));
}

FinderState read_state(const FinderParts& parts, std::span<const std::byte> bytes) {
  constexpr std::size_t tail = sizeof(std::uint64_t);
  if (bytes.size() < sizeof mark + tail) refuse("the state has " + std::to_string(bytes.size()) + " bytes");
  const auto body = bytes.first(bytes.size() - tail);
  Reader in(body), end(bytes.last(tail));
  if (in.raw<std::uint64_t>() != mark) refuse("byte 0 is not the start of a finder's state");
  if (end.raw<std::uint64_t>() != checksum(body))
    refuse("the checksum does not fit: bytes are missing or changed");
  for (double number : numbers_of(parts.options))
    if (const double saved = in.finite("an option"); saved != number)
      refuse(in.place("an option") + " is " + std::to_string(saved) + ", here it is " +
             std::to_string(number));
  FinderState state;
  const int size = parts.items.size();
  if (const auto saved = in.count("the number of colliders", 1); saved != static_cast<std::size_t>(size))
    refuse("the state has " + std::to_string(saved) + " colliders, here there are " + std::to_string(size));
  state.colliders.resize(static_cast<std::size_t>(size));
  for (int id = 0; id < size; ++id) {
    if (in.flag("a collider's presence") != parts.items.traits[id].alive)
      refuse("collider " + std::to_string(id) + " is removed on one side only");
    if (parts.items.traits[id].alive) state.colliders[id] = read_collider(parts, id, in);
  }
  for (std::size_t k = in.count("the number of boxes to look up", 4); k > 0; --k)
    state.pending.push_back(in.number("a box to look up", 0, size - 1));
  for (std::vector<PairEntry>* entries : {&state.entries, &state.inactive})
    *entries = read_pairs(parts.items, in, state.pairs);
  if (!in.at_end()) refuse(in.place("the end") + " is followed by more");
  return state;
}

}  // namespace drawpoint::engine::detail
