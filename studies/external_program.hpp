// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A program in any language as the black box of a study.
///
/// Each run starts `command` with two more words, the names of two files. The first holds the request, which is
/// on standard input, too:
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
/// With `streams` there are no more words, and the last line of standard output is the reply. What it prints
/// goes to the run's file in logs/. Equal x and seed must give equal values. Anything else, such as another
/// exit code, a signal or no such reply, is a crash: the program is started again with the same request until
/// `attempts` are spent, then the run has failed with the reason of the last one. A reply is a regular file of
/// 16 MiB at most, without a key that stands twice. A program that the system cannot start stops the study.
/// Ctrl-C gives the program SIGTERM and a second to end, a time limit SIGKILL; with these and with the death of
/// the study all that it started in its process group ends too.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/studies/study.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// Begins the part of a Simulator::name that is of files which nobody named, but which lie beside the program: a
/// folder whose runs were stored without such a part goes on with it.
inline constexpr const char* files_beside_it = "; beside it ";

struct ExternalProgram {
  std::vector<std::string> command = {};  ///< the program, by path or as in the PATH, and its first words
  double time_limit = 0.0;                ///< [s] of one attempt; 0: none but that of the run
  int attempts = 1;                       ///< 1 or more
  bool streams = false;                   ///< request and reply by standard input and output alone
};

/// A black box whose responses are those of the problem; a crash and a program that cannot be started are
/// exceptions of it, derived from std::runtime_error. Throws std::invalid_argument for no command, a time
/// limit below 0 and fewer than 1 attempt.
StudyFunction external_program(const doe::Problem& problem, const ExternalProgram& program);

}  // namespace drawpoint::studies
