// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What a search does behind its public face (ask_and_tell.hpp, which says what each function promises): asks
/// for points, takes in what they gave, keeps the course, and goes to disk and back.
///
/// A method derives from it and says how the next points come from those that were told.

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/pareto/detail/checkpoint.hpp>
#include <drawpoint/pareto/detail/course.hpp>
#include <drawpoint/pareto/detail/ordered_points.hpp>
#include <drawpoint/pareto/detail/population.hpp>
#include <drawpoint/pareto/detail/roles.hpp>
#include <drawpoint/pareto/detail/setting.hpp>
#include <drawpoint/pareto/detail/variation.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto::detail {

class SearchProcess {
 public:
  virtual ~SearchProcess() = default;
  virtual std::unique_ptr<SearchProcess> copy() const = 0;

  const doe::Problem& problem() const { return problem_; }
  const SearchOptions& options() const { return setting_.search; }
  bool done() const { return ended_ || setting_.search.stop.stop_requested(); }
  Eigen::MatrixXd ask() const {
    told_ = false;
    return breeder_.space().natural(asked_.topRows(asked()));
  }
  std::vector<doe::Seed> seeds() const;
  void tell(std::vector<doe::Outcome> outcomes);
  Front front() const;

  void save(const std::filesystem::path& path) const {
    CheckpointWriter out(head_of(problem_, setting_));
    fields(*this, out);
    write(out);
    doe::write_file(path, out.text());
  }

  void restore(const std::filesystem::path& path) {
    CheckpointReader in(path, head_of(problem_, setting_));
    fields(*this, in);
    read(in);
    course_.forget_unused();
    told_ = false;
    if (ended_ && in.rules_differ()) ended_ = course_.end(generation_, evaluations_ + per_generation());
  }

 protected:
  SearchProcess(doe::Problem problem, Setting setting)
      : problem_(std::move(problem)),
        setting_(std::move(setting)),
        breeder_(SearchSpace(problem_, setting_.search.start), setting_.rates),
        course_(setting_.place, setting_.search.stopping, roles(problem_).objectives.size()),
        asked_(breeder_.space().start(setting_.population, stream(0, start_stream))) {}
  SearchProcess(const SearchProcess&) = default;
  SearchProcess& operator=(const SearchProcess&) = delete;

  const Setting& setting() const { return setting_; }
  const Breeder& breeder() const { return breeder_; }

  /// By constraint, over all evaluations so far.
  const Eigen::RowVectorXd& largest_violations() const { return largest_; }

  doe::Seed stream(int step, std::uint64_t purpose) const {
    return doe::run_seed(setting_.search.seed, static_cast<std::uint64_t>(step), purpose);
  }

  /// Steps, each of `children` evaluations, that make a generation.
  int steps() const { return std::max(1, setting_.population / setting_.children); }

  /// To be called once per generation, when its evaluations are in. best, worst: as in Course.
  template <class Worst>
  void close_generation(int generation, const Eigen::MatrixXd& best, const Worst& worst) {
    generation_ = generation;
    news_ = SearchProgress{generation, evaluations_, failed_, static_cast<int>(best.rows()),
                           course_.measured(best, worst)};
    ended_ = course_.end(generation_, evaluations_ + per_generation());
  }

 private:
  /// Takes in the evaluated points and gives the next ones, in the unit box; also at the end, since a longer
  /// search may go on from there.
  virtual Eigen::MatrixXd next(Population told) = 0;
  virtual Population best() const = 0;
  virtual void write(CheckpointWriter& out) const = 0;
  virtual void read(CheckpointReader& in) = 0;

  template <class Self, class Stream>
  static void fields(Self& self, Stream& stream) {
    stream.item("generation", self.generation_);
    stream.item("evaluations", self.evaluations_);
    stream.item("failures", self.failed_);
    stream.item("first_reason", self.first_reason_);
    stream.item("largest_violations", self.largest_);
    stream.item("ended", self.ended_);
    stream.item("asked", self.asked_);
    Course::fields(self.course_, stream);
  }

  void take_in(std::vector<doe::Outcome>& outcomes);
  void explain(Front& front) const;

  int per_generation() const { return steps() * setting_.children; }  // evaluations
  Eigen::Index asked() const { return ended_ ? 0 : asked_.rows(); }

  doe::Problem problem_;
  Setting setting_;
  Breeder breeder_;
  Course course_;
  Eigen::MatrixXd asked_;  // at the end: what would be next
  int generation_ = 0, evaluations_ = 0, failed_ = 0;
  std::string first_reason_;  // of the first failure
  Eigen::RowVectorXd largest_;
  std::optional<StopReason> ended_;
  std::optional<SearchProgress> news_;  // of the generation that ended, until the caller has been told
  mutable bool told_ = false;           // and nobody has asked for the next points since
};

inline std::vector<doe::Seed> SearchProcess::seeds() const {
  told_ = false;
  std::vector<doe::Seed> seeds;
  for (Eigen::Index i = 0; i < asked(); ++i)
    seeds.push_back(doe::run_seed(setting_.search.seed, static_cast<std::uint64_t>(evaluations_ + i), 0));
  return seeds;
}

/// Nothing has changed when it throws.
inline void SearchProcess::take_in(std::vector<doe::Outcome>& outcomes) {
  doe::detail::FirstValues first_values(failed_ < evaluations_);
  for (doe::Outcome& outcome : outcomes) {
    outcome = doe::detail::checked(std::move(outcome), problem_);
    first_values.take(outcome, "pareto::Search");
  }
  for (const doe::Outcome& outcome : outcomes)
    if (outcome.failed() && failed_++ == 0) first_reason_ = outcome.reason();
}

inline void SearchProcess::tell(std::vector<doe::Outcome> outcomes) {
  if (ended_)
    throw std::invalid_argument("pareto::Search::tell: the search has ended (" +
                                std::string(to_string(*ended_)) + "); ask done() first");
  if (static_cast<Eigen::Index>(outcomes.size()) != asked_.rows())
    throw std::invalid_argument("pareto::Search::tell: " + std::to_string(outcomes.size()) +
                                " outcomes for " + std::to_string(asked_.rows()) +
                                " points; give one per row of ask()");
  if (told_)
    throw std::invalid_argument(
        "pareto::Search::tell: outcomes were told twice for the points of one ask(); the next points are "
        "others: call ask() and give their outcomes");
  take_in(outcomes);
  told_ = true;
  evaluations_ += static_cast<int>(outcomes.size());
  Population told = assess(problem_, std::move(asked_), outcomes);
  const Eigen::RowVectorXd largest = told.violations.colwise().maxCoeff();
  largest_ = largest_.size() == 0 ? largest : largest_.cwiseMax(largest);
  news_.reset();
  asked_ = next(std::move(told));
  if (news_ && setting_.search.progress) setting_.search.progress(*news_);
}

/// The points of `order`, sorted by their objectives, that are no copy of one before them: same X, same
/// responses. Only points that tie in all objectives are compared.
inline std::vector<int> without_copies(const std::vector<int>& order, const Eigen::MatrixXd& Y,
                                       const Eigen::MatrixXd& X, const Eigen::MatrixXd& responses) {
  std::vector<int> kept;
  for (const int i : order) {
    bool copy = false;
    for (auto k = kept.rbegin(); k != kept.rend() && !copy && Y.row(*k) == Y.row(i); ++k)
      copy = X.row(*k) == X.row(i) && responses.row(*k) == responses.row(i);
    if (!copy) kept.push_back(i);
  }
  return kept;
}

/// Without a feasible point: why there is none. With one: what may be missing.
inline void SearchProcess::explain(Front& front) const {
  constexpr double few = 0.02;  // of the evaluations
  const std::string all = std::to_string(evaluations_);
  if (front.X.rows() > 0) {
    if (failed_ > few * evaluations_)
      front.message = std::to_string(failed_) + " of " + all +
                      " evaluations failed, and the front lacks what lies there; the first: " + first_reason_;
  } else if (evaluations_ == 0) {
    front.status = SearchStatus::nothing_evaluated;
    front.message = "the search was stopped before its first population was evaluated";
  } else if (failed_ == evaluations_) {
    front.status = SearchStatus::all_failed;
    front.message = "all " + all + " evaluations failed; the first: " + first_reason_;
  } else {
    front.status = SearchStatus::no_feasible_point;
    front.message =
        "none of " + all + " evaluations met every limit; relax a limit, widen the bounds or search longer";
  }
}

inline Front SearchProcess::front() const {
  const Roles role = roles(problem_);
  Front front;
  for (const int j : role.objectives) front.objectives.push_back(problem_.responses[j].name);
  const Population points = evaluations_ == 0 ? assess(problem_, asked_.topRows(0), {}) : best();
  const Eigen::MatrixXd X = breeder_.space().natural(points.U);
  const std::vector<int> order = without_copies(sorted_points(points.Y).order, points.Y, X, points.responses);
  front.X = X(order, Eigen::all);
  front.responses = points.responses(order, Eigen::all);
  front.Y = front.responses(Eigen::all, role.objectives);
  front.evaluations = evaluations_;
  front.failed = failed_;
  front.generations = generation_;
  front.stopped_by = ended_.value_or(StopReason::stopped);
  explain(front);
  return front;
}

}  // namespace drawpoint::pareto::detail
