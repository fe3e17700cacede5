// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// expect: drawpoint: kriging::fit takes the inputs first
#include <drawpoint/kriging/fit.hpp>

void swapped(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) { drawpoint::kriging::fit(y, X); }
