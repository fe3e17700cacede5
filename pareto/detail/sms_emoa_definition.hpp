// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Survival of SMS-EMOA: of the front that does not fit, the least contribution to its hypervolume goes first.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/pareto/detail/compiled.hpp>
#include <drawpoint/pareto/detail/evolution.hpp>
#include <drawpoint/pareto/detail/roles.hpp>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/sms_emoa.hpp>

namespace drawpoint::pareto {
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
    const Eigen::MatrixXd scaled = over(Y.rowwise() - low, range);
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

inline std::unique_ptr<SearchProcess> process_of(const doe::Problem& problem, const SmsEmoaOptions& options) {
  const Setting setting = setting_of(problem, options);
  return std::make_unique<Evolution<VolumeSurvival>>(
      problem, setting, VolumeSurvival(setting.population, options.reference_offset));
}

}  // namespace detail

DRAWPOINT_PARETO_INLINE SmsEmoa::SmsEmoa(const doe::Problem& problem, const SmsEmoaOptions& options)
    : Search(detail::process_of(problem, options)) {}

}  // namespace drawpoint::pareto
