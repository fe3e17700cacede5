// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Scales on which a response may be fitted, for responses with bounds: z = g(y), monotone.
///
///   linear       z = y
///   square_root  z = √(y − a)                      y = a + max(z, 0)²
///   logarithm    z = ln(y − a + c)                 y = a − c + eᶻ
///   logit        z = ln((y − a + c)/(b − y + e))   y = a − c + (b − a + c + e)/(1 + e⁻ᶻ)
/// a and b are the bounds of y, c and e >= 0 offsets that keep runs on them finite; predictions reach beyond
/// a bound by less than its offset. Noise that is the same everywhere on the scale of z grows with y on that
/// of y: with its square root for square_root, with y − a + c for logarithm.
///
/// What a noisy run at z has in the mean, E[g⁻¹(z + ε)] with ε normal, is a sum over nine points
/// (Gauss-Hermite quadrature, exact for polynomials up to degree 17): for logarithm its relative error is
/// below 1e-9 up to a noise deviation of 1, 1e-5 up to 2; for square_root, whose inverse has a kink in its
/// slope at 0, below 1 % of the noise variance.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/training_data.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

enum class Scale { linear, square_root, logarithm, logit };

inline std::string_view to_string(Scale scale) {
  switch (scale) {
    case Scale::linear:
      return "linear";
    case Scale::square_root:
      return "square_root";
    case Scale::logarithm:
      return "logarithm";
    case Scale::logit:
      return "logit";
  }
  return "unknown";
}

/// What a response is known to keep to, unit of y; an infinite bound is none.
struct ResponseRange {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

/// A scale with its constants, unit of y. A value; transform_for makes sound ones.
struct Transform {
  Scale scale = Scale::linear;
  double lower = 0, upper = 0, offset = 0, upper_offset = 0;  ///< a, b, c, e; 0 where the scale has none
};

/// Whether some z stands for y.
inline bool reaches(const Transform& t, double y) {
  const double above = y - t.lower + t.offset;
  switch (t.scale) {
    case Scale::linear:
      return true;
    case Scale::square_root:
      return above >= 0;
    case Scale::logarithm:
      return above > 0;
    case Scale::logit:
      return above > 0 && t.upper - y + t.upper_offset > 0;
  }
  return true;
}

/// g(y) of a y that the scale reaches.
inline double transformed(const Transform& t, double y) {
  const double above = y - t.lower + t.offset;
  switch (t.scale) {
    case Scale::linear:
      return y;
    case Scale::square_root:
      return std::sqrt(std::max(above, 0.0));
    case Scale::logarithm:
      return std::log(above);
    case Scale::logit:
      return std::log(above / (t.upper - y + t.upper_offset));
  }
  return y;
}

/// g⁻¹(z), for any z.
inline double back_transformed(const Transform& t, double z) {
  const double from = t.lower - t.offset;
  switch (t.scale) {
    case Scale::linear:
      return z;
    case Scale::square_root:
      return from + std::max(z, 0.0) * std::max(z, 0.0);
    case Scale::logarithm:
      return from + std::exp(z);
    case Scale::logit:
      return from + (t.upper - t.lower + t.offset + t.upper_offset) / (1 + std::exp(-z));
  }
  return z;
}

/// dg⁻¹/dz.
inline double back_slope(const Transform& t, double z) {
  switch (t.scale) {
    case Scale::linear:
      return 1;
    case Scale::square_root:
      return 2 * std::max(z, 0.0);
    case Scale::logarithm:
      return std::exp(z);
    case Scale::logit: {
      const double half = std::cosh(0.5 * z);
      return 0.25 * (t.upper - t.lower + t.offset + t.upper_offset) / (half * half);
    }
  }
  return 1;
}

/// Variance τ² on the scale of z of noise that has this variance about g⁻¹(z): noise of which y at a
/// deviation above and below is 2√variance apart, (g⁻¹(z + τ) − g⁻¹(z − τ))/2 = √variance. Rises with the
/// variance, is first order, variance/(dg⁻¹/dz)², where that is small, and finite on a bound of a square
/// root. Between the bounds of a logit no noise is wider than they are: it counts as almost that.
inline double noise_on_scale(const Transform& t, double z, double variance) {
  if (t.scale == Scale::linear || !(variance > 0)) return variance;
  const double deviation = std::sqrt(variance);
  double tau = 0;
  if (t.scale == Scale::logarithm) {
    tau = std::asinh(deviation * std::exp(-z));
  } else if (t.scale == Scale::square_root) {
    const double root = std::max(z, 0.0);
    tau = deviation < 2 * root * root ? deviation / (2 * root) : std::sqrt(2 * deviation) - root;
  } else {  // sinh τ/(cosh τ + cosh z) = q, a quadratic in e^τ
    constexpr double most = 1 - 1e-6;
    const double q = std::min(2 * deviation / (t.upper - t.lower + t.offset + t.upper_offset), most);
    const double c = q * std::cosh(z);
    tau = std::log((c + std::sqrt(c * c + (1 - q) * (1 + q))) / (1 - q));
  }
  return tau * tau;
}

namespace detail {

/// Points and weights for the mean over a standard normal variable; both sides alike.
struct NormalQuadrature {
  static constexpr std::array<double, 5> point = {0.0, 1.0232556637891326, 2.07684797867783, 3.20542900285647,
                                                  4.512745863399783};
  static constexpr std::array<double, 5> weight = {0.40634920634920635, 0.24409750289493953,
                                                   0.04991640676521782, 0.0027891413212317692,
                                                   2.2345844007746607e-05};
};

/// E[f(z + ε)], ε normal with mean 0 and this deviation.
template <class F>
double mean_over_noise(const F& f, double z, double deviation) {
  double sum = NormalQuadrature::weight[0] * f(z);
  for (std::size_t k = 1; k < NormalQuadrature::point.size(); ++k) {
    const double step = deviation * NormalQuadrature::point[k];
    sum += NormalQuadrature::weight[k] * (f(z - step) + f(z + step));
  }
  return sum;
}

}  // namespace detail

/// E[g⁻¹(z + ε)], unit of y; noise_variance >= 0 on the scale of z.
inline double mean_response(const Transform& t, double z, double noise_variance) {
  if (t.scale == Scale::linear || !(noise_variance > 0)) return back_transformed(t, z);
  return detail::mean_over_noise([&](double at) { return back_transformed(t, at); }, z,
                                 std::sqrt(noise_variance));
}

/// Its derivative by z.
inline double mean_response_slope(const Transform& t, double z, double noise_variance) {
  if (t.scale == Scale::linear || !(noise_variance > 0)) return back_slope(t, z);
  return detail::mean_over_noise([&](double at) { return back_slope(t, at); }, z, std::sqrt(noise_variance));
}

/// The mean as a sum for those who compute it elsewhere: Σ shareₖ g⁻¹(z + stepₖ); steps and shares, nine
/// each.
inline std::pair<Eigen::VectorXd, Eigen::VectorXd> noise_points(double noise_variance) {
  using Rule = detail::NormalQuadrature;
  constexpr auto half = static_cast<Eigen::Index>(Rule::point.size()) - 1;
  Eigen::VectorXd steps(2 * half + 1), shares(2 * half + 1);
  for (Eigen::Index i = -half; i <= half; ++i) {
    const auto k = static_cast<std::size_t>(std::abs(i));
    steps[half + i] = (i < 0 ? -1.0 : 1.0) * std::sqrt(noise_variance) * Rule::point[k];
    shares[half + i] = Rule::weight[k];
  }
  return {steps, shares};
}

/// The bounds that a scale needs are finite.
inline bool allows(const ResponseRange& range, Scale scale) {
  if (scale == Scale::linear) return true;
  return std::isfinite(range.lower) && (scale != Scale::logit || std::isfinite(range.upper));
}

namespace detail {

/// Half of the least distance above 0, where some distance is 0; else 0.
inline double half_least(const Eigen::VectorXd& distances) {
  double least = std::numeric_limits<double>::infinity();
  bool touches = false;
  for (const double distance : distances) {
    if (distance > 0)
      least = std::min(least, distance);
    else
      touches = true;
  }
  return touches && std::isfinite(least) ? 0.5 * least : 0.0;
}

/// Median deviation of the runs that scatter by more than their distance; 0 without such runs or variances.
inline double scatter_across(const Eigen::VectorXd& distances, const Eigen::VectorXd& variance) {
  std::vector<double> across;
  for (Eigen::Index i = 0; i < variance.size(); ++i) {
    const double deviation = std::sqrt(std::max(variance[i], 0.0));
    if (deviation > distances[i]) across.push_back(deviation);
  }
  if (across.empty()) return 0;
  const auto middle = across.begin() + static_cast<std::ptrdiff_t>(across.size() / 2);
  std::nth_element(across.begin(), middle, across.end());
  return *middle;
}

inline double offset_of(const Eigen::VectorXd& distances, const Eigen::VectorXd& variance) {
  return std::max(half_least(distances), scatter_across(distances, variance));
}

inline void check_range(const Eigen::VectorXd& y, Scale scale, const ResponseRange& range) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("kriging::transform_for: " + what);
  };
  if (!allows(range, scale))
    reject("the scale is " + std::string(to_string(scale)) + " and the range is " + text(range.lower) +
           " to " + text(range.upper) +
           "; square_root and logarithm need a finite lower bound, logit both; give them, or take linear");
  if (!(range.lower < range.upper))
    reject("the range is " + text(range.lower) + " to " + text(range.upper) +
           "; allowed is lower < upper; give the bounds of the response");
  for (Eigen::Index i = 0; i < y.size(); ++i)
    if (!(y[i] >= range.lower && y[i] <= range.upper))
      reject("y[" + std::to_string(i) + "] is " + text(y[i]) + "; allowed is the range, " +
             text(range.lower) + " to " + text(range.upper) + "; widen it or leave the run out");
}

}  // namespace detail

/// The transform of a response whose runs are y, all within the range. Where runs lie on a bound of a
/// logarithm or logit, its offset is half of the least other distance from it; runs that all lie there have
/// none, and leave the scale linear. Where the noise of runs is known (variances, unit of y squared) and some scatter
/// by more than their distance from the bound, the offset is at least the median of their deviations: with less, noise
/// would span decades. Throws std::invalid_argument for a range that lacks what the scale needs, for y outside of it,
/// and for variances that are not one per run.
inline Transform transform_for(Scale scale, const Eigen::VectorXd& y, const ResponseRange& range,
                               const Eigen::VectorXd& noise_variance = {}) {
  if (scale == Scale::linear) return {};
  detail::check_range(y, scale, range);
  if (noise_variance.size() > 0)
    detail::check_run_noise(noise_variance, y.size(), "kriging::transform_for: ");
  Transform t{scale, range.lower, scale == Scale::logit ? range.upper : 0.0};
  if (scale == Scale::square_root) return t;
  t.offset = detail::offset_of(detail::affine(y, 1.0, -range.lower), noise_variance);
  if (scale == Scale::logit)
    t.upper_offset = detail::offset_of(detail::affine(y, -1.0, range.upper), noise_variance);
  const bool all = std::all_of(y.begin(), y.end(), [&](double value) { return reaches(t, value); });
  return all ? t : Transform{};
}

}  // namespace drawpoint::kriging
