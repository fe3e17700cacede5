// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The pile from above at the start of a cycle (the source's figure 7): its columns, the front line, the curve of
/// the volume centres (column_model.hpp), and the place that the bucket attacks.

#include <drawpoint/engine/loading/log/responses.hpp>

#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {

/// A panel of the report (study.hpp), from the log alone. `who` begins the caption: which cycle of which run. Null
/// where the log has no columns.
nlohmann::json plan_view_panel(const engine::loading::LoadingLog& log,
                               const engine::loading::CycleRecord& cycle, const std::string& who);

}  // namespace drawpoint::studies
