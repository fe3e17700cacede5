// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <drawpoint/engine/world/rock.hpp>
#include <string>
#include <vector>

/// From the solution of a step to the motion of the rocks.
namespace drawpoint::engine::detail {

/// Rock present[k] is body k + 1 of the problem.
struct SolvedRocks {
  const std::vector<int>& present;
  const ContactProblem& problem;
  const ThreadPool& pool;
};

/// Throws SolutionBroken when a velocity is not finite or absurdly fast, naming the rock; `when` says of which
/// step. Nothing has moved then.
void check_solution(const SolvedRocks& solved, const std::string& when);
[[noreturn]] void fail_solution(const std::string& when, const std::string& what);

/// Moves the rocks by a step of h [s].
void move_rocks(std::vector<Rock>& rocks, const SolvedRocks& solved, double h);

}  // namespace drawpoint::engine::detail
