// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the command front says of a predicted front, as text for people and as JSON for scripts.

#include <drawpoint/studies/say/page/report.h>

#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {

/// The points that a decision rests on (decision_points.h), `most` at most and one per place, or every point:
/// variables, objectives and limits with the 95 % interval of one run, what each point is, and what its
/// simulation gave; then how far to trust them. A mark of a point that is not shown, because one in its place
/// is, goes to that one.
std::string front_points_text(const ReportInput& input, int most, bool every_point);

/// Every point: {"points": [{"point", "x": {}, "predicted": {response: {"mean", "lower", "upper"}},
/// "non_dominated": probability or null, "success", "best": [objectives], "balanced", "knee", "chosen":
/// whether the text shows it, "simulated": [runs]}], "flat" and "confirmed": as in the summary, "cautions": []}.
nlohmann::ordered_json front_points_json(const ReportInput& input, int most);

}  // namespace drawpoint::studies
