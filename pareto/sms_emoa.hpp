// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// SMS-EMOA: survival by hypervolume, for the front of fixed size with the largest one.
///
/// Beume, Naujoks, Emmerich 2007, "SMS-EMOA: Multiobjective selection based on dominated hypervolume":
/// parents at random; of the front that does not fit whole, the point that contributes least to that front's
/// hypervolume goes, again and again until it fits. The contributions are those of the objectives scaled to
/// [0, 1] on that front, the reference point at 1 + reference_offset, so units do not matter. The original
/// makes one child at a time; more children per step suit a black box that runs in parallel. A hundred cost 2 %
/// of the hypervolume on ZDT6, at most 0.2 % on other fronts that both find, and keep more of OSY's pieces
/// (docs/measurements/pareto.md). Cost of a removal: contributions of up to N + children points
/// (hypervolume.hpp). Up to eight objectives; beyond five NSGA-III is much quicker.

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/pareto/detail/evolution.hpp>
#include <drawpoint/pareto/hypervolume.hpp>

namespace drawpoint::pareto {

struct SmsEmoaOptions {
  SearchOptions search{};  ///< a generation is `population` children
  int children = 1;        ///< per step, 1 to population; as many as the black box evaluates at once
  /// Above 0: the larger, the more the ends of the front weigh. 0.1 keeps the ends without favouring them
  /// much at 100 points (Ishibuchi et al. 2018 advise one over the number of divisions of an even front).
  double reference_offset = 0.1;
};

namespace detail {

class VolumeSurvival {
 public:
  VolumeSurvival(int population, double reference_offset)
      : population_(population), reference_offset_(reference_offset) {}

  Survivors operator()(const Population& pool, const Ranking& ranking, doe::RandomStream&) const {
    std::vector<int> rows;
    for (std::size_t i = 0; i < ranking.fronts.size(); ++i) {
      const auto places = static_cast<std::size_t>(population_) - rows.size();
      const std::vector<int>& front = ranking.fronts[i];
      if (front.size() > places && i < ranking.feasible) {
        const std::vector<int> kept = reduced(pool, front, places);
        rows.insert(rows.end(), kept.begin(), kept.end());
      } else {
        const auto taken = static_cast<std::ptrdiff_t>(std::min(front.size(), places));
        rows.insert(rows.end(), front.begin(), front.begin() + taken);
      }
    }
    const std::size_t size = rows.size();
    return {std::move(rows), std::vector<int>(size, 0), std::vector<double>(size, 0.0)};
  }

 private:
  std::vector<int> reduced(const Population& pool, const std::vector<int>& front, std::size_t places) const {
    const Eigen::MatrixXd Y = pool.Y(front, Eigen::all);
    const Eigen::RowVectorXd low = Y.colwise().minCoeff();
    Eigen::RowVectorXd range = Y.colwise().maxCoeff() - low;
    for (double& r : range)
      if (r <= 0.0) r = 1.0;
    const Eigen::MatrixXd scaled = (Y.rowwise() - low) * range.cwiseInverse().asDiagonal();
    const Eigen::VectorXd reference = Eigen::VectorXd::Constant(Y.cols(), 1.0 + reference_offset_);
    check_volume_input("pareto::sms_emoa: ", scaled, reference);
    Boxes left = boxes(scaled, reference);
    std::vector<int> kept(front.size());
    std::iota(kept.begin(), kept.end(), 0);
    while (kept.size() > places) {
      const Eigen::VectorXd share = contributions(left, scaled.rows());
      const auto least =
          std::min_element(kept.begin(), kept.end(), [&](int a, int b) { return share[a] < share[b]; });
      left.remove(*least);
      kept.erase(least);
    }
    for (int& i : kept) i = front[i];
    return kept;
  }

  int population_;
  double reference_offset_;
};

inline Setting setting_of(const doe::Problem& problem, const SmsEmoaOptions& o) {
  Setting setting = setting_for("pareto::sms_emoa: ", problem, o.search, {});
  const auto m = roles(problem).objectives.size();
  check_range(setting.place, "children", o.children, o.children >= 1 && o.children <= setting.population,
              "1 to population");
  check_range(setting.place, "reference_offset", o.reference_offset, o.reference_offset > 0.0, "above 0");
  check_range(setting.place, "number of objectives", static_cast<double>(m),
              m <= static_cast<std::size_t>(most_volume_objectives), "up to 8; use pareto::nsga3");
  setting.children = o.children;
  setting.own = {{"reference_offset", doe::detail::number_text(o.reference_offset)}};
  return setting;
}

}  // namespace detail

/// Driven from outside (ask_and_tell.hpp). Throws as Nsga2 does, and beyond eight objectives.
class SmsEmoa : public detail::Evolution<detail::VolumeSurvival> {
 public:
  explicit SmsEmoa(const doe::Problem& problem, const SmsEmoaOptions& options = {})
      : SmsEmoa(problem, options, detail::setting_of(problem, options)) {}

 private:
  SmsEmoa(const doe::Problem& problem, const SmsEmoaOptions& options, const detail::Setting& setting)
      : Evolution(problem, setting, detail::VolumeSurvival(setting.population, options.reference_offset)) {}
};

/// As nsga2: same problems, same errors, same result.
template <class F>
Front sms_emoa(const F& black_box, const doe::Problem& problem, const SmsEmoaOptions& options = {}) {
  doe::require_black_box<F>();
  if constexpr (doe::BlackBox<F>) {
    SmsEmoa search(problem, options);
    return finish(search, black_box);
  } else {
    return {};  // so that the message above stands alone
  }
}

}  // namespace drawpoint::pareto
