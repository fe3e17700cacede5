// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the criteria of criteria.h do with the models of the runs so far.
///
/// Each score is multiplied by the probability that a run succeeds. Of one objective, joint_improvement,
/// knowledge_gradient and predicted score on the scale of its model (kriging/transform.hpp).

#include <drawpoint/studies/model/fits/failures.h>
#include <drawpoint/studies/model/sampling/criteria.h>
#include <drawpoint/doe/criterion.hpp>
#include <drawpoint/kriging/transformed_model.hpp>

#include <Eigen/Core>
#include <vector>

namespace drawpoint::studies {

/// The mix of one or more criteria that choose points one by one: neither repeat nor joint_improvement. `models`: one
/// per response, fitted to the runs so far. `seed`: that of LOLA-Voronoi's test points.
doe::Mix mix_of(const std::vector<CriterionShare>& shares,
                const std::vector<kriging::TransformedModel>& models, const Failures& failures,
                doe::Seed seed);

/// joint_improvement, beside points that others have chosen: k x d, natural units, k >= 0.
doe::JointSampler joint_improvement_beside(const Eigen::MatrixXd& others,
                                           const std::vector<kriging::TransformedModel>& models,
                                           const Failures& failures);

}  // namespace drawpoint::studies
