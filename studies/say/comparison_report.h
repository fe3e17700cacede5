// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the command compare says, as text for people and as JSON for scripts.

#include <drawpoint/studies/model/comparison/compared_folders.h>

#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {

std::string comparison_text(const ComparedFolders& compared);

/// {"study", "a" and "b": {"folder", "runs", "failed", "headlines", "front": points, "no_front"},
/// "differing": {what: [a, b]}, "paired", "pairs", "points": [a, b], "left_out": [{"a": runs, "b": runs,
/// "failed": "a", "b" or "both"}], "responses": {name: {"a", "b", "difference", "lower", "upper", "larger",
/// "equal"}}, "fronts": {"share": [a, b] or null, "reference": {objective: value}, "best": {objective: [a,
/// b]}} or null}. Without pairs "larger" and "equal" are null.
nlohmann::ordered_json comparison_json(const ComparedFolders& compared);

}  // namespace drawpoint::studies
