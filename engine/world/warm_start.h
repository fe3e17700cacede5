// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <drawpoint/engine/base/byte_stream.hpp>
#include <vector>

/// Last step's impulses, found again by pair and feature, so that a resting pile starts from its own load.
///
/// Pairs are stored in ascending order, so looking them up in ascending order is a merge: linear in the
/// pairs. A point that matches no feature takes the nearest unmatched point of its pair within
/// `match_distance`. A step may look its pairs up several times before it stores: rewind() starts over.
namespace drawpoint::engine {

class WarmStart {
 public:
  struct Point {
    std::uint32_t feature;
    Eigen::Vector3d position;
    Eigen::Vector3d impulse;
    bool used;
  };
  struct Pair {
    int a, b;
    Eigen::Vector3d rolling;
    std::size_t first, count;  ///< of its points
  };
  /// A pair with its points, on its own.
  struct Entry {
    int a, b;
    Eigen::Vector3d rolling;
    std::vector<Point> points;
  };
  static constexpr double match_distance = 0.03;  ///< [m], a tenth of the smallest rock

  /// Makes every point free to be found again.
  void rewind();

  /// Looks pairs up, in ascending order. Several readers may work at a time on different pairs.
  class Reader {
   public:
    explicit Reader(WarmStart& store) : store_(store) {}
    /// The next pair; the first call finds its place anywhere.
    void begin_pair(int a, int b);
    /// Impulse of the pair's next point; zero where nothing matches.
    Eigen::Vector3d point(std::uint32_t feature, const Eigen::Vector3d& position);
    Eigen::Vector3d rolling() const;

   private:
    WarmStart& store_;
    std::size_t cursor_ = 0;
    bool placed_ = false, found_ = false;
  };

  /// Adds pairs, in order; one that is stored already stays as it is.
  void insert(const std::vector<Entry>& entries);

  /// Replaces what is stored by the solved impulses: begin_store() with their numbers, then every pair and
  /// point at its place, in any order and by several threads, then end_store(). Pairs ascend.
  void begin_store(std::size_t pairs, std::size_t points);
  void store_pair(std::size_t place, const Pair& pair) { new_pairs_[place] = pair; }
  void store_point(std::size_t place, const Point& point) { new_points_[place] = point; }
  void end_store();

  /// What the next step will start from. Reading throws std::runtime_error for what cannot be, and then
  /// changes nothing.
  void save(ByteWriter& out) const;
  void restore(ByteReader& in);

 private:
  std::vector<Pair> pairs_, new_pairs_;
  std::vector<Point> points_, new_points_;
};

}  // namespace drawpoint::engine
