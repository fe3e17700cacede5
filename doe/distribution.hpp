// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How inputs that one cannot choose are distributed: a friction, an ore's density, a wear.
///
/// Each by its quantiles Q and its distribution function F, and given that the value lies in the variable's
/// box: u in [0, 1] becomes x = Q(F(lower) + u (F(upper) − F(lower))). So every design in the box, moved by
/// `distributed`, is a design over the distributions, with what it had of evenness and balance; inputs are
/// independent of each other. Those that are not named stay uniform in their box.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/normal_quantile.hpp>
#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/detail/sorted_quantile.hpp>
#include <drawpoint/doe/problem.hpp>

namespace drawpoint::doe {

/// One's own distribution is these two functions too; no single value has a probability of its own. Without
/// `probability` its quantiles must lie inside the box.
struct Distribution {
  std::string name;                                ///< for messages
  std::function<double(double)> quantile;          ///< of p in [0, 1], natural units, not falling
  std::function<double(double)> probability = {};  ///< of a value at most x
};

/// By the name of the variable.
using InputDistributions = std::map<std::string, Distribution>;

namespace detail {

[[noreturn]] inline void reject_distribution(const std::string& what) {
  throw std::invalid_argument("doe::Distribution: " + what);
}

inline void check_positive(const char* name, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    reject_distribution(std::string(name) + " is " + number_text(value) +
                        "; allowed is above 0 and finite; leave the variable out for a uniform one");
}

/// Standard normal, with the ends.
inline double normal_quantile_or_infinity(double p) {
  if (p <= 0.0) return -std::numeric_limits<double>::infinity();
  if (p >= 1.0) return std::numeric_limits<double>::infinity();
  return normal_quantile(p);
}

}  // namespace detail

/// Mean and standard deviation before it is cut to the box.
inline Distribution normal(double mean, double deviation) {
  detail::check_positive("the standard deviation of a normal distribution", deviation);
  if (!std::isfinite(mean))
    detail::reject_distribution("the mean of a normal distribution is " + detail::number_text(mean) +
                                "; allowed is a finite number");
  return {"normal", [=](double p) { return mean + deviation * detail::normal_quantile_or_infinity(p); },
          [=](double x) { return detail::normal_probability((x - mean) / deviation); }};
}

/// The distribution of a value above 0 whose logarithm is normal: half of the values lie below `median`, 68 % within
/// a factor of exp(log_deviation) of it.
inline Distribution lognormal(double median, double log_deviation) {
  detail::check_positive("the median of a lognormal distribution", median);
  detail::check_positive("the deviation of the logarithm", log_deviation);
  return {"lognormal",
          [=](double p) { return median * std::exp(log_deviation * detail::normal_quantile_or_infinity(p)); },
          [=](double x) {
            return x > 0.0 ? detail::normal_probability(std::log(x / median) / log_deviation) : 0.0;
          }};
}

/// Density 0 at the ends, highest at the mode, straight between: what one knows of least, likeliest, most.
inline Distribution triangular(double lower, double mode, double upper) {
  if (!(lower <= mode && mode <= upper && lower < upper) || !std::isfinite(upper - lower))
    detail::reject_distribution("a triangular distribution of lower end " + detail::number_text(lower) +
                                ", mode " + detail::number_text(mode) + " and upper end " +
                                detail::number_text(upper) +
                                "; allowed is lower <= mode <= upper, lower < upper, finite");
  const double width = upper - lower, peak = (mode - lower) / width;
  return {"triangular",
          [=](double p) {
            return p < peak ? lower + width * std::sqrt(p * peak)
                            : upper - width * std::sqrt((1.0 - p) * (1.0 - peak));
          },
          [=](double x) {
            if (x <= lower) return 0.0;
            if (x >= upper) return 1.0;
            const double u = (x - lower) / width;
            return x < mode ? u * u / peak : 1.0 - (1.0 - u) * (1.0 - u) / (1.0 - peak);
          }};
}

/// The distribution of two or more measured values: their quantiles, linear between neighbours. All must lie inside
/// the variable's box.
inline Distribution empirical(std::vector<double> values) {
  if (values.size() < 2)
    detail::reject_distribution("an empirical distribution of " + std::to_string(values.size()) +
                                " values; allowed is 2 or more; take triangular for a guess");
  for (const double value : values)
    if (!std::isfinite(value))
      detail::reject_distribution("an empirical distribution holds " + detail::number_text(value) +
                                  "; allowed are finite numbers; leave it out");
  std::sort(values.begin(), values.end());
  const Eigen::VectorXd sorted =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return {"empirical",
          [sorted](double p) { return detail::sorted_quantile(sorted, std::clamp(p, 0.0, 1.0)); }};
}

namespace detail {

/// u in [0, 1] to the values of a distribution that lie in the box of a variable.
class BoxedDistribution {
 public:
  BoxedDistribution(const Distribution& distribution, const Variable& variable)
      : quantile_(distribution.quantile), variable_(variable) {
    const std::string place = "variable \"" + variable.name + "\": ";
    const std::string box =
        with_unit(variable.lower, variable.unit) + " to " + with_unit(variable.upper, variable.unit);
    if (is_discrete(variable))
      reject_distribution(place + "it is " + std::string(to_string(variable.kind)) +
                          "; a distribution is for a real variable; leave it uniform");
    if (!quantile_)
      reject_distribution(place + "the distribution has no quantile; give Distribution::quantile");
    for (const double p : {0.25, 0.5, 0.75})
      if (!(quantile_(p - 0.25) <= quantile_(p)) || !(quantile_(p) <= quantile_(p + 0.25)))
        reject_distribution(place + "the quantile of the " + distribution.name +
                            " distribution falls beside " + number_text(p) +
                            ", or is not a number; it must not fall from 0 to 1");
    if (distribution.probability) {
      from_ = distribution.probability(variable.lower);
      to_ = distribution.probability(variable.upper);
      // Below this the cut would keep fewer than ten digits.
      if (!(to_ - from_ >= 1e-6))
        reject_distribution(place + "the box " + box + " holds " + number_text(to_ - from_) + " of the " +
                            distribution.name +
                            " distribution; allowed is 1e-6 or more; widen the bounds or correct it");
    } else if (!(quantile_(0.0) >= variable.lower && quantile_(1.0) <= variable.upper)) {
      reject_distribution(place + "the " + distribution.name + " distribution lies from " +
                          with_unit(quantile_(0.0), variable.unit) + " to " +
                          with_unit(quantile_(1.0), variable.unit) + ", outside of the box " + box +
                          "; widen the bounds");
    }
  }

  double operator()(double u) const {
    return std::clamp(quantile_(from_ + u * (to_ - from_)), variable_.lower, variable_.upper);
  }

 private:
  std::function<double(double)> quantile_;
  Variable variable_;
  double from_ = 0.0, to_ = 1.0;
};

/// The places of the names; throws where one is no variable's.
inline std::map<Eigen::Index, BoxedDistribution> boxed(const Problem& problem,
                                                       const InputDistributions& inputs) {
  std::map<Eigen::Index, BoxedDistribution> by_column;
  for (const auto& [name, distribution] : inputs) {
    std::string known;
    for (const Variable& v : problem.variables) known += (known.empty() ? "\"" : ", \"") + v.name + "\"";
    const auto found = std::find_if(problem.variables.begin(), problem.variables.end(),
                                    [&name = name](const Variable& v) { return v.name == name; });
    if (found == problem.variables.end())
      reject_distribution("no variable \"" + name + "\"; the variables are " + known);
    by_column.emplace(found - problem.variables.begin(), BoxedDistribution(distribution, *found));
  }
  return by_column;
}

}  // namespace detail

/// X: n x d inside the box, of any design; the same with every variable that has a distribution moved to it.
/// Throws std::invalid_argument for a distribution of no variable or of one that is not real, a box that
/// holds none of it, and points outside of the box.
inline Eigen::MatrixXd distributed(const Problem& problem, const InputDistributions& inputs,
                                   Eigen::MatrixXd X) {
  detail::check_inside(X, problem, "doe::distributed");
  for (const auto& [column, distribution] : detail::boxed(problem, inputs))
    for (double& x : X.col(column)) x = distribution(detail::to_unit(x, problem.variables[column]));
  return X;
}

}  // namespace drawpoint::doe
