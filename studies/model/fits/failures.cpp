// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/failures.h>
#include <drawpoint/studies/model/fits/same_place.h>
#include <drawpoint/doe/detail/unit_box.hpp>

#include <cstdio>
#include <map>

namespace drawpoint::studies {
namespace {

using Place = std::vector<double>;

/// Where every run failed.
std::vector<Place> lost_places(const doe::Evaluations& runs) {
  std::map<Place, bool> failed;
  for (const auto& row : runs.rows) {
    const auto place = failed.emplace(Place(row.x.begin(), row.x.end()), true).first;
    place->second = place->second && row.outcome.failed();
  }
  std::vector<Place> lost;
  for (const auto& [place, all] : failed) {
    if (all) lost.push_back(place);
  }
  return lost;
}

}  // namespace

Failures::Failures(const Tables& tables) : problem_(tables.training.problem) {
  doe::Evaluations all = tables.training;
  all.rows.insert(all.rows.end(), tables.validation.rows.begin(), tables.validation.rows.end());
  if (all.failed() == 0) return;
  model_ = kriging::fit_success(all);
  const std::vector<Place> lost = lost_places(all);
  lost_.resize(static_cast<Eigen::Index>(lost.size()), static_cast<Eigen::Index>(problem_.variables.size()));
  for (std::size_t i = 0; i < lost.size(); ++i)
    lost_.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(lost[i].data(), lost_.cols());
  lost_ = doe::detail::to_unit_box(std::move(lost_), problem_);
}

Eigen::VectorXd Failures::probability_of_success(const Eigen::MatrixXd& X) const {
  return model_ ? model_->probability(X) : Eigen::VectorXd(Eigen::VectorXd::Ones(X.rows()));
}

std::vector<bool> Failures::avoided(const Eigen::MatrixXd& X) const {
  std::vector<bool> answer(static_cast<std::size_t>(X.rows()), false);
  if (none()) return answer;
  const bool tells = model_->place_tells() || model_->failures() == model_->runs();
  const Eigen::VectorXd P = model_->probability(X);
  const Eigen::MatrixXd U = doe::detail::to_unit_box(X, problem_);
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    const auto distance = (lost_.rowwise() - U.row(i)).cwiseAbs().rowwise().maxCoeff();
    answer[static_cast<std::size_t>(i)] =
        (tells && P[i] < 0.5) || (lost_.rows() > 0 && distance.minCoeff() <= same_place);
  }
  return answer;
}

std::string Failures::text() const {
  if (none()) return "";
  char scores[96];
  std::snprintf(scores, sizeof scores,
                " (mean log probability of left-out runs %.2f, by their share alone %.2f)",
                model_->left_out_score(), model_->share_score());
  return std::string(model_->place_tells() ? "The place tells" : "The place does not tell") +
         " which runs fail" + scores;
}

}  // namespace drawpoint::studies
