// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the commands fit and validate say of a study's models, as text for people and as JSON for scripts.

#include <drawpoint/studies/model/fits/failures.h>
#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/tables.h>

#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {

/// Per response that is no standard error of another: how it is fitted and how the fit ended, the rates and
/// the noise on its scale, and how runs are predicted without themselves.
std::string fit_text(const Models& fitted, const doe::Problem& problem);
nlohmann::ordered_json fit_json(const Models& fitted, const doe::Problem& problem);

/// Where runs fail: their number, whether the place tells, and over which distances (shares of the ranges) a
/// run tells of its surroundings. Empty, null, while none has failed.
std::string success_text(const Failures& failures, const doe::Problem& problem);
nlohmann::ordered_json success_json(const Failures& failures, const doe::Problem& problem);

/// Per response that is no standard error of another: the errors on the validation runs, then each of these
/// beside its 95 % interval.
std::string validation_text(const Models& fitted, const Tables& tables);
nlohmann::ordered_json validation_json(const Models& fitted, const Tables& tables);

}  // namespace drawpoint::studies
