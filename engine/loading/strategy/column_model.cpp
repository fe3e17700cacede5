// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/strategy/column_model.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::engine::loading {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

void require_column_option(bool good, const char* name, double value, const char* allowed) {
  if (!good)
    throw std::invalid_argument("loading::column_model: " + std::string(name) + " is " +
                                std::to_string(value) + "; give " + allowed);
}

void check(const ColumnGrid& grid, const ColumnOptions& options) {
  const auto positive = [](const char* name, double value) {
    require_column_option(value > 0 && std::isfinite(value), name, value, "a finite value above 0");
  };
  positive("grid.cell [m]", grid.cell);
  positive("grid.half_width [m]", grid.half_width);
  positive("grid.x_max - grid.x_min [m]", grid.x_max - grid.x_min);
  positive("options.bucket_width [m]", options.bucket_width);
  positive("options.bucket_volume [m3]", options.bucket_volume);
  positive("options.row_pitch [m]", options.row_pitch);
  require_column_option(options.h_tol >= 0, "options.h_tol [m]", options.h_tol, "at least 0");
  require_column_option(options.n_run >= 1, "options.n_run [1]", options.n_run, "at least 1");
  require_column_option(options.side_clearance >= 0, "options.side_clearance [m]", options.side_clearance,
                        "at least 0");
  require_column_option(1.0 * grid.nx() * grid.ny() <= 1e8, "columns [1]", 1.0 * grid.nx() * grid.ny(),
                        "a coarser cell [m], for at most 1e8 columns");
}

// Index of the column or strip that a coordinate lies in; outside the grid when the coordinate is.
int index_of(double cells) { return static_cast<int>(std::floor(std::clamp(cells, -1e6, 1e9))); }
int column_at(double x, const ColumnGrid& grid) { return index_of((x - grid.x_min) / grid.cell); }
int strip_at(double y, const ColumnGrid& grid) { return index_of(y / grid.cell + 0.5 * grid.ny()); }

// Where the vertical line through (x, y) leaves the polyhedron at the top; -infinity if it misses.
double top_over(const engine::ConvexPolyhedron& rock, double x, double y) {
  constexpr double upright = 1e-12;
  double low = -infinity, high = infinity;
  for (std::size_t k = 0; k < rock.faces().size(); ++k) {
    const Vector3d& n = rock.face_normals()[k];
    const Vector3d& p = rock.vertices()[rock.faces()[k][0]];
    const double room = n.x() * (p.x() - x) + n.y() * (p.y() - y);
    if (n.z() > upright) {
      high = std::min(high, p.z() + room / n.z());
    } else if (n.z() < -upright) {
      low = std::max(low, p.z() + room / n.z());
    } else if (room < 0) {
      return -infinity;
    }
  }
  return high >= low ? high : -infinity;
}

void raise(MatrixXd& heights, int i, int j, double z) {
  if (i >= 0 && j >= 0 && i < heights.rows() && j < heights.cols())
    heights(i, j) = std::max(heights(i, j), z);
}

void add_rock(const PosedRock& rock, const ColumnGrid& grid, MatrixXd& heights) {
  const engine::ConvexPolyhedron placed = rock.shape->transformed(rock.pose);
  Vector3d low = Vector3d::Constant(infinity), high = -low;
  for (const Vector3d& v : placed.vertices()) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
    raise(heights, column_at(v.x(), grid), strip_at(v.y(), grid), v.z());
  }
  const int i_end = std::min(column_at(high.x(), grid), grid.nx() - 1);
  const int j_end = std::min(strip_at(high.y(), grid), grid.ny() - 1);
  for (int j = std::max(strip_at(low.y(), grid), 0); j <= j_end; ++j)
    for (int i = std::max(column_at(low.x(), grid), 0); i <= i_end; ++i)
      raise(heights, i, j, top_over(placed, grid.x(i), grid.y(j)));
}

using Cell = std::pair<Eigen::Index, Eigen::Index>;

// The columns that hang together with `seed` by their sides; they leave `open`.
std::vector<Cell> connected(Cell seed, Eigen::Array<bool, -1, -1>& open) {
  std::vector<Cell> found{seed};
  open(seed.first, seed.second) = false;
  for (std::size_t next = 0; next < found.size(); ++next) {
    const auto [i, j] = found[next];
    for (const auto& [u, v] : {Cell{i - 1, j}, Cell{i + 1, j}, Cell{i, j - 1}, Cell{i, j + 1}}) {
      if (u < 0 || v < 0 || u >= open.rows() || v >= open.cols() || !open(u, v)) continue;
      open(u, v) = false;
      found.emplace_back(u, v);
    }
  }
  return found;
}

MatrixXd pile_body(const MatrixXd& heights, double h_tol) {
  Eigen::Array<bool, -1, -1> open = heights.array() > h_tol;
  std::vector<Cell> largest;
  double largest_sum = 0;
  for (Eigen::Index j = 0; j < heights.cols(); ++j)
    for (Eigen::Index i = 0; i < heights.rows(); ++i) {
      if (!open(i, j)) continue;
      std::vector<Cell> part = connected({i, j}, open);
      double sum = 0;
      for (const auto& [u, v] : part) sum += heights(u, v);
      if (sum <= largest_sum) continue;
      largest_sum = sum;
      largest = std::move(part);
    }
  MatrixXd body = MatrixXd::Zero(heights.rows(), heights.cols());
  for (const auto& [i, j] : largest) body(i, j) = heights(i, j);
  return body;
}

// First column of a run of n_run; -1 without one.
int front_column(const MatrixXd& body, int j, const ColumnOptions& options) {
  int run = 0;
  for (int i = 0; i < body.rows(); ++i) {
    run = body(i, j) > options.h_tol ? run + 1 : 0;
    if (run == options.n_run) return i - options.n_run + 1;
  }
  return -1;
}

Strip strip_of(const ColumnModel& model, int j) {
  const ColumnGrid& grid = model.grid;
  Strip strip;
  strip.front = grid.x_max;
  const int first = front_column(model.body, j, model.options);
  if (first < 0) return strip;
  const double quota = model.options.bucket_volume * grid.cell / model.options.bucket_width;
  double volume = 0, moment = 0;
  for (int i = first; i < grid.nx() && volume < quota; ++i) {
    const double v = grid.cell * grid.cell * model.body(i, j);
    volume += v;
    moment += v * grid.x(i);
  }
  strip.has_pile = true;
  strip.meets_quota = volume >= quota;
  strip.front_column = first;
  strip.front = grid.x(first - 0.5);
  strip.volume_centre = moment / volume;
  strip.height = model.body(column_at(strip.volume_centre, grid), j);
  strip.slope = std::atan2(strip.height, strip.volume_centre - strip.front);
  return strip;
}

// Breadth of the strips that a bucket covers [m].
double breadth(const ColumnModel& model) {
  const double cell = model.grid.cell;
  return cell * std::ceil(model.options.bucket_width / cell - 1e-9);
}

// The share of each strip that a bucket at y covers.
Eigen::VectorXd covered(const ColumnModel& model, double y) {
  const double cell = model.grid.cell, reach = 0.5 * (breadth(model) + cell);
  Eigen::VectorXd shares(model.grid.ny());
  for (int j = 0; j < model.grid.ny(); ++j) {
    const double share = (reach - std::abs(model.grid.y(j) - y)) / cell;
    shares[j] = share > 1e-9 ? std::min(share, 1.0) : 0.0;  // a billionth is round-off
  }
  return shares;
}

// False if the bucket finds no pile there.
bool make_row(const ColumnModel& model, double y, Row& row) {
  row = Row{.y = y};
  const Eigen::VectorXd shares = covered(model, y);
  double with_pile = 0;
  for (int j = 0; j < model.grid.ny(); ++j) {
    const Strip& strip = model.strips[j];
    if (!strip.has_pile) continue;
    with_pile += shares[j];
    row.front += shares[j] * strip.front;
    row.volume_centre += shares[j] * strip.volume_centre;
    row.slope += shares[j] * strip.slope;
  }
  if (with_pile == 0) return false;
  row.front /= with_pile;
  row.volume_centre /= with_pile;
  row.slope /= with_pile;
  const std::vector<double> z = contour(model, row);
  row.crest = *std::max_element(z.begin(), z.end());
  return row.slope > 0;
}

std::vector<Row> rows_of(const ColumnModel& model) {
  const ColumnOptions& o = model.options;
  const double strips_end = 0.5 * (model.grid.ny() * model.grid.cell - breadth(model)),
               walls = model.grid.half_width - 0.5 * o.bucket_width - o.side_clearance;
  const double places = std::floor(2 * std::min(strips_end, walls) / o.row_pitch + 1e-6);
  std::vector<Row> rows;
  Row row;
  for (int k = 0; k <= places; ++k)
    if (make_row(model, (k - 0.5 * places) * o.row_pitch, row)) rows.push_back(row);
  return rows;
}

}  // namespace

int ColumnGrid::nx() const { return static_cast<int>(std::ceil((x_max - x_min) / cell - 1e-9)); }
int ColumnGrid::ny() const { return static_cast<int>(std::floor(2 * half_width / cell + 1e-9)); }

ColumnModel column_model(const MatrixXd& heights, const ColumnGrid& grid, const ColumnOptions& options) {
  check(grid, options);
  if (heights.rows() != grid.nx() || heights.cols() != grid.ny() || !heights.allFinite())
    throw std::invalid_argument("loading::column_model: heights [m] are " + std::to_string(heights.rows()) +
                                " x " + std::to_string(heights.cols()) + "; give finite numbers, nx x ny = " +
                                std::to_string(grid.nx()) + " x " + std::to_string(grid.ny()));
  ColumnModel model{grid, options, heights, pile_body(heights, options.h_tol), {}, {}};
  for (int j = 0; j < grid.ny(); ++j) model.strips.push_back(strip_of(model, j));
  model.rows = rows_of(model);
  return model;
}

ColumnModel column_model(std::span<const PosedRock> rocks, const ColumnGrid& grid,
                         const ColumnOptions& options) {
  check(grid, options);
  MatrixXd heights = MatrixXd::Zero(grid.nx(), grid.ny());
  for (const PosedRock& rock : rocks) {
    if (rock.shape == nullptr || !rock.pose.matrix().allFinite())
      throw std::invalid_argument(
          "loading::column_model: a rock has no shape or no finite pose; leave removed rocks out");
    add_rock(rock, grid, heights);
  }
  return column_model(heights, grid, options);
}

std::vector<double> contour(const ColumnModel& model, const Row& row) {
  const Eigen::VectorXd shares = covered(model, row.y), mean = model.body * (shares / shares.sum());
  return {mean.data(), mean.data() + mean.size()};
}

bool lies_in_front(const ColumnModel& model, const Eigen::Vector3d& centre) {
  const int j = std::clamp(strip_at(centre.y(), model.grid), 0, model.grid.ny() - 1);
  return centre.x() < model.strips[j].front;
}

}  // namespace drawpoint::engine::loading
