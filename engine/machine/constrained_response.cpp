// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/machine/constrained_response.hpp>

namespace drawpoint::engine::machine {
namespace {

Eigen::MatrixXd null_space(const Eigen::MatrixXd& G, Eigen::Index n) {
  if (G.rows() == 0) return Eigen::MatrixXd::Identity(n, n);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(G.transpose());
  Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(n, n);
  return Q.rightCols(n - qr.rank());
}

}  // namespace

Eigen::MatrixXd constrained_response(const Eigen::MatrixXd& M, const Eigen::MatrixXd& G) {
  const Eigen::MatrixXd Z = null_space(G, M.rows());
  const Eigen::LLT<Eigen::MatrixXd> llt(Z.transpose() * M * Z);
  return llt.matrixU().solve<Eigen::OnTheRight>(Z);
}

}  // namespace drawpoint::engine::machine
