// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/machine/loop_projection.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace drawpoint::engine::machine {
namespace {

constexpr int most_steps = 40;
// Singular values of the loops below this share of the largest count as none: Newton would divide by them.
constexpr double least_share = 1e-7;
// [rad or m] A joint is moved by no more: beyond, the loops may close another way round.
constexpr double farthest = 0.5;

// The columns of P, and rows and columns of M, of the joints that may move.
std::vector<Eigen::Index> free_speeds(int count, const std::vector<int>& held) {
  std::vector<Eigen::Index> speeds;
  for (int k = 0; k < count; ++k)
    if (std::find(held.begin(), held.end(), k) == held.end()) speeds.push_back(k);
  return speeds;
}

// With M = L Lᵀ and y = Lᵀ δu the least |y| is by the pseudo-inverse of P L⁻ᵀ.
Eigen::VectorXd least_move(const Eigen::MatrixXd& M, const Eigen::MatrixXd& P,
                           const Eigen::VectorXd& errors) {
  const Eigen::LLT<Eigen::MatrixXd> llt(M);
  const Eigen::MatrixXd A = llt.matrixU().solve<Eigen::OnTheRight>(P);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(least_share);
  decomposition.compute(A);
  return llt.matrixU().solve(decomposition.solve(-errors));
}

// Whether Newton is done. Beside the aim: when a step has gained less than half and what is left is allowed.
bool close_enough(double error, double before, const LoopTolerance& tolerance) {
  return error <= tolerance.aim || (error <= tolerance.allowed && error > 0.5 * before);
}

[[noreturn]] void give_up(double error, const LoopTolerance& tolerance) {
  std::ostringstream text;
  text << "an error of " << error << " m is left, allowed: " << tolerance.allowed << " m";
  throw std::runtime_error(text.str());
}

}  // namespace

void project_on_loops(const SimTK::MultibodySystem& system, const SimTK::SimbodyMatterSubsystem& matter,
                      const std::vector<int>& held, const LoopTolerance& tolerance, SimTK::State& state) {
  const std::vector<Eigen::Index> moving = free_speeds(state.getNU(), held);
  double before = std::numeric_limits<double>::infinity();
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(state.getNU());
  system.realize(state, SimTK::Stage::Time);  // which normalizeQuaternions() needs
  for (int step = 0;; ++step) {
    matter.normalizeQuaternions(state);
    system.realize(state, SimTK::Stage::Position);
    const SimTK::Vector& listed = state.getQErr();  // those of quaternions come behind
    if (listed.size() == matter.getNumQuaternionsInUse(state)) return;
    const Eigen::VectorXd errors = view(listed).head(listed.size() - matter.getNumQuaternionsInUse(state));
    const double error = errors.lpNorm<Eigen::Infinity>();
    if (close_enough(error, before, tolerance)) return;
    if (step == most_steps || !std::isfinite(error)) give_up(error, tolerance);
    before = error;
    SimTK::Matrix P, M;
    matter.calcP(state, P);
    matter.calcM(state, M);
    Eigen::VectorXd move = Eigen::VectorXd::Zero(state.getNU());
    move(moving) = least_move(to_eigen(M)(moving, moving), to_eigen(P)(Eigen::all, moving), errors);
    moved += move;
    if (!(moved.lpNorm<Eigen::Infinity>() <= farthest)) give_up(error, tolerance);
    SimTK::Vector change;
    matter.multiplyByN(state, false, to_simbody(move), change);
    state.updQ() += change;
  }
}

}  // namespace drawpoint::engine::machine
