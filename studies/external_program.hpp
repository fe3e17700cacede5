// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A program in any language as the black box of a study.
///
/// Each run starts `command` with two more words, the names of two files. The first holds the request:
///
///     {"x": {"speed": 2.5, "bolts": 3, "rock": "ore"}, "seed": 18364758544493064720,
///      "log": "/...", "shared": "/...", "options": {}}
///
/// a number per real or integer variable, the name of the level per categorical one; `seed` has 64 bits;
/// `log` is the whole name of a file that the program may write, `shared` that of the study's folder for all
/// runs, empty if it has none. Before it ends with exit code 0 the program writes the second, one of
///
///     {"values": {"reach": 31.7, "wear": 0.2}}      a finite number per response; others are left alone
///     {"failure": "the chute is blocked"}           a failed run with this reason
///
/// What it prints goes to the run's file in logs/. Equal x and seed must give equal values. Anything else,
/// such as another exit code, a signal or no such reply, is a crash: the program is started again with the
/// same request until `attempts` are spent, then the run has failed with the reason of the last one. Ctrl-C
/// gives the program SIGTERM and a second to end, a time limit SIGKILL; with these and with the death of the
/// study all that it started in its process group ends too.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/studies/study.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

struct ExternalProgram {
  std::vector<std::string> command = {};  ///< the program, by path or as in the PATH, and its first words
  double time_limit = 0.0;                ///< [s] of one attempt; 0: none but that of the run
  int attempts = 1;                       ///< 1 or more
};

/// A black box whose responses are those of the problem. Throws std::invalid_argument for no command, a time
/// limit below 0 and fewer than 1 attempt.
StudyFunction external_program(const doe::Problem& problem, const ExternalProgram& program);

}  // namespace drawpoint::studies
