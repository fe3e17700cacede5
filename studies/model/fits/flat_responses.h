// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Responses whose models are flat within their own error (kriging/signal.hpp): as objectives they are left
/// out of the search for trade-offs, and nothing is said of their influences and optima.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/signal.hpp>
#include <drawpoint/kriging/transformed_model.hpp>

#include <string>
#include <utility>
#include <vector>

namespace drawpoint::studies {

struct FlatResponse {
  std::size_t response = 0;             ///< place in Problem::responses
  doe::Goal asked = doe::Goal::record;  ///< the goal that the study has for it
  kriging::Signal signal = {};
};

/// The responses whose models (one each, in order) are flat; responses that are standard errors are left out.
std::vector<FlatResponse> flat_responses(const std::vector<kriging::TransformedModel>& models,
                                         const doe::Problem& problem);

bool is_flat(const std::vector<FlatResponse>& flat, std::size_t response);

/// The problem that is searched: objectives that are flat are recorded only.
doe::Problem without_flat(doe::Problem problem, const std::vector<FlatResponse>& flat);

/// That problem with the goals of the study again.
doe::Problem as_asked(doe::Problem problem, const std::vector<FlatResponse>& flat);

/// "its model does not differ between strategies by clearly more than its own error (it varies by 0.0001, its
/// error is 0.002); it is left out of the trade-off; ...", without the name, which text and page set as they do.
std::string flat_text(const FlatResponse& flat, const doe::Problem& problem);

/// Name of the response and flat_text(), of each.
std::vector<std::pair<std::string, std::string>> texts_of(const std::vector<FlatResponse>& flat,
                                                          const doe::Problem& problem);

/// "rock spill, joint damage": of those that the study minimizes or maximizes; empty where none is flat.
std::string flat_objectives(const std::vector<FlatResponse>& flat, const doe::Problem& problem);

}  // namespace drawpoint::studies
