// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/statistics/finding_statistics.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace drawpoint::studies {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::vector<Index> order_of(const VectorXd& x) {
  std::vector<Index> order(static_cast<std::size_t>(x.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) { return x[i] < x[j]; });
  return order;
}

VectorXd ranks_of(const VectorXd& x) {
  const std::vector<Index> order = order_of(x);
  VectorXd ranks(x.size());
  for (std::size_t first = 0, last; first < order.size(); first = last) {
    last = first;
    while (last < order.size() && x[order[last]] == x[order[first]]) ++last;
    for (std::size_t k = first; k < last; ++k) ranks[order[k]] = 0.5 * static_cast<double>(first + last - 1);
  }
  return ranks;
}

double sum_of_squares(const VectorXd& y) { return y.size() == 0 ? 0 : (y.array() - y.mean()).square().sum(); }

Index third_of(double x, double lower, double upper) {
  return static_cast<Index>(std::clamp(std::floor(3 * (x - lower) / (upper - lower)), 0.0, 2.0));
}

std::string grounds_of(const Criterion& c) {
  if (!std::isfinite(c.estimate.value))
    return c.effect + ": " + (c.unknown.empty() ? "too few runs, or nothing to compare with" : c.unknown);
  char text[96];
  std::snprintf(text, sizeof text, ": %.2g ± %.2g, ", c.estimate.value, 2 * c.estimate.error);
  return c.effect + text + to_string(verdict_of(c));
}

}  // namespace

Verdict verdict_of(const Criterion& c) {
  const double value = c.estimate.value, reach = 2 * c.estimate.error;
  if (!std::isfinite(value)) return Verdict::unclear;
  if (value + reach < c.least) return Verdict::not_reproduced;
  return value - reach > 0 ? Verdict::reproduced : Verdict::unclear;
}

Finding decided(const std::string& id, const std::string& claim, const std::vector<Criterion>& criteria) {
  Finding finding{id, claim, Verdict::reproduced, ""};
  for (const Criterion& criterion : criteria) {
    const Verdict verdict = verdict_of(criterion);
    if (verdict == Verdict::not_reproduced) finding.verdict = verdict;
    if (verdict == Verdict::unclear && finding.verdict == Verdict::reproduced) finding.verdict = verdict;
    finding.grounds += (finding.grounds.empty() ? "" : "; ") + grounds_of(criterion);
  }
  return finding;
}

Estimate rank_correlation(const VectorXd& a, const VectorXd& b) {
  if (a.size() < least_group) return {};
  const VectorXd ra = ranks_of(a), rb = ranks_of(b);
  const double scale = std::sqrt(sum_of_squares(ra) * sum_of_squares(rb));
  if (!(scale > 0)) return {};
  const double product = ((ra.array() - ra.mean()) * (rb.array() - rb.mean())).sum();
  return {product / scale, 1 / std::sqrt(static_cast<double>(a.size() - 1))};
}

Estimate difference(const Estimate& a, const Estimate& b) {
  return {a.value - b.value, std::hypot(a.error, b.error)};
}

Estimate estimate_of(std::vector<double> draws) {
  const std::size_t all = draws.size();
  draws.erase(std::remove_if(draws.begin(), draws.end(), [](double x) { return !std::isfinite(x); }),
              draws.end());
  if (draws.size() * 20 <= all * 19) return {};
  std::sort(draws.begin(), draws.end());
  const auto quantile = [&](double p) {
    return draws[static_cast<std::size_t>(p * static_cast<double>(draws.size() - 1) + 0.5)];
  };
  const double median = quantile(0.5);
  return {median, 0.5 * std::max(median - quantile(0.023), quantile(0.977) - median)};
}

double deviation_of(const VectorXd& y) {
  return y.size() == 0 ? 0 : std::sqrt(sum_of_squares(y) / static_cast<double>(y.size()));
}

Eigen::Vector3d means_of_thirds(const VectorXd& x, const VectorXd& y, double lower, double upper) {
  Eigen::Vector3d sums = Eigen::Vector3d::Zero(), counts = sums;
  for (Index i = 0; i < x.size(); ++i) {
    const Index third = third_of(x[i], lower, upper);
    sums[third] += y[i];
    counts[third] += 1;
  }
  return sums.cwiseQuotient(counts);
}

double explained_share(const VectorXd& x, const VectorXd& y, double lower, double upper) {
  const Eigen::Vector3d means = means_of_thirds(x, y, lower, upper);
  VectorXd by_third(y.size());
  for (Index i = 0; i < y.size(); ++i) by_third[i] = means[third_of(x[i], lower, upper)];
  return sum_of_squares(by_third) / sum_of_squares(y);
}

// Pool adjacent violators.
double rising_residual(const VectorXd& x, const VectorXd& y) {
  struct Block {
    double sum, count;
    double mean() const { return sum / count; }
  };
  std::vector<Block> blocks;
  for (const Index i : order_of(x)) {
    blocks.push_back({y[i], 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() >= blocks.back().mean()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().sum += last.sum;
      blocks.back().count += last.count;
    }
  }
  double fitted = 0;
  for (const Block& block : blocks) fitted += block.count * std::pow(block.mean() - y.mean(), 2);
  const double all = sum_of_squares(y);
  return all > 0 ? std::max(1 - fitted / all, 0.0) : 0;
}

double distance_from_uniform(const VectorXd& x, double lower, double upper) {
  const std::vector<Index> order = order_of(x);
  const double n = static_cast<double>(x.size());
  double distance = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double u = (x[order[k]] - lower) / (upper - lower);
    distance = std::max({distance, static_cast<double>(k + 1) / n - u, u - static_cast<double>(k) / n});
  }
  return distance * std::sqrt(n);
}

}  // namespace drawpoint::studies
