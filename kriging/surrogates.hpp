// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Several surrogates, of one kind or mixed, as one black box: the mean of each, in their order. A search may
/// use it in the place of the simulation, and polishing too, by the gradients of the means.
///
/// It is a doe::BatchFunction: a whole population is predicted at once. Seeds are ignored; the answer is the
/// mean. At one point it gives the means with their derivatives, where every member has them: Model,
/// Polynomial and Radial do.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/value_and_jacobian.hpp>
#include <drawpoint/kriging/any_surrogate.hpp>
#include <drawpoint/kriging/model.hpp>

namespace drawpoint::kriging {

class Surrogates {
 public:
  /// One surrogate per response, all of the same variables. Throws std::invalid_argument when there is none
  /// or they differ.
  explicit Surrogates(std::vector<AnySurrogate> members) : members_(std::move(members)) { check(); }

  /// The same of one kind, such as std::vector<Model>.
  template <Surrogate S>
  explicit Surrogates(const std::vector<S>& members) : members_(members.begin(), members.end()) {
    check();
  }

  /// X: m x d, natural units. Gives m outcomes of one value per member.
  std::vector<doe::Outcome> operator()(const Eigen::MatrixXd& X, std::span<const doe::Seed>) const {
    Eigen::MatrixXd Y(members_.size(), X.rows());
    for (std::size_t j = 0; j < members_.size(); ++j) Y.row(j) = members_[j].mean(X).transpose();
    std::vector<doe::Outcome> outcomes;
    outcomes.reserve(X.rows());
    for (Eigen::Index i = 0; i < X.rows(); ++i) outcomes.emplace_back(Eigen::VectorXd(Y.col(i)));
    return outcomes;
  }

  /// The means at one point x of d entries and their derivatives: one row per member. Throws
  /// std::invalid_argument for a member without mean_gradient.
  doe::ValueAndJacobian operator()(const Eigen::VectorXd& x) const {
    const auto r = static_cast<Eigen::Index>(members_.size());
    doe::ValueAndJacobian y{Eigen::VectorXd(r), Eigen::MatrixXd(r, x.size())};
    for (Eigen::Index j = 0; j < r; ++j) {
      const AnySurrogate& member = members_[static_cast<std::size_t>(j)];
      const std::optional<Eigen::VectorXd> gradient = member.mean_gradient(x);
      if (!gradient)
        throw std::invalid_argument("kriging::Surrogates: member " + std::to_string(j) +
                                    " has no derivatives; allowed are surrogates with mean_gradient(x); "
                                    "search without polishing, or fit another kind");
      y.values[j] = member(x);
      y.jacobian.row(j) = gradient->transpose();
    }
    return y;
  }

  static constexpr bool predicts = true;  ///< for doe::Predictor
  /// Returns how many variables the members have, as the first that knows it says.
  std::optional<Eigen::Index> variables() const {
    for (const AnySurrogate& member : members_)
      if (const std::optional<Eigen::Index> d = member.variables()) return d;
    return std::nullopt;
  }

  const std::vector<AnySurrogate>& members() const { return members_; }

 private:
  void check() const {
    if (members_.empty())
      throw std::invalid_argument(
          "kriging::Surrogates: 0 models; allowed is 1 or more; give one per response");
    std::optional<Eigen::Index> first;
    for (const AnySurrogate& member : members_) {
      const std::optional<Eigen::Index> d = member.variables();
      if (!first) first = d;
      if (d && *d != *first)
        throw std::invalid_argument("kriging::Surrogates: a model of " + std::to_string(*d) +
                                    " variables beside one of " + std::to_string(*first) +
                                    "; fit all responses to the same X");
    }
  }

  std::vector<AnySurrogate> members_;
};

static_assert(doe::BatchFunction<Surrogates> && doe::PointFunction<Model>);

}  // namespace drawpoint::kriging
