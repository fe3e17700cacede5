// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/finding_statistics.h>

#include <algorithm>
#include <array>
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

/// y of the runs in each third.
std::array<VectorXd, 3> thirds_of(const VectorXd& x, const VectorXd& y, double lower, double upper) {
  std::array<std::vector<double>, 3> parts;
  for (Index i = 0; i < x.size(); ++i)
    parts[static_cast<std::size_t>(std::clamp(std::floor(3 * (x[i] - lower) / (upper - lower)), 0.0, 2.0))]
        .push_back(y[i]);
  std::array<VectorXd, 3> thirds;
  for (std::size_t k = 0; k < 3; ++k)
    thirds[k] = Eigen::Map<const VectorXd>(parts[k].data(), static_cast<Index>(parts[k].size()));
  return thirds;
}

double within(const std::array<VectorXd, 3>& thirds) {
  double sum = 0;
  for (const VectorXd& third : thirds) sum += sum_of_squares(third);
  return sum;
}

bool large_enough(const std::array<VectorXd, 3>& thirds) {
  return std::all_of(thirds.begin(), thirds.end(), [](const VectorXd& t) { return t.size() >= least_group; });
}

std::string grounds_of(const Criterion& c) {
  if (!std::isfinite(c.estimate.value)) return c.effect + ": too few runs, or nothing to compare with";
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

Estimate mean_difference(const VectorXd& a, const VectorXd& b) {
  if (std::min(a.size(), b.size()) < least_group) return {};
  const double na = static_cast<double>(a.size()), nb = static_cast<double>(b.size());
  const double va = sum_of_squares(a) / (na - 1), vb = sum_of_squares(b) / (nb - 1);
  const double s = std::sqrt((sum_of_squares(a) + sum_of_squares(b)) / (na + nb - 2));
  if (!(s > 0)) return {};
  return {(a.mean() - b.mean()) / s, std::sqrt(va / na + vb / nb) / s};
}

Estimate share(int k, int n) {
  const double p = (k + 2.0) / (n + 4.0);
  return {p, std::sqrt(p * (1 - p) / (n + 4.0))};
}

Estimate share_difference(int k, int m, int l, int n) {
  if (std::min(m, n) < least_group) return {};
  const double p = share(k + l, m + n).value;
  return {static_cast<double>(k) / m - static_cast<double>(l) / n,
          std::sqrt(p * (1 - p) * (1.0 / m + 1.0 / n))};
}

Estimate explained_share(const VectorXd& x, const VectorXd& y, double lower, double upper) {
  const auto thirds = thirds_of(x, y, lower, upper);
  const double all = sum_of_squares(y), n = static_cast<double>(y.size());
  if (!large_enough(thirds) || !(all > 0)) return {};
  const double chance = 2 / (n - 1), eta = std::max(1 - within(thirds) / all - chance, 0.0);
  return {eta, std::hypot(2 * std::sqrt(eta / n) * (1 - eta), chance)};
}

Estimate profile_range(const VectorXd& x, const VectorXd& y, double lower, double upper) {
  const auto thirds = thirds_of(x, y, lower, upper);
  const double n = static_cast<double>(y.size());
  if (!large_enough(thirds)) return {};
  const double s = std::sqrt(within(thirds) / (n - 3));
  if (!(s > 0)) return {};
  const auto [least, most] = std::minmax({thirds[0].mean(), thirds[1].mean(), thirds[2].mean()});
  const double range = (most - least) / s;
  return {std::sqrt(std::max(range * range - 3.65 * 3 / n, 0.0)), std::sqrt(6 / n)};
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
