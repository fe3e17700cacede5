// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/machine/constrained_response.h>

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

Eigen::MatrixXd driven_speeds(const Eigen::MatrixXd& G, const std::vector<Eigen::Index>& still,
                              const std::vector<Eigen::Index>& driving) {
  const Eigen::Index n = G.cols(), m = G.rows(), n_driving = static_cast<Eigen::Index>(driving.size());
  std::vector<Eigen::Index> prescribed = still;
  prescribed.insert(prescribed.end(), driving.begin(), driving.end());
  Eigen::MatrixXd A(m + static_cast<Eigen::Index>(prescribed.size()), n);
  A.topRows(m) = G;
  for (std::size_t k = 0; k < prescribed.size(); ++k)
    A.row(m + static_cast<Eigen::Index>(k)) = Eigen::RowVectorXd::Unit(n, prescribed[k]);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(A.rows(), n_driving);
  B.bottomRows(n_driving).setIdentity();
  return A.colPivHouseholderQr().solve(B);
}

}  // namespace drawpoint::engine::machine
