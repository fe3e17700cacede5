// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Strategies with other hauls, from the cycles of the runs that there are (haul_choice.h).
///
/// Mean load and mean time of a cycle are fitted to the training runs as responses are (fits/models.h). Held against
/// each other are the recommended strategy, the one with the highest rate on the front, the one whose cycles load most,
/// the reference and the marks; of those in one place the first.

#include <drawpoint/studies/model/modelled_study.h>

#include <optional>
#include <vector>

namespace drawpoint::studies {

/// work: cycles of runs, the validation runs among them. Requires that study.recommended is known. Nothing where the
/// runs allow no models, the study has no front, or `rate` is no response. Costs two fits.
std::optional<HaulChoice> choice_of_haul(const ModelledStudy& study, const std::string& rate, double haul,
                                         const std::vector<WorkOfRun>& work);

}  // namespace drawpoint::studies
