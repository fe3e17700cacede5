// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A black box is anything callable: f(x), f(x, seed), f(x, seed, stop) or f(X, seeds).
///
/// x has one number per variable, X is n x d with one run per row, both in natural units. Equal (x, seed) must
/// give equal outcomes, and a black box may be called from several threads at once: so the call must be
/// const. Where a type offers several forms, the batch form is used, for it is the one that can be faster
/// than its rows one by one. The calls below turn what goes wrong (an exception, a wrong count, a value that
/// is not finite) into a Failure; where the first values have a wrong count, evaluations and searches end. `stop`
/// is a std::stop_token: a long run that looks at it now and then can end early when its time is up or the study
/// is cancelled; what it returns then does not count.

#include <Eigen/Core>
#include <concepts>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <drawpoint/doe/detail/round_off.hpp>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/problem.hpp>

namespace drawpoint::doe {

template <class F>
concept PointFunction = requires(const F& f, const Eigen::VectorXd& x) {
  { f(x) } -> std::convertible_to<Outcome>;
};

template <class F>
concept SeededFunction = requires(const F& f, const Eigen::VectorXd& x, Seed seed) {
  { f(x, seed) } -> std::convertible_to<Outcome>;
};

template <class F>
concept StoppableFunction = requires(const F& f, const Eigen::VectorXd& x, Seed seed, std::stop_token stop) {
  { f(x, seed, stop) } -> std::convertible_to<Outcome>;
};

template <class F>
concept BatchFunction = requires(const F& f, const Eigen::MatrixXd& X, std::span<const Seed> seeds) {
  { f(X, seeds) } -> std::convertible_to<std::vector<Outcome>>;
};

/// Means of a model, which says so by `static constexpr bool predicts = true`. They may leave the ranges that
/// runs keep, and count as the nearest value within.
template <class F>
concept Predictor = bool(std::remove_cvref_t<F>::predicts);

template <class F>
concept BlackBox = PointFunction<F> || SeededFunction<F> || StoppableFunction<F> || BatchFunction<F>;

namespace detail {

// What a type that is no black box comes closest to, so that the compiler's message can name the mistake.
template <class F>
concept TakesThePoint = requires(const F& f, const Eigen::VectorXd& x, const Eigen::MatrixXd& X, Seed seed) {
  f(x);
}
|| requires(const F& f, const Eigen::VectorXd& x, Seed seed) { f(x, seed); }
|| requires(const F& f, const Eigen::VectorXd& x, Seed seed, std::stop_token stop) { f(x, seed, stop); }
|| requires(const F& f, const Eigen::MatrixXd& X, std::span<const Seed> seeds) { f(X, seeds); };

template <class F>
concept CallableOnlyWhenMutable =
    !TakesThePoint<F> &&
    (
        requires(F & f, const Eigen::VectorXd& x) { f(x); } ||
        requires(F & f, const Eigen::VectorXd& x, Seed seed) { f(x, seed); } ||
        requires(F & f, const Eigen::VectorXd& x, Seed seed, std::stop_token stop) { f(x, seed, stop); } ||
        requires(F & f, const Eigen::MatrixXd& X, std::span<const Seed> seeds) { f(X, seeds); });

}  // namespace detail

/// First line of every entry point: stops the compilation with the accepted signatures in words.
template <class F>
constexpr void require_black_box() {
  static_assert(!detail::CallableOnlyWhenMutable<F>,
                "drawpoint: not a black box. Its call operator is not const, yet several threads may call it "
                "at once: write "
                "'operator()(...) const', or remove 'mutable' from the lambda. Expected one of "
                "Outcome f(const Eigen::VectorXd& x) const; "
                "Outcome f(const Eigen::VectorXd& x, doe::Seed seed) const; "
                "Outcome f(const Eigen::VectorXd& x, doe::Seed seed, std::stop_token stop) const; "
                "std::vector<Outcome> f(const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds) const.");
  static_assert(BlackBox<F> || !detail::TakesThePoint<F>,
                "drawpoint: not a black box. It takes the point but returns the wrong type. Expected one of "
                "Outcome f(const Eigen::VectorXd& x); "
                "Outcome f(const Eigen::VectorXd& x, doe::Seed seed); "
                "Outcome f(const Eigen::VectorXd& x, doe::Seed seed, std::stop_token stop); "
                "std::vector<Outcome> f(const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds); "
                "where a double, an Eigen::VectorXd or a doe::Failure converts to Outcome.");
  static_assert(
      BlackBox<F> || detail::TakesThePoint<F> || detail::CallableOnlyWhenMutable<F>,
      "drawpoint: not a black box. It cannot be called with a point. Expected one of "
      "Outcome f(const Eigen::VectorXd& x); "
      "Outcome f(const Eigen::VectorXd& x, doe::Seed seed); "
      "Outcome f(const Eigen::VectorXd& x, doe::Seed seed, std::stop_token stop); "
      "std::vector<Outcome> f(const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds); "
      "where X has one run per row and Outcome may be a double, an Eigen::VectorXd or a doe::Failure.");
}

namespace detail {

/// The outcome, moved to bounds that it misses by round-off (detail/round_off.hpp), when it has one finite value
/// within its range per response, else the Failure that says what is wrong.
inline Outcome checked(Outcome outcome, const Problem& problem) {
  if (outcome.failed()) return outcome;
  Eigen::VectorXd values = outcome.values();
  const auto expected = static_cast<Eigen::Index>(problem.responses.size());
  if (values.size() != expected)
    return Outcome::refused(Outcome::Given::wrong_count, "returned " + std::to_string(values.size()) +
                                                             " values where the problem has " +
                                                             std::to_string(expected) + " responses");
  for (Eigen::Index j = 0; j < expected; ++j) {
    const Response& r = problem.responses[j];
    const std::string is = "response \"" + r.name + "\" is ";
    if (!std::isfinite(values[j]))
      return Outcome::refused(Outcome::Given::one_per_response, is + number_text(values[j]));
    values[j] = without_round_off(r, values[j]);
    if (values[j] < r.lower || values[j] > r.upper)
      return Outcome::refused(Outcome::Given::one_per_response,
                              is + with_unit(values[j], r.unit) + ", outside its range " +
                                  number_text(r.lower) + " to " + with_unit(r.upper, r.unit));
  }
  return Outcome(std::move(values));
}

/// The same of what F returned: a prediction is moved into its range first.
template <class F>
Outcome checked_of(Outcome outcome, const Problem& problem) {
  if constexpr (Predictor<F>) {
    if (outcome.failed() || outcome.values().size() != static_cast<Eigen::Index>(problem.responses.size()))
      return checked(std::move(outcome), problem);
    Eigen::VectorXd values = outcome.values();
    for (Eigen::Index j = 0; j < values.size(); ++j)
      if (std::isfinite(values[j]))
        values[j] = within_range(problem.responses[static_cast<std::size_t>(j)], values[j]);
    return checked(Outcome(std::move(values)), problem);
  } else {
    return checked(std::move(outcome), problem);
  }
}

/// A model of another number of variables is a mistake of the program, not a failed run. Throws
/// std::invalid_argument.
template <class F>
void check_variables(const F& f, Eigen::Index variables) {
  if constexpr (Predictor<F> && requires {
                  { f.variables() } -> std::convertible_to<std::optional<Eigen::Index>>;
                }) {
    const std::optional<Eigen::Index> own = f.variables();
    if (own && *own != variables)
      throw std::invalid_argument("doe: a surrogate of " + std::to_string(*own) +
                                  " variables is asked for points of " + std::to_string(variables) +
                                  "; fit it to the variables of the problem, in their order");
  }
}

/// Whether black box and problem belong together: the first run that gives values, in the order of the runs,
/// tells. A wrong count there is a mistake of the program; one among good runs is a failed run.
class FirstValues {
 public:
  /// `came`: whether runs before these gave values.
  explicit FirstValues(bool came = false) : came_(came) {}

  /// Outcomes in the order of their runs. Throws std::invalid_argument in the name of `who`.
  void take(const Outcome& outcome, const char* who) {
    if (came_) return;
    if (outcome.given() == Outcome::Given::wrong_count)
      throw std::invalid_argument(std::string(who) + ": the black box " + outcome.reason() +
                                  "; return one value per response, in the order of Problem::responses");
    came_ = !outcome.failed() || outcome.given() == Outcome::Given::one_per_response;
  }

 private:
  bool came_;
};

/// Runs `body` and turns whatever it throws into a Failure.
template <class Result, class Body>
Result guarded(const Body& body) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return Result(Failure{"memory ran out; make the run need less, or run fewer at a time"});
  } catch (const std::out_of_range& e) {  // whose words name a function of the standard library
    return Result(
        Failure{std::string("the black box reached beyond the end of a list or table: ") + e.what()});
  } catch (const std::exception& e) {
    return Result(Failure{std::string("exception: ") + e.what()});
  } catch (...) {
    return Result(Failure{"exception of a type that is not a std::exception"});
  }
}

/// All rows of X in one call of a batch function, or one Failure that holds for all of them.
template <BatchFunction F>
std::variant<std::vector<Outcome>, Failure> call_rows(const F& f, const Eigen::MatrixXd& X,
                                                      std::span<const Seed> seeds) {
  using Result = std::variant<std::vector<Outcome>, Failure>;
  return guarded<Result>([&]() -> Result {
    std::vector<Outcome> outcomes = f(X, seeds);
    if (static_cast<Eigen::Index>(outcomes.size()) == X.rows()) return outcomes;
    return Failure{"the batch returned " + std::to_string(outcomes.size()) + " outcomes for " +
                   std::to_string(X.rows()) + " points"};
  });
}

/// One run at x: never throws what the black box throws. `stop` goes to a stoppable function.
template <BlackBox F>
Outcome call(const F& f, const Problem& problem, const Eigen::VectorXd& x, Seed seed,
             const std::stop_token& stop = {}) {
  if constexpr (BatchFunction<F>) {
    auto rows = call_rows(f, x.transpose(), std::span<const Seed>(&seed, 1));
    if (auto* failure = std::get_if<Failure>(&rows)) return std::move(*failure);
    return checked_of<F>(std::move(std::get<0>(rows).front()), problem);
  } else if constexpr (StoppableFunction<F>) {
    return checked_of<F>(guarded<Outcome>([&]() -> Outcome { return f(x, seed, stop); }), problem);
  } else if constexpr (SeededFunction<F>) {
    return checked_of<F>(guarded<Outcome>([&]() -> Outcome { return f(x, seed); }), problem);
  } else {
    return checked_of<F>(guarded<Outcome>([&]() -> Outcome { return f(x); }), problem);
  }
}

/// One run a row of X, in one call when f takes batches; seeds has X.rows() entries.
template <BlackBox F>
std::vector<Outcome> call_batch(const F& f, const Problem& problem, const Eigen::MatrixXd& X,
                                std::span<const Seed> seeds) {
  const auto n = static_cast<std::size_t>(X.rows());
  std::vector<Outcome> outcomes;
  if constexpr (BatchFunction<F>) {
    auto rows = call_rows(f, X, seeds);
    if (auto* failure = std::get_if<Failure>(&rows)) return std::vector<Outcome>(n, Outcome(*failure));
    outcomes = std::move(std::get<0>(rows));
    for (Outcome& outcome : outcomes) outcome = checked_of<F>(std::move(outcome), problem);
  } else {
    outcomes.reserve(n);
    for (std::size_t i = 0; i < n; ++i) outcomes.push_back(call(f, problem, X.row(i).transpose(), seeds[i]));
  }
  return outcomes;
}

}  // namespace detail
}  // namespace drawpoint::doe
