// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The outcomes of a black box at the points that a search asks for, on several threads.
///
/// A batch function gets all points in one call and sees to threads and stopping itself. Otherwise each
/// thread takes the next point until none is left or stop is requested; outcomes stand in the order of the
/// points, so the number of threads changes nothing.

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/detail/threads.hpp>

namespace drawpoint::pareto::detail {

/// X: n x d; one seed per row. Nothing when stop was requested before all points were evaluated.
template <doe::BlackBox F>
std::optional<std::vector<doe::Outcome>> outcomes_of(const F& f, const doe::Problem& problem,
                                                     const Eigen::MatrixXd& X,
                                                     const std::vector<doe::Seed>& seeds, int threads,
                                                     const std::stop_token& stop) {
  doe::detail::check_variables(f, X.cols());
  if constexpr (doe::BatchFunction<F>) {
    return doe::detail::call_batch(f, problem, X, seeds);
  } else {
    std::vector<doe::Outcome> outcomes(seeds.size(), doe::Outcome(Eigen::VectorXd()));
    std::atomic<std::size_t> next{0};
    std::atomic<bool> cut{false};
    const auto work = [&] {
      for (std::size_t i; (i = next++) < outcomes.size();) {
        if (stop.stop_requested()) cut = true;
        if (cut) return;
        outcomes[i] =
            doe::detail::call(f, problem, X.row(static_cast<Eigen::Index>(i)).transpose(), seeds[i], stop);
        // A run that was asked to end early does not count.
        if (doe::StoppableFunction<F> && outcomes[i].failed() && stop.stop_requested()) cut = true;
      }
    };
    {
      std::vector<std::jthread> others;
      const auto most = static_cast<std::size_t>(doe::detail::thread_count(threads));
      for (std::size_t t = 1; t < std::min(most, outcomes.size()); ++t) others.emplace_back(work);
      work();
    }
    if (cut) return std::nullopt;
    return outcomes;
  }
}

}  // namespace drawpoint::pareto::detail
