// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/constants.hpp>

/// Momentum of the iterations, a rule that both methods share.
///
/// Gauss-Seidel moves load through a chain of rocks by one rock per iteration, and n rocks take some n² of them. With
/// momentum (Y. Nesterov, 1983) some n are enough: an iteration starts from λ + β (λ − λ'), λ' what it was at the
/// last time that this was done, and from the velocities that go with it; these are linear in λ, so they take the same
/// step. Every second iteration has it: the one between takes back what single contacts have too much of, where
/// momentum in each of them lets contacts that slide swing for ever. All iterations visit the pairs in one direction.
/// Alternating directions look natural, but the second visit of a chain's end finds nothing to do: they need nearly
/// twice the iterations, and momentum on top of them diverges. Figures: docs/measurements/contact-solving.md.
namespace drawpoint::engine::detail {

/// Whether the iteration, counted from 0 in its substep, stores what it starts from: the first, and those with
/// momentum.
inline bool remembers(int iteration) {
  return iteration == 0 || (iteration % 2 == 1 && iteration < constants::momentum_iterations);
}

/// β of an iteration that remembers; 0 in the first, which has nothing to go on from.
inline double momentum_of(int iteration) { return iteration == 0 ? 0 : constants::momentum; }

}  // namespace drawpoint::engine::detail
