// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The step of MOEA/D: a child for each direction, which replaces its neighbours where it serves them better.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/pareto/detail/compiled.hpp>
#include <drawpoint/pareto/detail/directed.hpp>
#include <drawpoint/pareto/detail/search_process.hpp>
#include <drawpoint/pareto/detail/stable_matching.hpp>
#include <drawpoint/pareto/moead.hpp>

namespace drawpoint::pareto {
namespace detail {

/// Value of a scalar problem at the scaled objectives F; w: its direction, of unit length for pbi.
inline double scalarised(const MoeadOptions& options, const Eigen::RowVectorXd& F,
                         const Eigen::RowVectorXd& w) {
  if (options.scalarisation == Scalarisation::chebyshev)
    return (F.array() / w.array().max(1e-6)).maxCoeff();  // a zero would leave an objective out of account
  const double along = F.dot(w);
  return along + options.penalty * (F - along * w).norm();
}

inline Directed directed(const doe::Problem& problem, const MoeadOptions& o) {
  Setting setting = setting_for("pareto::moead: ", problem, o.search, {.crossover_probability = 1.0});
  check_range(setting.place, "penalty", o.penalty, o.penalty > 0.0, "above 0");
  check_range(setting.place, "neighbours", o.neighbours, o.neighbours >= 2, "2 or more");
  check_range(setting.place, "neighbour_probability", o.neighbour_probability,
              o.neighbour_probability >= 0.0 && o.neighbour_probability <= 1.0, "0 to 1");
  check_range(setting.place, "replacements", o.replacements, o.replacements >= 1, "1 or more");
  setting.own = {{"scalarisation", std::string(to_string(o.scalarisation))},
                 {"penalty", doe::detail::number_text(o.penalty)},
                 {"neighbours", std::to_string(o.neighbours)},
                 {"neighbour_probability", doe::detail::number_text(o.neighbour_probability)},
                 {"replacements", std::to_string(o.replacements)}};
  Directed result = directed(std::move(setting), o.directions, problem);
  result.setting.population = result.setting.children = static_cast<int>(result.directions.rows());
  return result;
}

class Decomposition : public SearchProcess {
 public:
  Decomposition(const doe::Problem& problem, const MoeadOptions& options, const Directed& given)
      : SearchProcess(problem, given.setting),
        options_(options),
        directions_(given.directions.rowwise().normalized()),
        random_(0) {
    find_neighbours();
  }

  std::unique_ptr<SearchProcess> copy() const override { return std::make_unique<Decomposition>(*this); }

 private:
  Eigen::MatrixXd next(Population told) override {
    meet(told);
    if (generation_ == 0) {
      members_ = setting().search.start.rows() > 0 ? shared_out(told) : std::move(told);
    } else {
      scale(members_);
      std::vector<int> order = everyone_;
      doe::detail::shuffle(order, random_);
      for (const int k : order) replace(told, k);
    }
    close();
    return bred(generation_++);
  }

  Population best() const override { return best_of(members_); }

  void find_neighbours() {
    const Eigen::Index n = directions_.rows();
    const auto count = std::min<std::ptrdiff_t>(options_.neighbours, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::VectorXd distance = (directions_.rowwise() - directions_.row(k)).rowwise().squaredNorm();
      std::vector<int> order(static_cast<std::size_t>(n));
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(),
                [&](int a, int b) { return distance[a] != distance[b] ? distance[a] < distance[b] : a < b; });
      order.resize(static_cast<std::size_t>(count));
      neighbours_.push_back(std::move(order));
    }
    everyone_.resize(static_cast<std::size_t>(n));
    std::iota(everyone_.begin(), everyone_.end(), 0);
  }

  /// The ideal point takes the new points in.
  void meet(const Population& points) {
    for (Eigen::Index i = 0; i < points.size(); ++i)
      if (points.feasible(i))
        ideal_ = ideal_.size() == 0 ? Eigen::RowVectorXd(points.Y.row(i))
                                    : ideal_.cwiseMin(points.Y.row(i)).eval();
  }

  /// One point for each direction; points: as many or more.
  Population shared_out(const Population& points) {
    scale(points);
    std::vector<int> everyone(static_cast<std::size_t>(points.size()));
    std::iota(everyone.begin(), everyone.end(), 0);
    std::vector<std::vector<int>> choices;
    Eigen::MatrixXd distance(directions_.rows(), points.size());
    for (int k = 0; k < static_cast<int>(directions_.rows()); ++k) {
      choices.push_back(everyone);
      std::stable_sort(choices.back().begin(), choices.back().end(), [&](int a, int b) {
        return better({points, a}, {points, b}, k);
      });
      const Eigen::RowVectorXd w = directions_.row(k);
      for (int i = 0; i < static_cast<int>(points.size()); ++i) {
        const Eigen::RowVectorXd F = scaled(points, i);
        distance(k, i) = (F - F.dot(w) * w).norm();
      }
    }
    return selected(points, stable_matching(choices, distance));
  }

  void scale(const Population& points) {
    range_ = Eigen::RowVectorXd::Zero(directions_.cols());
    for (Eigen::Index i = 0; i < points.size(); ++i)
      if (points.feasible(i)) range_ = range_.cwiseMax(points.Y.row(i) - ideal_).eval();
    for (double& r : range_)
      if (!(r > 0.0)) r = 1.0;
  }

  /// The children of a generation; random_ stands behind them, where their replacing begins.
  Eigen::MatrixXd bred(int generation) {
    random_ = doe::RandomStream(stream(generation, generation_stream));
    const Eigen::Index n = members_.size();
    Eigen::MatrixXd children(breeder().space().dimension(), n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto& mates = mates_of(static_cast<int>(k));
      const int count = static_cast<int>(mates.size());
      children.col(k) = members_.U.row(mates[random_.below(count)]).transpose();
      Eigen::VectorXd second = members_.U.row(mates[random_.below(count)]).transpose();
      breeder().breed(children.col(k), second, random_);
    }
    return children.transpose();
  }

  const std::vector<int>& mates_of(int k) {
    return random_.uniform() < options_.neighbour_probability ? neighbours_[k] : everyone_;
  }

  void replace(const Population& children, int k) {
    int left = options_.replacements;
    std::vector<int> mates = mates_of(k);
    doe::detail::shuffle(mates, random_);
    for (const int i : mates) {
      if (left == 0) return;
      if (!better({children, k}, {members_, i}, i)) continue;
      members_.U.row(i) = children.U.row(k);
      members_.responses.row(i) = children.responses.row(k);
      members_.Y.row(i) = children.Y.row(k);
      members_.violations.row(i) = children.violations.row(k);
      members_.failed[i] = children.failed[k];
      --left;
    }
  }

  struct Member {
    const Population& of;
    int row;
  };

  /// Whether a serves the problem of this direction better than b does.
  bool better(const Member& a, const Member& b, int direction) const {
    const double ours = violation(a.of, a.row), theirs = violation(b.of, b.row);
    if (ours != theirs) return ours < theirs;
    if (ours > 0.0) return false;
    const Eigen::RowVectorXd w = directions_.row(direction);
    return value(a.of, a.row, w) < value(b.of, b.row, w);
  }

  double value(const Population& points, int i, const Eigen::RowVectorXd& w) const {
    return scalarised(options_, scaled(points, i), w);
  }

  Eigen::RowVectorXd scaled(const Population& points, int i) const {
    return (points.Y.row(i) - ideal_).cwiseQuotient(range_);
  }

  double violation(const Population& points, int i) const {
    if (points.failed[i]) return std::numeric_limits<double>::infinity();
    const Eigen::RowVectorXd scale = largest_violations().cwiseMax(std::numeric_limits<double>::min());
    return points.violations.cols() == 0 ? 0.0 : points.violations.row(i).cwiseQuotient(scale).sum();
  }

  void close() {
    const auto worst = [&]() -> Eigen::RowVectorXd {
      scale(members_);
      return ideal_ + range_;
    };
    close_generation(generation_, best().Y, worst);
  }

  void write(CheckpointWriter& out) const override { fields(*this, out); }

  void read(CheckpointReader& in) override {
    fields(*this, in);
    if (generation_ > 0) bred(generation_ - 1);  // for the sake of random_
  }

  template <class Self, class Stream>
  static void fields(Self& self, Stream& stream) {
    stream.item("next_generation", self.generation_);
    stream.item("members", self.members_);
    stream.item("ideal", self.ideal_);
  }

  MoeadOptions options_;
  Eigen::MatrixXd directions_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<int> everyone_;
  Population members_;
  Eigen::RowVectorXd ideal_, range_;
  int generation_ = 0;  // of the points that were asked for
  doe::RandomStream random_;
};

inline std::unique_ptr<SearchProcess> process_of(const doe::Problem& problem, const MoeadOptions& options) {
  return std::make_unique<Decomposition>(problem, options, directed(problem, options));
}

}  // namespace detail

DRAWPOINT_PARETO_INLINE Moead::Moead(const doe::Problem& problem, const MoeadOptions& options)
    : Search(detail::process_of(problem, options)) {}

}  // namespace drawpoint::pareto
