// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// SMS-EMOA: survival by hypervolume, for the front of fixed size with the largest one.
///
/// Beume, Naujoks, Emmerich 2007, "SMS-EMOA: Multiobjective selection based on dominated hypervolume":
/// parents at random; of the front that does not fit whole, the point that contributes least to that front's
/// hypervolume goes, again and again until it fits. The contributions are those of the objectives scaled to
/// [0, 1] on that front, the reference point at 1 + reference_offset, so units do not matter. The original
/// makes one child at a time; more children a step suit a black box that runs in parallel and cost little
/// quality. Cost of a removal: contributions of up to N + children points (hypervolume.hpp). Up to eight
/// objectives; beyond five NSGA-III is much quicker.

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

#include <drawpoint/pareto/detail/evolution.hpp>
#include <drawpoint/pareto/hypervolume.hpp>

namespace drawpoint::pareto {

struct SmsEmoaOptions {
  int population = 100;  ///< points, 2 or more; also the most points of the front
  int children = 1;      ///< a step, 1 to population; as many as the black box evaluates at once
  /// Above 0: the larger, the more the ends of the front weigh. 0.1 keeps the ends without favouring them
  /// much at 100 points (Ishibuchi et al. 2018 advise one over the number of divisions of an even front).
  double reference_offset = 0.1;
  Stopping stopping{};  ///< a generation is `population` children
  Variation variation{};
  std::vector<int> integers{};  ///< places of the integer variables in Problem::variables
  doe::Seed seed = 1;
  ProgressFunction progress{};
};

namespace detail {

class VolumeSurvival {
 public:
  explicit VolumeSurvival(const SmsEmoaOptions& options) : options_(options) {}

  Parents operator()(const Population& pool, const Ranking& ranking, doe::RandomStream&) const {
    std::vector<int> rows;
    for (std::size_t i = 0; i < ranking.fronts.size(); ++i) {
      const auto places = static_cast<std::size_t>(options_.population) - rows.size();
      std::vector<int> front = ranking.fronts[i];
      if (front.size() > places && i < ranking.feasible) front = reduced(pool, front, places);
      front.resize(std::min(front.size(), places));
      rows.insert(rows.end(), front.begin(), front.end());
    }
    return {selected(pool, rows), std::vector<int>(rows.size(), 0), std::vector<double>(rows.size(), 0.0)};
  }

 private:
  std::vector<int> reduced(const Population& pool, std::vector<int> front, std::size_t places) const {
    const Eigen::MatrixXd Y = pool.Y(front, Eigen::all);
    const Eigen::RowVectorXd low = Y.colwise().minCoeff();
    Eigen::RowVectorXd range = Y.colwise().maxCoeff() - low;
    for (double& r : range)
      if (r <= 0.0) r = 1.0;
    const Eigen::MatrixXd scaled = (Y.rowwise() - low) * range.cwiseInverse().asDiagonal();
    const Eigen::VectorXd reference = Eigen::VectorXd::Constant(Y.cols(), 1.0 + options_.reference_offset);
    std::vector<int> kept(front.size());
    for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = static_cast<int>(i);
    while (kept.size() > places) {
      Eigen::Index least;
      hypervolume_contributions(scaled(kept, Eigen::all), reference).minCoeff(&least);
      kept.erase(kept.begin() + least);
    }
    for (int& i : kept) i = front[i];
    return kept;
  }

  const SmsEmoaOptions& options_;
};

inline Setting setting_of(const SmsEmoaOptions& o, const doe::Problem& problem) {
  const Setting setting{.place = "pareto::sms_emoa: ",
                        .population = o.population,
                        .children = o.children,
                        .stopping = o.stopping,
                        .variation = o.variation,
                        .integers = o.integers,
                        .seed = o.seed,
                        .progress = o.progress};
  const auto m = roles(problem).objectives.size();
  check_range(setting.place, "population", o.population, o.population >= 2, "2 or more");
  check_range(setting.place, "children", o.children, o.children >= 1 && o.children <= o.population,
              "1 to population");
  check_range(setting.place, "reference_offset", o.reference_offset, o.reference_offset > 0.0, "above 0");
  check_range(setting.place, "number of objectives", static_cast<double>(m),
              m <= static_cast<std::size_t>(most_volume_objectives), "up to 8; use pareto::nsga3");
  return setting;
}

}  // namespace detail

/// As nsga2: same problems, same errors, same result.
template <class F>
Front sms_emoa(const F& black_box, const doe::Problem& problem, const SmsEmoaOptions& options = {}) {
  doe::require_black_box<F>();
  if constexpr (doe::BlackBox<F>) {
    return detail::evolve(black_box, problem, detail::setting_of(options, problem),
                          detail::VolumeSurvival(options));
  } else {
    return {};  // so that the message above stands alone
  }
}

}  // namespace drawpoint::pareto
