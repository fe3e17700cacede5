// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What makes two invocations the same study: its name, its problem, its options, its simulator, its seed
/// and how its points were planned. It is kept in the store, so that runs of two different studies never end
/// up in one table.

#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/studies/options.hpp>

#include <optional>
#include <string>

namespace drawpoint::studies {

struct Identity {
  std::string study;
  doe::Problem problem;
  doe::Seed seed = 1;
  int replicates = 1;          ///< runs per training point
  bool corners = false;        ///< the first 2^d training points are the corners of the box
  OptionValues options = {};   ///< a value of every option of the study
  std::string simulator = {};  ///< Simulator::name
};

/// The first difference in words ('variable "alpha": upper bound 2 there, 3 here'), or "" if there is none.
std::string difference(const doe::Problem& there, const doe::Problem& here);

/// `here` as it was when it had the responses of `there` alone, where it has only gained recorded ones since,
/// at the end, such as standard errors; nothing for any other difference, or none.
std::optional<doe::Problem> before_later_responses(const doe::Problem& there, const doe::Problem& here);

}  // namespace drawpoint::studies
