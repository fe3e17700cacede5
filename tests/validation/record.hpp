// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>

/// One line of the validation suite: what is exact or published, what the engine gave, and how far off it may
/// be.
///
/// record() fails the running test unless |error| ≤ budget, and when the environment variable
/// DRAWPOINT_VALIDATION_TABLE names a folder it also writes the problem's part of docs/reference/validation.md there,
/// with the comparison that is nearest to its budget and the headlines, and its part of
/// docs/validation/comparisons.csv, with all of them (replaced atomically at every call, so that a test that dies
/// leaves whole files). Numbers are printed with the digits that the budget can tell apart, so that the same code gives
/// the same text. A problem is one file, `<name>_validation.cpp`, and one program; not thread-safe.
/// tests/validation/table puts the parts together.
namespace drawpoint::validation {

/// The table's sections, in its order.
enum class Group { mechanism, single_body, impact, assembly, granular };

struct Problem {
  std::string name;  ///< the file's, without _validation.cpp
  Group group;
  std::string title;
  std::string simulated;  ///< one sentence, 40 words at most: what is simulated, with step and settings
};

struct Comparison {
  std::string quantity;
  std::string unit = "1";
  double expected = 0;
  std::string source;  ///< of the expected value: "closed form", a paper
  double measured = 0;
  /// Signed or not; left out: measured − expected.
  double error = std::numeric_limits<double>::quiet_NaN();
  double budget = 0;          ///< largest |error| allowed, in the unit of the error, finite
  std::string budget_reason;  ///< one sentence that stands alone: how the budget follows from the method
  bool headline = false;      ///< stands on the page, near to its budget or not
};

void record(const Problem& problem, Comparison comparison);

}  // namespace drawpoint::validation
