// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Several models as one black box: the mean of each, in their order. A search may use it in the place of the
/// simulation.
///
/// It is a doe::BatchFunction: a whole population is predicted at once. Seeds are ignored; the answer is the
/// mean.

#include <Eigen/Core>
#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/kriging/model.hpp>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

class Surrogates {
 public:
  /// One model a response, all of the same variables. Throws std::invalid_argument when there is none or they
  /// differ.
  explicit Surrogates(std::vector<Model> models) : models_(std::move(models)) {
    if (models_.empty())
      throw std::invalid_argument("kriging::Surrogates: 0 models; allowed is 1 or more; give one a response");
    for (const Model& model : models_)
      if (model.variables() != models_.front().variables())
        throw std::invalid_argument("kriging::Surrogates: a model of " + std::to_string(model.variables()) +
                                    " variables beside one of " +
                                    std::to_string(models_.front().variables()) +
                                    "; fit all responses to the same X");
  }

  /// X: m x d, natural units. Gives m outcomes of one value a model.
  std::vector<doe::Outcome> operator()(const Eigen::MatrixXd& X, std::span<const doe::Seed>) const {
    Eigen::MatrixXd Y(models_.size(), X.rows());
    for (std::size_t j = 0; j < models_.size(); ++j) Y.row(j) = models_[j].mean(X).transpose();
    std::vector<doe::Outcome> outcomes;
    outcomes.reserve(X.rows());
    for (Eigen::Index i = 0; i < X.rows(); ++i) outcomes.emplace_back(Eigen::VectorXd(Y.col(i)));
    return outcomes;
  }

  const std::vector<Model>& models() const { return models_; }

 private:
  std::vector<Model> models_;
};

/// The means of models of the same d variables at one point: one entry a model. Throws as Model::mean.
inline Eigen::VectorXd means_at(const std::vector<Model>& models, const Eigen::VectorXd& x) {
  Eigen::VectorXd y(static_cast<Eigen::Index>(models.size()));
  for (std::size_t j = 0; j < models.size(); ++j) y[static_cast<Eigen::Index>(j)] = models[j](x);
  return y;
}

/// Their derivatives: models x d. Throws as Model::mean_gradient.
inline Eigen::MatrixXd mean_gradients_at(const std::vector<Model>& models, const Eigen::VectorXd& x) {
  Eigen::MatrixXd J(static_cast<Eigen::Index>(models.size()), x.size());
  for (std::size_t j = 0; j < models.size(); ++j)
    J.row(static_cast<Eigen::Index>(j)) = models[j].mean_gradient(x).transpose();
  return J;
}

static_assert(doe::BatchFunction<Surrogates> && doe::PointFunction<Model>);

}  // namespace drawpoint::kriging
