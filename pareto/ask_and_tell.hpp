// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A search that is driven from outside, by whoever makes the runs, and that can be put on disk.
///
///   Nsga2 search(problem, options);          // or Nsga3, SmsEmoa, Moead
///   while (!search.done()) {
///     const Eigen::MatrixXd X = search.ask();  // one point per row, natural units
///     search.tell(outcomes_at(X));             // one doe::Outcome per row
///   }
///   const Front front = search.front();
///
/// `finish(search, f)` is that loop for a black box f; `nsga2(f, problem, options)` is no more than it. A
/// search keeps copies of its problem and options. `save` writes everything that decides how it goes on; a
/// search of the same problem and options that `restore`s the file goes on to the same bits, whenever it was
/// saved and on however many threads (the random numbers are counter-based: a step number is enough). What
/// may differ: `threads`, `stop`, `progress`, and the stopping rules, which decide how far a search goes and
/// not where. With rules that would have let it come as far, a restored search goes on to the same bits as
/// one that had them from the first, also when it had ended. With rules that would have ended it earlier, it
/// ends with the generation under way. The hypervolumes of the stall rule are kept while the rule is there.
/// Size of a checkpoint: about 20 bytes per number of the population and the archive.

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/detail/atomic_file.hpp>
#include <drawpoint/pareto/detail/checkpoint.hpp>
#include <drawpoint/pareto/detail/course.hpp>
#include <drawpoint/pareto/detail/evaluation.hpp>
#include <drawpoint/pareto/detail/population.hpp>
#include <drawpoint/pareto/detail/variation.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto {

class Search {
 public:
  virtual ~Search() = default;

  const doe::Problem& problem() const { return problem_; }
  const SearchOptions& options() const { return setting_.search; }

  /// Ended by its own rules, or `stop` is requested; in the second case it may go on later.
  bool done() const { return ended_ || setting_.search.stop.stop_requested(); }

  /// n x d, natural units, whole numbers where the variable takes no others: the points to be evaluated next.
  /// The same until they are told; no rows once the search has ended.
  Eigen::MatrixXd ask() const { return breeder_.space().natural(asked_.topRows(asked())); }

  /// One per row of ask(), for black boxes that take one; no two points of a search share a seed.
  std::vector<doe::Seed> seeds() const;

  /// outcomes: one per row of ask(), in that order; a wrong count of values or a value that is not finite
  /// counts as a failure. Calls `progress` last, at the end of a generation; it may save the search. Throws
  /// std::invalid_argument for another number of outcomes, where the first of the search that has values has
  /// another number than the problem has responses, and once the search has ended.
  void tell(std::vector<doe::Outcome> outcomes);

  /// The best points so far, in rising order of the minimised objectives. Before the end `stopped_by` is
  /// `stopped`.
  Front front() const;

  /// Whole or not at all: a fault leaves the old file. Throws std::runtime_error when it cannot be written.
  void save(const std::filesystem::path& path) const {
    detail::CheckpointWriter out(detail::head_of(problem_, setting_));
    fields(*this, out);
    write(out);
    doe::write_file(path, out.text());
  }

  /// Into a search of the same kind, problem and options, but for what may differ; what it did before is
  /// forgotten. Throws std::runtime_error, and leaves the search as it was, when the file cannot be read, is
  /// cut off or altered, or is of another search, problem or other options.
  void restore(const std::filesystem::path& path) {
    detail::CheckpointReader in(path, detail::head_of(problem_, setting_));
    fields(*this, in);
    read(in);
    course_.forget_unused();
    if (ended_ && in.rules_differ()) ended_ = course_.end(generation_, evaluations_ + per_generation());
  }

 protected:
  Search(doe::Problem problem, detail::Setting setting)
      : problem_(std::move(problem)),
        setting_(std::move(setting)),
        breeder_(detail::SearchSpace(problem_, setting_.search.start), setting_.rates),
        course_(setting_.place, setting_.search.stopping, detail::roles(problem_).objectives.size()),
        asked_(breeder_.space().start(setting_.population, stream(0, detail::start_stream))) {}
  Search(const Search&) = default;
  Search(Search&&) = default;
  Search& operator=(const Search&) = default;
  Search& operator=(Search&&) = default;

  const detail::Setting& setting() const { return setting_; }
  const detail::Breeder& breeder() const { return breeder_; }

  /// By constraint, over all evaluations so far.
  const Eigen::RowVectorXd& largest_violations() const { return largest_; }

  doe::Seed stream(int step, std::uint64_t purpose) const {
    return doe::run_seed(setting_.search.seed, static_cast<std::uint64_t>(step), purpose);
  }

  /// Steps, each of `children` evaluations, that make a generation.
  int steps() const { return std::max(1, setting_.population / setting_.children); }

  /// To be called once per generation, when its evaluations are in. best, worst: as in detail::Course.
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
  virtual Eigen::MatrixXd next(detail::Population told) = 0;
  virtual detail::Population best() const = 0;
  virtual void write(detail::CheckpointWriter& out) const = 0;
  virtual void read(detail::CheckpointReader& in) = 0;

  template <class Self, class Stream>
  static void fields(Self& self, Stream& stream) {
    stream.item("generation", self.generation_);
    stream.item("evaluations", self.evaluations_);
    stream.item("failures", self.failed_);
    stream.item("first_reason", self.first_reason_);
    stream.item("largest_violations", self.largest_);
    stream.item("ended", self.ended_);
    stream.item("asked", self.asked_);
    detail::Course::fields(self.course_, stream);
  }

  void take_in(std::vector<doe::Outcome>& outcomes);
  void explain(Front& front) const;

  int per_generation() const { return steps() * setting_.children; }  // evaluations
  Eigen::Index asked() const { return ended_ ? 0 : asked_.rows(); }

  doe::Problem problem_;
  detail::Setting setting_;
  detail::Breeder breeder_;
  detail::Course course_;
  Eigen::MatrixXd asked_;  // at the end: what would be next
  int generation_ = 0, evaluations_ = 0, failed_ = 0;
  std::string first_reason_;  // of the first failure
  Eigen::RowVectorXd largest_;
  std::optional<StopReason> ended_;
  std::optional<SearchProgress> news_;  // of the generation that ended, until the caller has been told
};

inline std::vector<doe::Seed> Search::seeds() const {
  std::vector<doe::Seed> seeds;
  for (Eigen::Index i = 0; i < asked(); ++i)
    seeds.push_back(doe::run_seed(setting_.search.seed, static_cast<std::uint64_t>(evaluations_ + i), 0));
  return seeds;
}

/// Nothing has changed when it throws.
inline void Search::take_in(std::vector<doe::Outcome>& outcomes) {
  doe::detail::FirstValues first_values(failed_ < evaluations_);
  for (doe::Outcome& outcome : outcomes) {
    outcome = doe::detail::checked(std::move(outcome), problem_);
    first_values.take(outcome, "pareto::Search");
  }
  for (const doe::Outcome& outcome : outcomes)
    if (outcome.failed() && failed_++ == 0) first_reason_ = outcome.reason();
}

inline void Search::tell(std::vector<doe::Outcome> outcomes) {
  if (ended_)
    throw std::invalid_argument("pareto::Search::tell: the search has ended (" +
                                std::string(to_string(*ended_)) + "); ask done() first");
  if (static_cast<Eigen::Index>(outcomes.size()) != asked_.rows())
    throw std::invalid_argument("pareto::Search::tell: " + std::to_string(outcomes.size()) +
                                " outcomes for " + std::to_string(asked_.rows()) +
                                " points; give one per row of ask()");
  take_in(outcomes);
  evaluations_ += static_cast<int>(outcomes.size());
  detail::Population told = detail::assess(problem_, std::move(asked_), outcomes);
  const Eigen::RowVectorXd largest = told.violations.colwise().maxCoeff();
  largest_ = largest_.size() == 0 ? largest : largest_.cwiseMax(largest);
  news_.reset();
  asked_ = next(std::move(told));
  if (news_ && setting_.search.progress) setting_.search.progress(*news_);
}

/// Without a feasible point: why there is none.
inline void Search::explain(Front& front) const {
  if (front.X.rows() > 0) return;
  const std::string all = std::to_string(evaluations_);
  if (evaluations_ == 0) {
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

inline Front Search::front() const {
  const detail::Roles role = detail::roles(problem_);
  Front front;
  for (const int j : role.objectives) front.objectives.push_back(problem_.responses[j].name);
  const detail::Population points =
      evaluations_ == 0 ? detail::assess(problem_, asked_.topRows(0), {}) : best();
  const std::vector<int> order = detail::sorted_points(points.Y).order;
  front.X = breeder_.space().natural(points.U(order, Eigen::all));
  front.responses = points.responses(order, Eigen::all);
  front.Y = front.responses(Eigen::all, role.objectives);
  front.evaluations = evaluations_;
  front.failed = failed_;
  front.generations = generation_;
  front.stopped_by = ended_.value_or(StopReason::stopped);
  explain(front);
  return front;
}

/// Takes a search to its end, or until `stop` is requested: evaluates what it asks for and tells it, several
/// points at once on options().threads.
template <class F>
Front finish(Search& search, const F& black_box) {
  doe::require_black_box<F>();
  if constexpr (doe::BlackBox<F>) {
    while (!search.done()) {
      auto outcomes = detail::outcomes_of(black_box, search.problem(), search.ask(), search.seeds(),
                                          search.options().threads, search.options().stop);
      if (outcomes) search.tell(std::move(*outcomes));
    }
  }
  return search.front();
}

}  // namespace drawpoint::pareto
