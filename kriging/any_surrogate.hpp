// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Any surrogate behind one type, so that different kinds stand in one list.
///
/// A value: copies share the surrogate, which nothing changes. Costs one virtual call a block of points.

#include <Eigen/Core>
#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/reinterpolation.hpp>
#include <drawpoint/kriging/surrogate.hpp>

namespace drawpoint::kriging {

class AnySurrogate {
 public:
  template <class S>
  requires(!std::same_as<std::remove_cvref_t<S>, AnySurrogate> && Surrogate<std::remove_cvref_t<S>>)
      AnySurrogate(S&& surrogate)  // NOLINT: conversion is its purpose
      : held_(std::make_shared<Holder<std::remove_cvref_t<S>>>(std::forward<S>(surrogate))) {}

  Prediction predict(const Eigen::MatrixXd& X, Target target = Target::latent) const {
    return held_->predict(X, target);
  }
  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const { return held_->mean(X); }
  double operator()(const Eigen::VectorXd& x) const { return mean(x.transpose())[0]; }
  static constexpr bool predicts = true;  ///< for doe::Predictor

  /// Derivatives of the mean at one point x of d entries; empty when the surrogate has none.
  std::optional<Eigen::VectorXd> mean_gradient(const Eigen::VectorXd& x) const {
    return held_->mean_gradient(x);
  }
  /// How many inputs it has; empty when the surrogate does not tell.
  std::optional<Eigen::Index> variables() const { return held_->variables(); }
  /// How its fit ended, and that in words; empty when the surrogate does not tell.
  std::optional<Status> status() const { return held_->status(); }
  std::string message() const { return held_->message(); }

  /// The surrogate as it was, when it is an S, else nullptr.
  template <class S>
  const S* as() const {
    const auto* holder = dynamic_cast<const Holder<S>*>(held_.get());
    return holder ? &holder->surrogate : nullptr;
  }

  friend std::optional<Validation> leave_one_out(const AnySurrogate& any) { return any.held_->closed_form(); }
  /// The surrogate without the noise of its runs where its kind has that, else itself.
  friend AnySurrogate reinterpolated(const AnySurrogate& any) {
    std::shared_ptr<const Held> other = any.held_->interpolating();
    return other ? AnySurrogate(std::move(other)) : any;
  }

 private:
  struct Held {
    virtual ~Held() = default;
    virtual Prediction predict(const Eigen::MatrixXd& X, Target target) const = 0;
    virtual Eigen::VectorXd mean(const Eigen::MatrixXd& X) const = 0;
    virtual std::optional<Eigen::VectorXd> mean_gradient(const Eigen::VectorXd& x) const = 0;
    virtual std::optional<Eigen::Index> variables() const = 0;
    virtual std::optional<Status> status() const = 0;
    virtual std::string message() const = 0;
    virtual std::optional<Validation> closed_form() const = 0;
    virtual std::shared_ptr<const Held> interpolating() const = 0;
  };

  template <class S>
  struct Holder final : Held {
    explicit Holder(S s) : surrogate(std::move(s)) {}
    Prediction predict(const Eigen::MatrixXd& X, Target target) const override {
      return surrogate.predict(X, target);
    }
    Eigen::VectorXd mean(const Eigen::MatrixXd& X) const override { return surrogate.mean(X); }
    std::optional<Eigen::VectorXd> mean_gradient(const Eigen::VectorXd& x) const override {
      if constexpr (SmoothSurrogate<S>)
        return surrogate.mean_gradient(x);
      else
        return std::nullopt;
    }
    std::optional<Eigen::Index> variables() const override {
      if constexpr (requires(const S& s) { s.variables(); })
        return surrogate.variables();
      else
        return std::nullopt;
    }
    std::optional<Status> status() const override {
      if constexpr (requires(const S& s) { s.status(); })
        return surrogate.status();
      else
        return std::nullopt;
    }
    std::string message() const override {
      if constexpr (requires(const S& s) { s.message(); })
        return surrogate.message();
      else
        return {};
    }
    std::optional<Validation> closed_form() const override {
      if constexpr (LeaveOneOutInClosedForm<S>)
        return leave_one_out(surrogate);
      else
        return std::nullopt;
    }
    std::shared_ptr<const Held> interpolating() const override {
      if constexpr (requires(const S& s) { reinterpolated(s); })
        return std::make_shared<Holder<S>>(reinterpolated(surrogate));
      else
        return nullptr;
    }
    S surrogate;
  };

  explicit AnySurrogate(std::shared_ptr<const Held> held) : held_(std::move(held)) {}

  std::shared_ptr<const Held> held_;
};

static_assert(Surrogate<AnySurrogate>);

}  // namespace drawpoint::kriging
