// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/log/logged_bucket.h>
#include <cmath>
#include <drawpoint/engine/loading/log/hinge_torque.hpp>

namespace drawpoint::engine::loading {
namespace {

// The cutting edge goes with the bucket's size.
ArmGeometry arm_of(const LoadingLog& log, const ArmLinkage& linkage) {
  const BucketOptions bucket = logged_bucket(log).value_or(BucketOptions{});
  const auto in_space = [](const Eigen::Vector2d& p) { return Eigen::Vector3d(p.x(), 0, p.y()); };
  return arm_geometry(in_space(linkage.F), in_space(linkage.G), in_space(bucket_profile(bucket).front()));
}

}  // namespace

HingeTorque::HingeTorque(const LoadingLog& log)
    : signals_(log.signals),
      torque_{signals_.index("hinge_G_torque_x"), signals_.index("hinge_G_torque_y"),
              signals_.index("hinge_G_torque_z")},
      arm_(arm_of(log, linkage_)) {
  for (const char* name : {"tip_x", "tip_z", "bucket_angle", "axle_x", "axle_z", "tilt_force"})
    if (!signals_.has(name)) return;
  const std::size_t force = signals_.index("tilt_force");
  if (signals_.columns[force].unit != "N") return;  // a motor's, in N m: the hinge has it
  by_cylinders_ = Poses{signals_.index("tip_x"),  signals_.index("tip_z"),  signals_.index("bucket_angle"),
                        signals_.index("axle_x"), signals_.index("axle_z"), force};
}

double HingeTorque::tilt_moment(std::size_t row) const {
  const auto value = [&](std::size_t column) { return signals_.at(row, column); };
  const double phi = value(by_cylinders_->bucket_angle), b = phi + arm_.psi_b;
  const Eigen::Vector2d tip(value(by_cylinders_->tip_x), value(by_cylinders_->tip_z)),
      axle(value(by_cylinders_->axle_x), value(by_cylinders_->axle_z)),
      G = tip - arm_.GK * Eigen::Vector2d(std::cos(b), std::sin(b));
  const ArmAngles angles = arm_angles(linkage_, G, axle, loaded_tyre_radius, phi);
  return value(by_cylinders_->tilt_force) * tilt_lever(linkage_, angles.a, angles.phi);
}

// Nose up is negative about y.
Eigen::Vector3d HingeTorque::at(std::size_t row) const {
  Eigen::Vector3d torque(signals_.at(row, torque_[0]), signals_.at(row, torque_[1]),
                         signals_.at(row, torque_[2]));
  if (by_cylinders_) torque.y() -= tilt_moment(row);
  return torque;
}

}  // namespace drawpoint::engine::loading
