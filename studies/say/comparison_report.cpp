// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/studies/say/comparison_report.h>
#include <drawpoint/studies/say/number_or_null.h>
#include <drawpoint/studies/say/text_table.h>

#include <algorithm>
#include <vector>

namespace drawpoint::studies {
namespace {

using Lines = std::vector<std::vector<std::string>>;

std::string side_text(const char* name, const ComparedSide& side) {
  std::string text = std::string(name) + ": " + side.folder + ", " +
                     detail::counted(static_cast<std::size_t>(side.ended), "run") + " ended, " +
                     std::to_string(side.failed) + " failed\n";
  for (const std::string& warning : side.warnings) text += "   " + warning + "\n";
  return text;
}

std::string choices_text(const std::vector<OtherChoice>& choices) {
  if (choices.empty()) return "Options, simulator, seed and replicates are the same.\n";
  std::string text;
  for (const auto& [what, a, b] : choices)
    text += (text.empty() ? "They differ in: " : ", ") + what + " (A " + a + ", B " + b + ")";
  return text + "\n";
}

std::string headline_value(const ComparedSide& side, const Headline& wanted) {
  for (const Headline& headline : side.headlines)
    if (headline.name == wanted.name) return detail::number(headline.value);
  return "n/a";
}

std::string headlines_text(const ComparedFolders& compared) {
  const bool of_a = !compared.a.headlines.empty();
  const auto& named = of_a ? compared.a.headlines : compared.b.headlines;
  if (named.empty()) return "";
  Lines table = {{"headline", "A", "B"}};
  for (const Headline& h : named)
    table.push_back(
        {detail::labelled(h.name, h.unit), headline_value(compared.a, h), headline_value(compared.b, h)});
  return "\n" + text_table(table);
}

/// How B compares with A: better or worse, higher or lower, where the interval of the difference leaves 0 out.
std::string verdict_text(const Comparison& runs, std::size_t j, const doe::Response& response) {
  const auto& [mean, larger, equal] = runs.responses[j];
  if (runs.paired && equal == runs.pairs) return "equal";
  if (!mean.has_interval()) return runs.paired ? "the same in every pair" : "no scatter to judge by";
  if (!mean.is_told_apart()) return "not told apart";
  const bool higher = mean.value() > 0;
  if (!doe::is_objective(response.goal)) return higher ? "B higher" : "B lower";
  return (response.goal == doe::Goal::maximize) == higher ? "B better" : "B worse";
}

std::string interval_text(const MeanDifference& mean) {
  if (!mean.has_interval()) return " (no interval)";
  return " (" + detail::number(mean.lower) + " to " + detail::number(mean.upper) + ")";
}

std::string responses_text(const ComparedFolders& compared) {
  Lines table = {{"response", "mean A", "mean B", "B - A (95 % interval)"}};
  if (compared.runs.paired) table.front().push_back("B larger");
  table.front().push_back("on average");
  for (std::size_t j = 0; j < compared.runs.responses.size(); ++j) {
    const auto& [mean, larger, equal] = compared.runs.responses[j];
    const doe::Response& response = compared.problem.responses[j];
    table.push_back({detail::labelled(response.name, response.unit), detail::number(mean.a),
                     detail::number(mean.b), detail::number(mean.value()) + interval_text(mean)});
    if (compared.runs.paired)
      table.back().push_back(detail::percent(static_cast<double>(larger) / compared.runs.pairs) +
                             (equal > 0 ? " (" + std::to_string(equal) + " equal)" : std::string()));
    table.back().push_back(verdict_text(compared.runs, j, response));
  }
  return "\n" + text_table(table);
}

std::string runs_named(const std::vector<std::int64_t>& runs) {
  std::string text;
  for (const std::int64_t run : runs) {
    if (!text.empty()) text += '+';
    text += std::to_string(run);
  }
  return text;
}

/// Run numbers of both sides, per side that has no value.
std::string left_out_text(const std::vector<PointLeftOut>& left_out) {
  std::string of_a, of_b, of_both;
  for (const PointLeftOut& point : left_out) {
    std::string& list = point.failed_a && point.failed_b ? of_both : point.failed_a ? of_a : of_b;
    list += (list.empty() ? "" : ", ") + runs_named(point.runs_a) + "/" + runs_named(point.runs_b);
  }
  if (left_out.empty()) return "";
  std::string text = "Left out of the means, runs A/B at the same point: ";
  if (!of_a.empty()) text += "failed in A alone: " + of_a + "; ";
  if (!of_b.empty()) text += "failed in B alone: " + of_b + "; ";
  if (!of_both.empty()) text += "failed in both: " + of_both + "; ";
  return text.substr(0, text.size() - 2) + "\n";
}

std::string pairs_text(const Comparison& runs) {
  std::string text = "\n" + detail::counted(static_cast<std::size_t>(runs.pairs), "pair") +
                     " of runs at equal points, of the " + std::to_string(runs.points_a) +
                     " points of A and the " + std::to_string(runs.points_b) + " of B with a value.\n";
  if (2 * runs.pairs < std::min(runs.points_a, runs.points_b))
    text += "Most points have no pair; studies with the same --seed and --runs have the same points.\n";
  if (runs.with_other_seeds > 0)
    text += "At " + std::to_string(runs.with_other_seeds) +
            " of them not all seeds are the same, so that noise does not cancel fully.\n";
  return text;
}

std::string without_pairs_text(const Comparison& runs) {
  std::string text =
      "\nToo few pairs of runs at equal points: " + std::to_string(runs.pairs) + ", and 2 are needed; ";
  text += runs.left_out.empty() ? "studies with the same --seed and --runs have the same points.\n"
                                : "at the others a side failed.\n";
  if (runs.responses.empty())
    return text + "Too few other points to compare means: A has " + std::to_string(runs.points_a) + ", B " +
           std::to_string(runs.points_b) + ", and 2 are needed.\n";
  return text + "Compared instead: means over the " + std::to_string(runs.points_a) +
         " points of A and the " + std::to_string(runs.points_b) +
         " of B, training and validation.\nThe designs differ, so a difference mixes design and choice.\n";
}

std::string compared_runs_text(const ComparedFolders& compared) {
  const Comparison& runs = compared.runs;
  std::string text = runs.paired ? pairs_text(runs) : without_pairs_text(runs);
  text += left_out_text(runs.left_out);
  if (runs.responses.empty()) return text;
  text += responses_text(compared);
  return text + "Intervals are of the mean over these points, by Student's t" +
         (runs.paired ? " on the differences" : " (Welch)") +
         ".\nAt a single point, or on the front, the difference may be another.\n";
}

std::string no_front_text(const char* name, const ComparedSide& side) {
  if (side.no_front.empty()) return "";
  return std::string("\nNo predicted front of ") + name + ": " + side.no_front + "\n";
}

std::string shares_text(const FrontComparison& fronts) {
  std::string text;
  if (fronts.share_a)
    text = "Share that each dominates of the box around both (hypervolume): A " +
           detail::number(*fronts.share_a) + ", B " + detail::number(*fronts.share_b) + ".\n";
  return text + "Predicted by models, without an interval; confirm both before relying on it.\n";
}

/// The objectives that were left out of a front, and why.
std::string left_out_text(const char* name, const ComparedFolders& compared, const ComparedSide& side) {
  std::string text;
  for (const FlatResponse& flat : side.flat)
    if (doe::is_objective(flat.asked))
      text += std::string("\nNot in the front of ") + name + ": " +
              compared.problem.responses[flat.response].name + ": " + flat_text(flat, compared.problem) +
              ".\n";
  return text;
}

std::string fronts_text(const ComparedFolders& compared) {
  const std::string left_out =
      left_out_text("A", compared, compared.a) + left_out_text("B", compared, compared.b);
  if (!compared.fronts) return no_front_text("A", compared.a) + no_front_text("B", compared.b) + left_out;
  const auto objectives = detail::objectives(compared.common);
  Lines table = {{"best on the predicted front", "A", "B"}};
  for (std::size_t k = 0; k < objectives.size(); ++k) {
    const doe::Response& response = compared.problem.responses[objectives[k]];
    const auto column = static_cast<Eigen::Index>(k);
    table.push_back({detail::labelled(response.name, response.unit),
                     detail::number(compared.fronts->best_a[column]),
                     detail::number(compared.fronts->best_b[column])});
  }
  return "\n" + text_table(table) + shares_text(*compared.fronts) + left_out;
}

using ComparisonJson = nlohmann::ordered_json;

ComparisonJson side_json(const ComparedSide& side) {
  ComparisonJson headlines = ComparisonJson::object();
  for (const Headline& h : side.headlines) headlines[h.name] = number_or_null(h.value);
  return {{"folder", side.folder},
          {"runs", side.ended},
          {"failed", side.failed},
          {"headlines", std::move(headlines)},
          {"front", side.front ? side.front->X.rows() : 0},
          {"no_front", side.no_front}};
}

ComparisonJson left_out_json(const std::vector<PointLeftOut>& left_out) {
  ComparisonJson all = ComparisonJson::array();
  for (const PointLeftOut& point : left_out)
    all.push_back({{"a", point.runs_a},
                   {"b", point.runs_b},
                   {"failed", point.failed_a && point.failed_b ? "both"
                              : point.failed_a                 ? "a"
                                                               : "b"}});
  return all;
}

ComparisonJson responses_json(const ComparedFolders& compared) {
  ComparisonJson all = ComparisonJson::object();
  const Comparison& runs = compared.runs;
  for (std::size_t j = 0; j < runs.responses.size(); ++j) {
    const auto& [mean, larger, equal] = runs.responses[j];
    all[compared.problem.responses[j].name] = {
        {"a", mean.a},
        {"b", mean.b},
        {"difference", mean.value()},
        {"lower", number_or_null(mean.lower)},
        {"upper", number_or_null(mean.upper)},
        {"larger", runs.paired ? ComparisonJson(larger) : ComparisonJson()},
        {"equal", runs.paired ? ComparisonJson(equal) : ComparisonJson()}};
  }
  return all;
}

ComparisonJson fronts_json(const ComparedFolders& compared) {
  if (!compared.fronts) return {};
  const FrontComparison& fronts = *compared.fronts;
  ComparisonJson reference = ComparisonJson::object(), best = ComparisonJson::object();
  const auto objectives = detail::objectives(compared.common);
  for (std::size_t k = 0; k < objectives.size(); ++k) {
    const std::string& name = compared.problem.responses[objectives[k]].name;
    const auto column = static_cast<Eigen::Index>(k);
    best[name] = {fronts.best_a[column], fronts.best_b[column]};
    if (fronts.share_a) reference[name] = fronts.reference[column];
  }
  ComparisonJson share;
  if (fronts.share_a) share = {*fronts.share_a, *fronts.share_b};
  return {{"share", std::move(share)}, {"reference", std::move(reference)}, {"best", std::move(best)}};
}

}  // namespace

std::string comparison_text(const ComparedFolders& compared) {
  return compared.study + ": what B changes against A\n" + side_text("A", compared.a) +
         side_text("B", compared.b) + choices_text(compared.choices) + headlines_text(compared) +
         compared_runs_text(compared) + fronts_text(compared);
}

ComparisonJson comparison_json(const ComparedFolders& compared) {
  ComparisonJson differing = ComparisonJson::object();
  for (const auto& [what, a, b] : compared.choices) differing[what] = {a, b};
  return {{"study", compared.study},
          {"a", side_json(compared.a)},
          {"b", side_json(compared.b)},
          {"differing", std::move(differing)},
          {"paired", compared.runs.paired},
          {"pairs", compared.runs.pairs},
          {"points", {compared.runs.points_a, compared.runs.points_b}},
          {"left_out", left_out_json(compared.runs.left_out)},
          {"responses", responses_json(compared)},
          {"fronts", fronts_json(compared)}};
}

}  // namespace drawpoint::studies
