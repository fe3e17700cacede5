// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/thinning.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

namespace drawpoint::studies {
namespace {

using Rows = std::vector<doe::Evaluation>;

void keep_extremes(const Rows& rows, std::size_t responses, std::vector<bool>& keep) {
  for (std::size_t j = 0; j < responses; ++j) {
    std::size_t least = rows.size(), most = rows.size();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].outcome.failed()) continue;
      const auto value = [&](std::size_t row) {
        return rows[row].outcome.values()[static_cast<Eigen::Index>(j)];
      };
      if (least == rows.size() || value(i) < value(least)) least = i;
      if (most == rows.size() || value(i) > value(most)) most = i;
    }
    if (least < rows.size()) keep[least] = keep[most] = true;
  }
}

/// So many of those that are not kept yet, evenly.
void keep_evenly(std::size_t count, std::vector<bool>& keep) {
  const auto open = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), false));
  std::size_t seen = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i]) continue;
    keep[i] = (seen + 1) * count / open > seen * count / open;
    ++seen;
  }
}

}  // namespace

void thin(doe::Evaluations& table, const std::vector<Run>& runs) {
  Rows& rows = table.rows;
  if (rows.size() <= most_runs_of_models) return;
  std::set<std::int64_t> own;
  for (const Run& run : runs)
    if (run.kind != Kind::imported) own.insert(run.id);
  const auto is_own = [&](const doe::Evaluation& row) { return own.contains(row.run); };
  std::vector<bool> keep(rows.size(), false);
  if (std::count_if(rows.begin(), rows.end(), is_own) <= static_cast<std::ptrdiff_t>(runs_of_thinned / 2))
    std::transform(rows.begin(), rows.end(), keep.begin(), is_own);
  keep_extremes(rows, table.problem.responses.size(), keep);
  const auto kept = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), true));
  keep_evenly(runs_of_thinned > kept ? runs_of_thinned - kept : 0, keep);
  Rows fewer;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (keep[i]) fewer.push_back(std::move(rows[i]));
  rows = std::move(fewer);
}

std::string thinned_text(std::size_t of, std::size_t kept, const std::string& what) {
  if (of == kept) return "";
  return "Of " + std::to_string(of) + " " + what + " runs " + std::to_string(kept) +
         " are used for models and figures, evenly chosen, with the extremes: a model takes no more. The "
         "command "
         "export has all.";
}

}  // namespace drawpoint::studies
