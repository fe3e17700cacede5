// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/failed_places.h>
#include <drawpoint/doe/detail/nearest.hpp>
#include <drawpoint/doe/detail/unit_box.hpp>

#include <algorithm>
#include <map>

namespace drawpoint::studies {

FailedPlaces::FailedPlaces(const Tables& tables) : problem_(tables.training.problem) {
  std::map<std::vector<double>, bool> places;  // whether every run failed there
  for (const auto* table : {&tables.training, &tables.validation}) {
    for (const auto& row : table->rows) {
      const auto place = places.emplace(std::vector<double>(row.x.begin(), row.x.end()), true).first;
      place->second = place->second && row.outcome.failed();
    }
  }
  Eigen::MatrixXd X(static_cast<Eigen::Index>(places.size()),
                    static_cast<Eigen::Index>(problem_.variables.size()));
  for (const auto& [x, failed] : places) {
    X.row(static_cast<Eigen::Index>(failed_.size())) =
        Eigen::Map<const Eigen::RowVectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
    failed_.push_back(failed);
  }
  places_ = doe::detail::to_unit_box(std::move(X), problem_);
  any_ = std::find(failed_.begin(), failed_.end(), true) != failed_.end();
}

std::vector<bool> FailedPlaces::beside(const Eigen::MatrixXd& X) const {
  std::vector<bool> answer(static_cast<std::size_t>(X.rows()), false);
  if (!any_) return answer;
  const auto nearest = doe::detail::nearest_sites(doe::detail::to_unit_box(X, problem_), places_);
  for (std::size_t i = 0; i < answer.size(); ++i)
    answer[i] = failed_[static_cast<std::size_t>(nearest.site[i])];
  return answer;
}

}  // namespace drawpoint::studies
