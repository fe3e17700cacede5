// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What Lindmark (2016) says of the trade-offs, held against the points of each drawn surface that no other
/// dominates (F2, F10, F12, F13) and against those that are low in damage and spill (F11).

#include <drawpoint/studies/loading/loading_surfaces.h>
#include <drawpoint/studies/finding.hpp>

namespace drawpoint::studies {

struct FrontFindings {
  Finding f2, f10, f11, f12, f13;
};

FrontFindings front_findings(const LoadingSurfaces& surfaces);

}  // namespace drawpoint::studies
