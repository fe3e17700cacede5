// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/strategy/families.hpp>

namespace drawpoint::engine::loading {

OperatorMoves moves_of(Family family, int rounds, double crowd) {
  OperatorMoves moves = skilled_operator();  // lift, curl, dump, curl
  moves.rounds = rounds;
  moves.crowd = crowd;
  check(moves);
  if (family == Family::steps) moves.round.resize(2);
  if (family == Family::slice || family == Family::drive_and_curl) moves.round.clear(), moves.rounds = 1;
  return moves;
}

Strategy strategy_of(Family family, Strategy strategy) {
  if (family == Family::drive_and_curl) strategy.beta = strategy.kappa = 0;
  return strategy;
}

}  // namespace drawpoint::engine::loading
