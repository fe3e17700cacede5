// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// expect: use of deleted function
#include <drawpoint/doe/evaluations.hpp>

Eigen::VectorXd first(const drawpoint::doe::Evaluations& runs) { return runs.y(0); }
