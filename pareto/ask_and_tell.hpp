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
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/pareto/detail/evaluation.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto {

namespace detail {
class SearchProcess;
}

/// One of the methods above, wherever its kind plays no part. Not for several threads at once. A copy goes
/// its own way from where the search stands, but for `stop` and `progress`, which both listen to and tell. A
/// search takes on the kind of what is assigned to it, and may only be assigned to or destroyed once it was
/// moved from. What problem() and options() refer to lasts until the search is assigned to or restored.
class Search {
 public:
  Search(const Search& other);
  Search(Search&& other) noexcept;
  Search& operator=(const Search& other);
  Search& operator=(Search&& other) noexcept;
  virtual ~Search();

  const doe::Problem& problem() const;
  const SearchOptions& options() const;

  /// Ended by its own rules, or `stop` is requested; in the second case it may go on later.
  bool done() const;

  /// n x d, natural units, whole numbers where the variable takes no others: the points to be evaluated next.
  /// The same until they are told; no rows once the search has ended.
  Eigen::MatrixXd ask() const;

  /// One per row of ask(), for black boxes that take one; no two points of a search share a seed.
  std::vector<doe::Seed> seeds() const;

  /// outcomes: one per row of ask(), in that order; a wrong count of values or a value that is not finite
  /// counts as a failure. Calls `progress` last, at the end of a generation; it may save the search. Throws
  /// std::invalid_argument for another number of outcomes, where the first of the search that has values has
  /// another number than the problem has responses, once the search has ended, and for outcomes that are
  /// told a second time: without ask() or seeds() since the last tell(), but after restore().
  void tell(std::vector<doe::Outcome> outcomes);

  /// The best points so far, in rising order of the minimised objectives, each once. Before the end
  /// `stopped_by` is `stopped`.
  Front front() const;

  /// Whole or not at all: a fault leaves the old file. Throws std::runtime_error when it cannot be written.
  void save(const std::filesystem::path& path) const;

  /// Into a search of the same kind, problem and options, but for what may differ; what it did before is
  /// forgotten. Throws std::runtime_error, and leaves the search as it was, when the file cannot be read, is
  /// cut off or altered, or is of another search, problem or other options.
  void restore(const std::filesystem::path& path);

 protected:
  explicit Search(std::unique_ptr<detail::SearchProcess> process);

 private:
  std::unique_ptr<detail::SearchProcess> process_;
};

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

#ifndef DRAWPOINT_PARETO_COMPILED
#include <drawpoint/pareto/detail/search_definitions.hpp>
#endif
