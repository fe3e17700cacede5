// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fronts/front.h>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/pareto/nsga2.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <span>
#include <vector>

namespace drawpoint::studies {
namespace {

void keep_rows(pareto::PolishedFront& found, const std::vector<int>& kept) {
  pareto::Front& front = found.front;
  front.X = front.X(kept, Eigen::all).eval();
  front.Y = front.Y(kept, Eigen::all).eval();
  front.responses = front.responses(kept, Eigen::all).eval();
  if (found.polishing.residual.size() > 0) found.polishing.residual = found.polishing.residual(kept).eval();
}

Eigen::MatrixXd below(const Eigen::MatrixXd& upper, const Eigen::MatrixXd& lower) {
  Eigen::MatrixXd both(upper.rows() + lower.rows(), lower.cols());
  if (upper.rows() > 0) both.topRows(upper.rows()) = upper;
  both.bottomRows(lower.rows()) = lower;
  return both;
}

/// Points that nobody polished: their residuals are unknown.
void append(pareto::PolishedFront& found, const pareto::Front& searched) {
  pareto::Front& front = found.front;
  front.X = below(front.X, searched.X);
  front.Y = below(front.Y, searched.Y);
  front.responses = below(front.responses, searched.responses);
  Eigen::VectorXd& residual = found.polishing.residual;
  if (residual.size() == 0) return;
  const Eigen::Index known = residual.size();
  residual.conservativeResize(front.X.rows());
  residual.tail(front.X.rows() - known).setConstant(std::numeric_limits<double>::quiet_NaN());
}

/// The first of points that are equal, as whole and categorical variables make them.
void keep_different(pareto::PolishedFront& found) {
  std::set<std::vector<double>> seen;
  std::vector<int> kept;
  for (Eigen::Index i = 0; i < found.front.X.rows(); ++i) {
    const Eigen::VectorXd x = found.front.X.row(i);
    if (seen.emplace(x.begin(), x.end()).second) kept.push_back(static_cast<int>(i));
  }
  if (static_cast<Eigen::Index>(kept.size()) < found.front.X.rows()) keep_rows(found, kept);
}

bool fails_everywhere(const Failures& failures, const Tables& tables) {
  const auto avoided = [&](const doe::Evaluation& row) {
    return failures.avoided(row.x.transpose()).front();
  };
  return !failures.none() && std::all_of(tables.training.rows.begin(), tables.training.rows.end(), avoided);
}

}  // namespace

pareto::PolishedFront front_of(const std::vector<kriging::TransformedModel>& models,
                               const doe::Problem& problem, doe::Seed seed, const Failures& failures) {
  const kriging::Surrogates means(models);
  const auto avoiding = [&](const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds) {
    std::vector<doe::Outcome> outcomes = means(X, seeds);
    const std::vector<bool> avoided = failures.avoided(X);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (avoided[i]) outcomes[i] = doe::Failure{"a run is likely to fail"};
    }
    return outcomes;
  };
  const pareto::Front searched = pareto::nsga2(avoiding, problem, {.search = {.seed = seed}});
  auto found = pareto::polished_front(means, problem, searched);
  if (!failures.none()) {  // what polishing led into the failures must not push out what it came from
    leave_out_failed(found, failures);
    append(found, searched);
  }
  keep_within_range(found, problem);
  keep_different(found);
  return found;
}

bool has_objective(const doe::Problem& problem) {
  return std::any_of(problem.responses.begin(), problem.responses.end(),
                     [](const doe::Response& response) { return doe::is_objective(response.goal); });
}

namespace {

/// Why there is nothing to search for; empty where there is.
std::string no_objective(const doe::Problem& asked, const std::vector<FlatResponse>& flat) {
  if (!has_objective(asked)) return "no response is to be minimized or maximized";
  if (has_objective(without_flat(asked, flat))) return "";
  return "no model of an objective (" + flat_objectives(flat, asked) +
         ") differs between strategies by clearly more than its own error";
}

}  // namespace

PredictedFront predicted_front(const std::vector<kriging::TransformedModel>& models, const Tables& tables,
                               doe::Seed seed) {
  const doe::Problem& asked = tables.training.problem;
  PredictedFront predicted{.found = {}, .failures = Failures(tables), .flat = flat_responses(models, asked)};
  predicted.problem = without_flat(asked, predicted.flat);
  if (predicted.missing = no_objective(asked, predicted.flat); !predicted.missing.empty()) return predicted;
  predicted.found = front_of(models, predicted.problem, seed, predicted.failures);
  if (predicted.found.front.X.rows() > 0) return predicted;
  predicted.missing = predicted.found.front.message;
  if (fails_everywhere(predicted.failures, tables))
    predicted.missing = "a run is likely to fail wherever one was made; " + predicted.failures.text();
  if (predicted.missing.empty()) predicted.missing = "every point found lies where runs fail";
  return predicted;
}

void keep_within_range(pareto::PolishedFront& found, const doe::Problem& problem) {
  pareto::Front& front = found.front;
  if (front.X.rows() == 0) return;
  for (std::size_t r = 0, objective = 0; r < problem.responses.size(); ++r) {
    const doe::Response& response = problem.responses[r];
    const auto bounded = [&](double y) { return doe::within_range(response, y); };
    auto column = front.responses.col(static_cast<Eigen::Index>(r));
    column = column.unaryExpr(bounded).eval();
    if (doe::is_objective(response.goal)) front.Y.col(static_cast<Eigen::Index>(objective++)) = column;
  }
  keep_rows(found, pareto::non_dominated(problem, front.Y));
}

void leave_out_failed(pareto::PolishedFront& found, const Failures& failures) {
  if (failures.none() || found.front.X.rows() == 0) return;
  const std::vector<bool> avoided = failures.avoided(found.front.X);
  std::vector<int> kept;
  for (std::size_t i = 0; i < avoided.size(); ++i) {
    if (!avoided[i]) kept.push_back(static_cast<int>(i));
  }
  keep_rows(found, kept);
}

}  // namespace drawpoint::studies
